use super::*;
use crate::quantities::summary::{DISPLACEMENT_MAX, FIRST_FORCE_MAX, FIRST_RUNUP_MAX};
use crate::report::fixture;

fn drawn(waves: &[f64], stiffnesses: &[f64], masses: &[f64]) -> Vec<Figure> {
    let directory = fixture::movable(waves, stiffnesses, masses);
    figures(&Loaded::read(directory.path()).unwrap())
}

#[test]
fn a_parameter_of_one_value_has_no_figure() {
    let names = |figures: &[Figure]| -> Vec<String> {
        figures.iter().map(|figure| figure.name.clone()).collect()
    };
    let all = drawn(&[0.3, 0.5], &[10.0, 500.0, 1e5], &[50.0, 250.0]);
    assert_eq!(names(&all), ["against-stiffness", "against-mass", "against-wave"]);
    let one = drawn(&[0.5], &[10.0, 500.0, 1e5], &[250.0]);
    assert_eq!(names(&one), ["against-stiffness"]);
    assert_eq!(one[0].drawing.charts.len(), 3);
}

#[test]
fn displacements_and_stiffnesses_stand_on_logarithmic_axes_of_real_numbers() {
    let figure = drawn(&[0.5], &[0.1, 10.0, 1e3, 1e5], &[250.0]).remove(0);
    let chart = &figure.drawing.charts[2];
    let labels =
        |axis: &Axis| -> Vec<String> { axis.ticks.iter().map(|tick| tick.label.clone()).collect() };
    assert_eq!(labels(&chart.x), ["0.1", "10", "1000", "10⁵"]);
    assert!(chart.y.ticks.len() >= 4 && !chart.y.holds(0.0));
}

#[test]
fn of_many_values_a_few_are_drawn_and_the_caption_says_so() {
    let many: Vec<f64> = (1..=9).map(f64::from).collect();
    let waves: Vec<f64> = many.iter().map(|wave| wave * 0.05).collect();
    let figure = drawn(&waves, &[10.0, 500.0], &many).remove(0);
    assert_eq!(figure.drawing.charts.len(), 9);
    let told = "Shown are 6 of 9 masses. Shown are 3 of 9 wave heights. In the page a choice of cases \
                shows the others.";
    assert!(figure.caption.ends_with(told), "{}", figure.caption);
}

#[test]
fn a_page_holds_what_a_choice_may_ask_for_and_a_file_does_not() {
    let figure = drawn(&[0.2, 0.3, 0.4, 0.5, 0.6], &[10.0, 500.0], &[250.0]).remove(0);
    assert_eq!(figure.drawing.charts.len(), 15);
    let (page, file) = (figure.drawing.inline("a", false), figure.svg());
    assert_eq!(
        (page.matches("<svg").count() - 2, page.matches("hidden").count() - 2),
        (15, 6),
        "{page}"
    );
    for wave in [0.2, 0.3] {
        let heading = format!("H/h = {wave}");
        assert!(page.contains(&heading), "{wave}");
        assert_eq!(file.contains(&heading), wave == 0.2);
    }
}

/// The story: still water has no first impact and moves no wall. It had three empty panels, and
/// walls without a spring were left out without a word.
#[test]
fn what_has_no_place_has_no_panels_and_is_told() {
    let directory = fixture::movable(&[0.2, 0.5], &[0.0, 10.0, 500.0], &[250.0]);
    let mut data = Loaded::read(directory.path()).unwrap();
    for row in data.rows.iter_mut().filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(0.2)) {
        row.set(&FIRST_FORCE_MAX, "").set(&FIRST_RUNUP_MAX, "").set(&DISPLACEMENT_MAX, 0);
    }
    let figure = figures(&data).remove(0);
    assert_eq!((figure.name.as_str(), figure.drawing.charts.len()), ("against-stiffness", 3));
    let told =
        "the spring stiffness k. Walls with k = 0 have no place on a logarithmic axis. X* stands";
    assert!(figure.caption.contains(told), "{}", figure.caption);
    let plain = drawn(&[0.5], &[10.0, 500.0], &[250.0]).remove(0);
    assert!(!plain.caption.contains("no place"), "{}", plain.caption);
}
