use super::*;
use crate::report::fixture;

fn drawn(directory: &tempfile::TempDir) -> Vec<Figure> {
    all(&Loaded::read(directory.path()).unwrap()).unwrap()
}

#[test]
fn every_figure_is_well_formed_alone_and_inline() {
    for directory in [fixture::sweep(), fixture::fixed()] {
        for figure in drawn(&directory) {
            let alone = figure.svg();
            let tree = roxmltree::Document::parse(&alone).unwrap();
            assert!(tree.descendants().any(|node| node.has_tag_name((SVG, "text"))));
            let page = figure.inline(Place::Usual);
            roxmltree::Document::parse(&page).unwrap();
            assert!(!page.contains("http") && !page.contains("NaN"), "{}", figure.name);
        }
    }
}

const SVG: &str = "http://www.w3.org/2000/svg";

#[test]
fn nothing_leaves_the_sheet() {
    for figure in drawn(&fixture::sweep()) {
        let alone = figure.svg();
        let tree = roxmltree::Document::parse(&alone).unwrap();
        let sheet = tree.root_element().attribute("viewBox").unwrap();
        let size: Vec<f64> = sheet.split(' ').map(|n| n.parse().unwrap()).collect();
        for line in tree.descendants().filter_map(|node| node.attribute("points")) {
            for pair in line.split_whitespace() {
                let (x, y) = pair.split_once(',').unwrap();
                let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
                assert!((0.0..=size[2]).contains(&x) && (0.0..=size[3]).contains(&y));
            }
        }
    }
}

#[test]
fn figures_without_data_are_left_out() {
    let names = |directory: &_| -> String {
        drawn(directory).iter().map(|figure| format!("{} ", figure.name)).collect()
    };
    let movable = "response-force response-runup response-displacement against-stiffness \
                   against-mass against-wave history-wave-0.3 history-wave-0.5 ";
    assert_eq!(names(&fixture::sweep()), movable);
    let fixed = "fixed-wall history-wave-0.1 history-wave-0.2 history-wave-0.3 \
                 history-wave-0.4 history-wave-0.5 history-wave-0.6 ";
    assert_eq!(names(&fixture::fixed()), fixed);
}

/// The story: 200 waves made a page of 200 histories, and of three near waves all were named `history-wave-0.3`.
#[test]
fn many_waves_have_few_histories_and_near_ones_names_of_their_own() {
    let histories = |waves: &[f64]| -> Vec<Figure> {
        let figures = drawn(&fixture::movable(waves, &[500.0], &[250.0]));
        figures.into_iter().filter(|figure| figure.name.starts_with("history-")).collect()
    };
    let many: Vec<f64> = (0..40).map(|at| 0.1 + 0.01 * f64::from(at)).collect();
    let figures = histories(&many);
    assert_eq!(figures.len(), 12, "the last case failed");
    assert!(
        figures[0].caption.ends_with("Of 39 wave heights 12 have such a figure, spread evenly.")
    );
    assert_eq!((&*figures[0].name, &*figures[11].name), ("history-wave-0.1", "history-wave-0.48"));
    let near = histories(&[0.3, 0.30001, 0.300012]).into_iter().map(|figure| figure.name);
    let names = ["history-wave-0.3", "history-wave-0.30001", "history-wave-0.300012"];
    assert_eq!(near.collect::<Vec<_>>(), names);
}

/// The story: each of 36 crests had a figure of two waves, beside the figure over all crests.
#[test]
fn fixed_walls_that_differ_in_other_keys_have_few_figures() {
    let (_directory, mut data) = fixture::read(fixture::fixed());
    let rows: Vec<_> = (0..9).flat_map(|_| data.rows[..2].to_vec()).collect();
    data.rows = rows;
    for (place, row) in data.rows.iter_mut().enumerate() {
        row.variant = format!("crest_freeboard_m = {}", place / 2).into();
    }
    let figures = fixed_wall::figures(&data);
    assert_eq!((figures.len(), &*figures[5].name), (6, "fixed-wall-crest-freeboard-m-8"));
    let told = "Of 9 combinations of other keys 6 have such a figure, spread evenly.";
    assert!(figures[0].caption.ends_with(told), "{}", figures[0].caption);
}

/// The story: a study of one stiffness had three response figures with a lone point per panel.
#[test]
fn one_stiffness_makes_no_curve() {
    let names = |waves: &[f64], masses: &[f64]| -> String {
        let figures = drawn(&fixture::movable(waves, &[500.0], masses));
        figures.iter().map(|figure| format!("{} ", figure.name)).collect()
    };
    assert_eq!(names(&[0.5], &[250.0]), "history-wave-0.5 ");
    let more = "against-mass against-wave history-wave-0.3 history-wave-0.5 ";
    assert_eq!(names(&[0.3, 0.5], &[50.0, 250.0]), more);
    for figure in drawn(&fixture::movable(&[0.5], &[500.0], &[250.0])) {
        assert!(!figure.svg().contains("NaN"), "{}", figure.name);
    }
}

#[test]
fn bounds_are_open_with_an_arrow_and_only_dots_go_through_them() {
    let mut seen = 0;
    for figure in drawn(&fixture::sweep()) {
        let alone = figure.svg();
        let tree = roxmltree::Document::parse(&alone).unwrap();
        let class = |node: &roxmltree::Node, class: &str| {
            node.attribute("class").is_some_and(|own| own.split(' ').any(|one| one == class))
        };
        for series in tree.descendants().filter(|node| class(node, "series")) {
            let solid = |node: &roxmltree::Node| class(node, "line") && !class(node, "loose");
            let lines: Vec<_> = series.children().filter(solid).collect();
            for point in series.children().filter(|node| class(node, "point")) {
                let told = point.descendants().find(|node| node.has_tag_name((SVG, "title")));
                let bound = told.unwrap().text().unwrap().contains('≥');
                let mark = point.children().find(|node| class(node, "mark")).unwrap();
                assert_eq!(bound, class(&mark, "open"));
                assert_eq!(bound, point.children().any(|node| class(&node, "arrow")));
                let at = mark.attribute("d").unwrap().split('m').next().unwrap();
                let at = at.trim_start_matches('M').replace(' ', ",");
                let through = |line: &roxmltree::Node| {
                    line.attribute("points").unwrap().split(' ').any(|corner| corner == at)
                };
                assert!(!bound || !lines.iter().any(through), "{at}");
                seen += usize::from(bound);
            }
        }
    }
    assert!(seen > 3, "{seen}");
}

#[test]
fn points_and_panels_say_what_they_stand_for() {
    let figures = drawn(&fixture::sweep());
    let figure = figures.iter().find(|figure| figure.name == "response-displacement").unwrap();
    let page = figure.inline(Place::Usual);
    for word in [
        "data-x=\"log10_k_star\" data-y=\"displacement_max\"",
        "data-panel=\"m_star=1.25\"",
        "data-series=\"wave_height_ratio=0.5\"",
        "data-case=\"case-0000\"",
        "<title>H/h = 0.3, k = 10 N/m, m = 50 kg/m: X* max ",
    ] {
        assert!(page.contains(word), "{word}");
    }
}

#[test]
fn a_variant_becomes_part_of_a_file_name() {
    assert_eq!(
        file_name("force", "boundary = mls-linear, dx = 0.01"),
        "force-boundary-mls-linear-dx-0.01"
    );
    let floors = ["0.05", "-0.05"].map(|y| file_name("force", &format!("floor_height_m = {y}")));
    assert_eq!(floors, ["force-floor-height-m-0.05", "force-floor-height-m-minus-0.05"]);
}
