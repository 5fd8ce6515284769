//! The page: one file that opens from disk, with figures, tables and style inside.

use std::fmt::Write as _;

use serde_json::Value;

use super::curves::distinct;
use super::grid::{LONG, escape, grid};
use super::load::Loaded;
use super::number;
use super::papers::Papers;
use super::plots::Figure;
use super::row::{PLACE, Row};
use super::tables::{self, Table, across};
use crate::quantities::summary::{
    BOUNDARY, CASE_ID, DOUBTFUL, ENERGY_GAP, FORCE_COUPLING, FORCE_GAP, KERNEL, PARTICLE_SPACING,
    PARTICLES_LOST, SCHEME,
};

const STYLE: &str = include_str!("style.css");
const PLOTS: &str = super::plots::STYLE;

/// The whole page.
pub fn page(
    data: &Loaded,
    figures: &[Figure],
    tables: &[Table],
    papers: Option<&Papers>,
) -> String {
    let name = escape(data.name().unwrap_or("seawall sweep"));
    let mut body = String::new();
    head(&mut body, data, &name);
    failures(&mut body, data);
    films(&mut body, data);
    for figure in figures {
        let (title, caption) = (escape(&figure.title), escape(&figure.caption));
        let svg = figure.inline();
        let file = &figure.name;
        section(
            &mut body,
            &title,
            &format!(
                "<figure><div class=\"wide\">{svg}</div><figcaption>{caption} \
             <span class=\"file\">figures/{file}.svg</span></figcaption></figure>"
            ),
        );
    }
    if let Some(papers) = papers {
        section(&mut body, "The papers", &papers.section());
    }
    for table in tables {
        let shown = match table.name.as_str() {
            _ if table.rows.is_empty() => continue,
            "summary" | "energy" => table.for_page(),
            "readings" => across(table),
            _ => continue,
        };
        section(&mut body, &escape(&table.title), &grid(&shown));
    }
    if let Some(table) = tables.iter().find(|table| table.name == "health") {
        let text = format!(
            "<p>{} In the table, the reasons for doubt stand out.</p>{}",
            health_line(data),
            grid(&table.for_page())
        );
        section(&mut body, &escape(&table.title), &text);
    }
    if let Some(manifest) = &data.manifest {
        section(&mut body, "Provenance", &provenance(manifest));
    }
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name}</title>\n<style>\n{STYLE}{PLOTS}</style>\n</head>\n<body>\n<main>\n{body}</main>\n\
         </body>\n</html>\n"
    )
}

fn section(body: &mut String, title: &str, content: &str) {
    writeln!(body, "<section>\n<h2>{title}</h2>\n{content}\n</section>").expect("a string grows");
}

fn head(body: &mut String, data: &Loaded, name: &str) {
    let (done, failed) = (data.finished().count(), data.failed().count());
    let left = match data.left() {
        0 => String::new(),
        left => format!(", {left} left"),
    };
    let mut facts = vec![("cases".to_owned(), format!("{done} finished, {failed} failed{left}"))];
    for column in PLACE.into_iter().chain([&PARTICLE_SPACING, &FORCE_COUPLING]) {
        let values = distinct(data.rows.iter(), column).into_iter().map(number::plain);
        facts.push((column.heading(), values.collect::<Vec<_>>().join(", ")));
    }
    for column in [&SCHEME, &BOUNDARY, &KERNEL] {
        let mut words: Vec<_> = data.rows.iter().map(|row| row.text(column)).collect();
        words.sort_unstable();
        words.dedup();
        facts.push((column.heading(), words.join(", ")));
    }
    facts.retain(|(_, value)| !value.is_empty());
    let list: String = facts
        .iter()
        .map(|(title, value)| format!("<dt>{title}</dt><dd>{}</dd>", escape(value)))
        .collect();
    writeln!(body, "<h1>{name}</h1>\n<dl>{list}</dl>").expect("a string grows");
}

fn failures(body: &mut String, data: &Loaded) {
    let table = tables::failed(data).for_page();
    if table.rows.is_empty() {
        return;
    }
    let said = "<p>These cases have no results; all others are complete.</p>";
    section(body, &table.title, &format!("{said}{}", grid(&table)));
}

/// Links to the films of cases that have one.
fn films(body: &mut String, data: &Loaded) {
    let link = |row: &Row| {
        let (id, words) = (escape(row.text(&CASE_ID)), row.words());
        let words = if words.is_empty() { id.clone() } else { escape(&words) };
        data.has_film(row).then(|| format!("<li><a href=\"films/{id}.html\">{words}</a></li>"))
    };
    let links: String = data.finished().filter_map(link).collect();
    if !links.is_empty() {
        section(body, "Films", &format!("<ul>{links}</ul>"));
    }
}

fn health_line(data: &Loaded) -> String {
    let numbers = |column| data.finished().filter_map(move |row| row.number(column));
    let largest = |column| numbers(column).map(f64::abs).fold(0.0, f64::max);
    let lost: f64 = numbers(&PARTICLES_LOST).sum();
    let doubtful = data.finished().filter(|row| row.is(&DOUBTFUL)).count();
    format!(
        "{doubtful} of {} finished cases are doubtful. Largest gap between the two force readings {:.2} %, of the energy budget {:.2} %; \
         {lost} particles lost.",
        data.finished().count(),
        largest(&FORCE_GAP),
        largest(&ENERGY_GAP)
    )
}

/// The manifest's values by their paths.
fn provenance(manifest: &Value) -> String {
    let mut lines = Vec::new();
    flatten("", manifest, &mut lines);
    let rows: String = lines
        .iter()
        .map(|(path, value)| format!("<dt>{}</dt><dd>{}</dd>", escape(path), escape(value)))
        .collect();
    let text = format!("<dl>{rows}</dl>");
    if lines.len() > LONG {
        return format!("<details><summary>{} values</summary>{text}</details>", lines.len());
    }
    text
}

fn flatten(path: &str, value: &Value, lines: &mut Vec<(String, String)>) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                flatten(&path, value, lines);
            }
        }
        Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_array()) => {
            for (index, item) in items.iter().enumerate() {
                flatten(&format!("{path}[{index}]"), item, lines);
            }
        }
        Value::Array(items) => {
            let words: Vec<_> = items.iter().map(word).collect();
            lines.push((path.to_owned(), words.join(", ")));
        }
        _ => lines.push((path.to_owned(), word(value))),
    }
}

fn word(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{fixture, plots, tables};

    fn page_of(directory: &tempfile::TempDir) -> String {
        let data = Loaded::read(directory.path()).unwrap();
        page(&data, &plots::all(&data).unwrap(), &tables::all(&data).unwrap(), None)
    }

    #[test]
    fn nothing_is_fetched_and_nothing_runs() {
        let page = page_of(&fixture::sweep());
        for word in ["http:", "https:", "<script", "<link", "@import", "url(", "src="] {
            assert!(!page.contains(word), "{word}");
        }
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
            assert!(!page.contains(&format!("<th class=\"number\">{word}")), "{word}");
            assert!(!page.contains(&format!("<th>{word}")), "{word}");
        }
    }

    #[test]
    fn films_that_are_there_are_linked() {
        let directory = fixture::sweep();
        assert!(!page_of(&directory).contains("films/"));
        let data = Loaded::read(directory.path()).unwrap();
        let row = data.finished().next().unwrap();
        let film = format!("films/{}.html", row.text(&CASE_ID));
        std::fs::create_dir(directory.path().join("films")).unwrap();
        std::fs::write(directory.path().join(&film), "").unwrap();
        let page = page_of(&directory);
        assert!(page.contains(&format!("<a href=\"{film}\">{}</a>", escape(&row.words()))));
        assert_eq!(page.matches("href=").count(), 1);
    }

    #[test]
    fn an_interrupted_sweep_says_how_many_cases_are_left() {
        let directory = fixture::sweep();
        assert!(page_of(&directory).contains("11 finished, 1 failed<"));
        let manifest = r#"{"name": "fixture", "cases": 15}"#;
        std::fs::write(directory.path().join("manifest.json"), manifest).unwrap();
        assert!(page_of(&directory).contains("11 finished, 1 failed, 3 left<"));
    }
}
