//! Speed against error: a figure and a page of tables, made from `accuracy.csv` alone.

use std::path::{Path, PathBuf};

use super::error::ReportError;
use super::load::{deserialize, read_records};
use super::plots::{Axis, Chart, Curve, Drawing, Entry, Figure, Layout, Look, Point};
use super::tables::Table;
use super::{make, save};
use crate::disk::names::{ACCURACY, FIGURES};
use crate::math::lists::different;
use crate::quantities::accuracy::{Errors, Line, TARGETS, cheapest_within};

/// Writes `figures/error-against-time.svg` and `accuracy.md` into a directory that holds
/// `accuracy.csv`; `about` says what each case is. Returns the page's path.
pub fn write(directory: &Path, about: &[(String, String)]) -> Result<PathBuf, ReportError> {
    let path = directory.join(ACCURACY);
    let (header, records) = read_records(&path)?;
    let lines: Vec<Line> = deserialize(&path, &header, &records)?;
    let figures = directory.join(FIGURES);
    make(&figures)?;
    if let Some(figure) = error_against_time(&lines) {
        save(&figures.join(format!("{}.svg", figure.name)), &figure.svg())?;
    }
    let path = directory.join("accuracy.md");
    save(&path, &page(&lines, about))?;
    Ok(path)
}

/// A dot for every method, both axes logarithmic; `None` without methods.
fn error_against_time(lines: &[Line]) -> Option<Figure> {
    let point = |line: &Line| {
        let (x, y) = (line.cpu_time_s?, line.error_percent?);
        let told = format!("{}: {x} s, {y} %", line.method);
        let (open, note) = (line.pareto != "yes", line.method.clone());
        (x > 0.0 && y > 0.0).then(|| Point { open, told, note, ..(x, y).into() })
    };
    let all = lines.iter().filter(|line| line.case == Errors::All.name());
    let points: Vec<_> = all.filter_map(point).collect();
    let x = Axis::logarithmic(points.iter().map(|point| point.x))?;
    let y = Axis::logarithmic(points.iter().map(|point| point.y))?;
    let mut front: Vec<_> = points.iter().filter(|point| !point.open).cloned().collect();
    front.sort_by(|a, b| a.x.total_cmp(&b.x));
    let look = Look::of(0);
    let curves = vec![
        Curve { entry: Entry::line("", look), points: front },
        Curve { entry: Entry::dots("", look, false), points },
    ];
    let titles = ["processor time, s", "error, %"];
    let chart = Chart::new((x, y), titles, ["cpu_time_s", "error_percent"], curves);
    Some(Figure {
        name: "error-against-time".to_owned(),
        title: "Error against processor time".to_owned(),
        caption: "Root mean square error over all cases against the processor time that they \
                  take together. Filled: nothing is both cheaper and more accurate."
            .to_owned(),
        drawing: Drawing::new(vec![chart], Layout { columns: 1, size: (900.0, 620.0) }),
    })
}

fn page(lines: &[Line], about: &[(String, String)]) -> String {
    let mut text = "# Speed against error\n\nWritten by `seawall accuracy` from `accuracy.csv`. \
        Errors are percent of the truth, of the still water depth for runups;\na method's error is \
        the root mean square over all cases and quantities. Times are processor seconds.\n\n\
        ![error against processor time](figures/error-against-time.svg)\n"
        .to_owned();
    let cases = different(lines.iter().map(|line| line.case.as_str()));
    let tables = Errors::EACH.into_iter().map(|group| methods(lines, group));
    for table in tables.chain([cheapest(lines, &cases), every_pair(lines)]) {
        text.push_str(&format!("\n## {}\n\n{}", table.title, table.markdown()));
    }
    text.push_str("\n## Cases\n\n");
    for (name, about) in about.iter().filter(|(name, _)| cases.contains(&name.as_str())) {
        text.push_str(&format!("- **{name}**: {about}\n"));
    }
    text
}

/// The sums of all methods, the most accurate first.
fn methods(lines: &[Line], group: Errors) -> Table {
    let mut sorted: Vec<_> = lines.iter().filter(|line| line.case == group.name()).collect();
    let error = |line: &Line| line.error_percent.unwrap_or(f64::INFINITY);
    sorted.sort_by(|a, b| error(a).total_cmp(&error(b)));
    let row = |line: &&Line| {
        let error = line.error_percent.map_or("a case failed".to_owned(), |e| short(Some(e)));
        let front = if line.pareto == "yes" { "yes" } else { "" }.to_owned();
        vec![line.method.clone(), error, short(line.cpu_time_s), front]
    };
    let header = ["method", "error, %", "processor time, s", "on the Pareto front"];
    let alone = if group == Errors::All { "" } else { " alone" };
    let title = format!("Methods, {}{alone}", group.words());
    Table::new("", &title, &header, sorted.iter().map(row).collect())
}

fn cheapest(lines: &[Line], cases: &[&str]) -> Table {
    let row = |case: &&str| {
        let best = TARGETS.map(|target| {
            let best = cheapest_within(lines, case, target);
            best.map_or("none".to_owned(), |l| format!("{} ({} s)", l.method, short(l.cpu_time_s)))
        });
        std::iter::once((*case).to_owned()).chain(best).collect()
    };
    let targets = TARGETS.map(|target| format!("{target} %"));
    let header = [&["case".to_owned()][..], &targets].concat();
    Table::new("", "Cheapest within an error", &header, cases.iter().map(row).collect())
}

fn every_pair(lines: &[Line]) -> Table {
    let is_pair = |line: &&Line| Errors::EACH.iter().all(|group| group.name() != line.case);
    let row = |line: &Line| {
        let mut cells = [
            line.force_error_percent,
            line.runup_error_percent,
            line.displacement_error_percent,
            line.flow_error_percent,
        ]
        .map(short);
        if !line.reason.is_empty() {
            cells = [line.reason.as_str(), "", "", ""].map(str::to_owned);
        }
        let names = [line.case.clone(), line.method.clone()];
        [&names[..], &cells, &[short(line.cpu_time_s)]].concat()
    };
    let header = ["case", "method", "F, %", "R, % of h", "X, %", "flow, %", "time, s"];
    Table::new("", "Every pair", &header, lines.iter().filter(is_pair).map(row).collect())
}

/// Two decimals; empty where there is no number.
fn short(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:.2}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::comma::csv_of;

    #[test]
    fn every_method_of_the_stored_table_has_room_for_its_name() {
        let root = tempfile::tempdir().unwrap();
        let table = include_str!("../../data/accuracy.csv");
        std::fs::write(root.path().join("accuracy.csv"), table).unwrap();
        write(root.path(), &[]).unwrap();
        let svg = std::fs::read_to_string(root.path().join("figures/error-against-time.svg"));
        let svg = svg.unwrap();
        let is_drawn = |line: &&str| line.starts_with("all,") && line.split(',').nth(6) != Some("");
        let drawn: Vec<_> = table.lines().filter(is_drawn).collect();
        assert!(drawn.len() > 30);
        for line in drawn {
            let method = line.split(',').nth(1).unwrap();
            assert!(svg.contains(&format!("\n{method}\n")), "{method} has no words");
        }
    }

    #[test]
    fn a_table_becomes_a_page_and_a_figure() {
        let root = tempfile::tempdir().unwrap();
        let line = |case: &str, method: &str, error, time, pareto: &str| Line {
            case: case.to_owned(),
            method: method.to_owned(),
            error_percent: error,
            cpu_time_s: Some(time),
            pareto: pareto.to_owned(),
            ..Line::default()
        };
        let sick = Line { reason: "energy-growth".to_owned(), ..line("a", "sick", None, 0.1, "") };
        let lines = [
            line("a", "fast", Some(2.0), 1.0, ""),
            line("a", "slow", Some(0.5), 8.0, ""),
            sick,
            line("all", "fast", Some(2.0), 1.0, "yes"),
            line("all", "slow", Some(0.5), 8.0, "yes"),
            line("all", "sick", None, 0.1, "no"),
        ];
        std::fs::write(root.path().join("accuracy.csv"), csv_of(&lines)).unwrap();
        let about = [("a".to_owned(), "a case".to_owned())];
        let page = std::fs::read_to_string(write(root.path(), &about).unwrap()).unwrap();
        assert!(page.contains("| all | slow (8.00 s) | fast (1.00 s) | fast (1.00 s) |"), "{page}");
        assert!(page.contains("| a | sick | energy-growth"));
        let svg = root.path().join("figures/error-against-time.svg");
        let svg = std::fs::read_to_string(svg).unwrap();
        assert!(svg.contains("fast") && svg.contains("slow") && !svg.contains("sick"));
    }
}
