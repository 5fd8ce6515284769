//! The page: one file that opens from disk, with answers, figures, films and tables. Style and
//! script are inside. It is complete without its script.
//!
//! [`answers`] holds generated sentences. `data` is what the script works with. `figures`, `films`
//! and `provenance` are sections. The script is in `script/`, one file per task.

mod answers;
mod data;
mod figures;
mod films;
mod provenance;
mod thin;
mod words;

use std::fmt::Write as _;

use self::words::unbroken;
use super::error::ReportError;
use super::froude::Froude;
use super::grid::grid;
use super::load::Loaded;
use super::markup::escape;
use super::papers::Papers;
use super::plots::{self, Figure};
use super::selection;
use super::tables::{self, Table, across};
use crate::quantities::summary::{ENERGY_GAP, FORCE_MAX_GAP, PARTICLES_LOST};

const STYLE: [&str; 3] =
    [include_str!("../../palette.css"), plots::STYLE, include_str!("style.css")];
const SCRIPT: [&str; 5] = [
    include_str!("script/choice.js"),
    include_str!("script/table.js"),
    include_str!("script/figures.js"),
    include_str!("script/case.js"),
    include_str!("script/start.js"),
];

/// How many rows of a table the page shows; the files have all.
pub const MOST_ROWS: usize = selection::WHOLE;

/// The size of a page with films, bytes, roughly. Further films are linked.
const MOST: usize = 4_700_000;

/// The whole page: sentences on all cases, tables and figures of the shown ones.
pub fn page(
    [data, shown]: [&Loaded; 2],
    figures: &[Figure],
    tables: &[Table],
    papers: &Papers,
) -> Result<String, ReportError> {
    let name = escape(data.name().unwrap_or("seawall sweep"));
    let (mut body, mut rest) = (String::new(), String::new());
    head(&mut body, [data, shown], &name, papers.answer.as_deref());
    let failed = tables::failed(data, MOST_ROWS).whole()?.for_page();
    if !failed.rows.is_empty() {
        section(&mut body, &failed.title, &grid(&failed));
    }
    body.push_str(&figures::sections(figures));
    let theirs = papers.section();
    if !theirs.is_empty() {
        section(&mut body, "The papers", &theirs);
    }
    tabled(&mut rest, data, tables);
    if let Some(cost) = provenance::cost(data) {
        section(&mut rest, "Cost", &cost);
    }
    if let Some(manifest) = &data.manifest {
        section(&mut rest, "Provenance", &provenance::provenance(manifest));
    }
    let json = data::data(shown)?;
    let (style, script) = (STYLE.concat(), SCRIPT.concat());
    let written = [&body, &rest, &json, &style, &script].map(|text| text.len());
    let room = MOST.saturating_sub(written.iter().sum());
    if let Some(films) = films::films(shown, room) {
        section(&mut body, "Films", &films);
    }
    body.push_str(&rest);
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name}</title>\n<style>\n{style}</style>\n\
         <script>document.documentElement.className = \"opening\";</script>\n</head>\n<body>\n<main>\n{body}</main>\n\
         <aside id=\"case\" aria-label=\"One case\" hidden></aside>\n\
         <script type=\"application/json\" id=\"data\">{json}</script>\n\
         <script>\n(() => {{\n\"use strict\";\n{script}}})();\n</script>\n</body>\n</html>\n"
    ))
}

fn section(body: &mut String, title: &str, content: &str) {
    let (id, title) =
        (title.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "-"), escape(title));
    writeln!(body, "<section id=\"{id}\">\n<h2>{title}</h2>\n{content}\n</section>")
        .expect("a string grows");
}

/// The name, the answers, and the place for the script's bar.
fn head(body: &mut String, [data, shown]: [&Loaded; 2], name: &str, papers: Option<&str>) {
    let mut answers = answers::all(data);
    answers.extend(shown.is_part.then(|| ("Shown", selection::words(shown, data))));
    answers.extend(papers.map(|text| ("The papers", text.to_owned())));
    let answer = |(about, text): &answers::Answer| {
        format!("<dt>{about}</dt><dd>{}</dd>\n", escape(&unbroken(text)))
    };
    let list: String = answers.iter().map(answer).collect();
    writeln!(
        body,
        "<h1>{name}</h1>\n<dl class=\"answers\">\n{list}</dl>\n\
         <details id=\"choose\" hidden></details>"
    )
    .expect("a string grows");
}

fn tabled(body: &mut String, data: &Loaded, tables: &[Table]) {
    let names = ["summary", "loads", "overtopping", "prototype", "readings", "health", "energy"];
    for name in names {
        let found = tables.iter().find(|table| table.name == name && !table.rows.is_empty());
        let Some(table) = found else { continue };
        let before = match name {
            "summary" => BARS.to_owned(),
            "prototype" => PROTOTYPE.to_owned(),
            "health" => format!("<p>{}</p>", health_line(data)),
            _ => String::new(),
        };
        let shown = match name {
            "readings" => across(table),
            "prototype" => Froude::for_page(table),
            _ => table.for_page(),
        };
        section(body, &table.title, &(before + &grid(&shown)));
    }
}

/// The text before the table of cases.
const BARS: &str = "<p>± is the estimated error bar, where bars were asked for. ≥ is a lower bound: \
    the wall was still moving when the run ended, and the bar behind it can only lower it. A bold number \
    of stops says how often the wall came back onto its stop; the load of that is in no maximum.</p>";

/// The text before the prototype's table.
const PROTOTYPE: &str = "<p>By Froude's law, with the gravity and the density of the tank: lengths grow by \
    the scale, times by its root, pressures by the scale, forces and volumes per metre by its square, moments \
    per metre by its cube, discharges per metre by its power of 1.5. A case's own words are those of the tank. Viscosity, air and the water's compression do not scale so.</p>";

/// The largest gaps of all finished cases. The force's gap counts only where the force is largest:
/// elsewhere it touches no quoted number.
fn health_line(data: &Loaded) -> String {
    let numbers = |column| data.finished().filter_map(move |row| row.number(column));
    let largest = |column| numbers(column).map(f64::abs).max_by(f64::total_cmp);
    let lost: f64 = numbers(&PARTICLES_LOST).sum();
    let force = largest(&FORCE_MAX_GAP).map(|gap| {
        format!("Where the force is largest, its two readings differ by up to {gap:.2} %. ")
    });
    let energy =
        largest(&ENERGY_GAP).map(|gap| format!("The energy budget is off by up to {gap:.2} %. "));
    let lost = if lost == 1.0 { "1 particle was".into() } else { format!("{lost} particles were") };
    format!(
        "{}{}{lost} lost. In the table, the reasons for doubt stand out. The force max gap is \
         that where the force is largest. The force gap is the worst of the whole run: where a wall hits \
         its stop it may be many percent, and no result is read there.",
        force.unwrap_or_default(),
        energy.unwrap_or_default()
    )
}

#[cfg(test)]
mod tests;
