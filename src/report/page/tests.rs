use super::*;
use crate::report::fixture;

fn page_of(directory: &tempfile::TempDir) -> String {
    let data = Loaded::read(directory.path()).unwrap();
    let tables: Vec<_> =
        tables::all(&data).into_iter().map(|lines| lines.whole().unwrap()).collect();
    super::page([&data; 2], &plots::all(&data).unwrap(), &tables, &Papers::default()).unwrap()
}

#[test]
fn nothing_is_fetched() {
    // The namespace of drawings is a name, not an address.
    let page = page_of(&fixture::sweep()).replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "<link", "@import", "url(", "src="] {
        let found = page.split_once(word).map(|(_, rest)| rest.get(..80));
        assert_eq!(found, None, "{word}");
    }
}

#[test]
fn the_papers_have_their_answer_and_their_section() {
    let data = Loaded::read(fixture::fixed().path()).unwrap();
    let (answer, sentences) = (Some("7 values < 3 % off.".to_owned()), vec!["a".to_owned()]);
    let papers = Papers { answer, sentences, ..Papers::default() };
    let page = super::page([&data; 2], &[], &[], &papers).unwrap();
    assert!(page.contains("<dt>The papers</dt><dd>7 values &lt; 3\u{a0}% off.</dd>"));
    assert!(page.contains("<h2>The papers</h2>\n<p>a</p>"));
}

#[test]
fn failed_cases_stand_with_their_reasons_escaped() {
    let page = page_of(&fixture::sweep());
    assert!(page.contains("particle 12, 31 m/s &lt;"));
    assert!(page.contains("a &lt;b&gt; &amp; c"), "the manifest is escaped, too");
    assert!(!page_of(&fixture::fixed()).contains("Failed cases"));
}

#[test]
fn a_scene_without_waves_shows_what_it_has_and_no_empty_column() {
    let page = page_of(&fixture::dam_breaks(1));
    for word in ["Histories", "Gauges", "Readings", "front_at_wall", "F* max"] {
        assert!(page.contains(word), "{word}");
    }
    for word in ["H/h", "first F*", "k, N/m", "still moving"] {
        assert!(!page.contains(&format!("\">{word}</th>")), "{word}");
    }
}

#[test]
fn films_that_are_there_are_linked() {
    let directory = fixture::sweep();
    assert!(!page_of(&directory).contains("<h2>Films</h2>"));
    let data = Loaded::read(directory.path()).unwrap();
    let row = data.finished().next().unwrap();
    let film = format!("films/{}.html", row.id());
    std::fs::create_dir(directory.path().join("films")).unwrap();
    std::fs::write(directory.path().join(&film), "").unwrap();
    let words = escape(&row.words());
    assert!(page_of(&directory).contains(&format!("{words} <a href=\"{film}\">{film}</a>")));

    let reasons = format!("case_id,reason\n{},\"a, b\"\n", row.id());
    std::fs::write(directory.path().join("films/reasons.csv"), reasons).unwrap();
    let told = format!("{words} (a, b) <a href=\"{film}\">{film}</a>");
    assert!(page_of(&directory).contains(&told));
}

#[test]
fn an_interrupted_sweep_says_how_many_cases_are_left() {
    let directory = fixture::sweep();
    assert!(page_of(&directory).contains("11 finished, 1 failed."));
    let manifest = r#"{"name": "fixture", "cases": 15}"#;
    std::fs::write(directory.path().join("manifest.json"), manifest).unwrap();
    assert!(page_of(&directory).contains("11 finished, 1 failed, 3 left to run."));
}

/// The story: one particle that had left the tank was written as "1 particles were lost".
#[test]
fn one_lost_particle_is_none_of_many() {
    let (_directory, mut data) = fixture::read(fixture::fixed());
    let told = health_line(&data);
    assert!(told.contains(" 0 particles were lost."), "{told}");
    data.rows[0].set(&PARTICLES_LOST, 1);
    let told = health_line(&data);
    assert!(told.contains(" 1 particle was lost."), "{told}");
}
