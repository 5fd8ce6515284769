//! What the study cost and where its numbers come from, in words and lists.

use std::fmt::Write as _;

use serde_json::Value;

use super::answers::most;
use super::words::at;
use crate::math::lists::median;
use crate::math::words::counted;
use crate::quantities::summary::{PAIR_EVALUATIONS, PARTICLES, STEPS, WALL_TIME};
use crate::report::grid::grid;
use crate::report::load::Loaded;
use crate::report::markup::escape;
use crate::report::number::{as_typed, in_powers, significant};
use crate::report::tables::Table;

/// What the cases cost; `None` where no case has the numbers.
pub fn cost(data: &Loaded) -> Option<String> {
    let all = |column| data.finished().filter_map(|row| row.number(column)).collect::<Vec<f64>>();
    let times = all(&WALL_TIME);
    let middle = median(&times)?;
    let (slowest, longest) = most(data.finished(), |row| row.number(&WALL_TIME))?;
    let time = |seconds: f64| format!("{} s", significant(seconds, 3));
    let mut text = match times.len() {
        1 => format!("The case took {}", time(middle)),
        count => format!(
            "{} took {} together: {} in the median, {} at most{}",
            counted(count, "case"),
            time(times.iter().sum()),
            time(middle),
            time(longest),
            at(slowest)
        ),
    };
    text.push_str(". These are wall times of cases, stretches that they share left out.");
    if let (Some(particles), Some(steps)) = (median(&all(&PARTICLES)), median(&all(&STEPS))) {
        let particles = particles.round();
        write!(text, " A case in the median has {particles} particles and {steps:.0} steps.")
            .ok()?;
    }
    let pairs: f64 = all(&PAIR_EVALUATIONS).iter().sum();
    if pairs > 0.0 {
        write!(text, " Pairs of particles were summed over {} times.", in_powers(pairs)).ok()?;
    }
    let more = [saved(data), pace(data)].into_iter().flatten().collect::<String>();
    Some(format!("<p>{}{}</p>{}", escape(&text), escape(&more), loads(data).unwrap_or_default()))
}

/// The processes that have worked on the study.
fn sessions(data: &Loaded) -> &[Value] {
    let sessions = data.manifest.as_ref().and_then(|manifest| manifest.get("sessions")?.as_array());
    sessions.map_or(&[], Vec::as_slice)
}

fn number(value: &Value, name: &str) -> Option<f64> {
    value.get(name)?.as_f64()
}

/// Cases per hour, without companions, over the time of all sessions; empty if one was killed.
fn pace(data: &Loaded) -> Option<String> {
    let seconds: f64 = sessions(data).iter().filter_map(|one| number(one, "wall_time_s")).sum();
    let killed = sessions(data).iter().any(|one| number(one, "wall_time_s").is_none());
    let per_hour = data.rows.len() as f64 / seconds * 3600.0;
    let told = as_typed(significant(per_hour, 3));
    let cases = if told == "1" { "case" } else { "cases" };
    (seconds > 0.0 && !killed).then(|| format!(" That was {told} {cases} per hour."))
}

/// How busy each rank was, in reporting sessions with as many ranks as the last one.
fn loads(data: &Loaded) -> Option<String> {
    let told = sessions(data)
        .iter()
        .filter_map(|session| Some((session, session.get("load")?.get("ranks")?.as_array()?)));
    let told: Vec<_> = told.collect();
    let (last, ranks) = *told.last()?;
    let told: Vec<_> = told.into_iter().filter(|(_, other)| other.len() == ranks.len()).collect();
    let line = |rank: usize| {
        let sum = |name: &str| -> f64 {
            told.iter().filter_map(|(_, ranks)| number(&ranks[rank], name)).sum()
        };
        let room: f64 = told
            .iter()
            .filter_map(|(session, ranks)| {
                Some(number(session.get("load")?, "elapsed_s")? * number(&ranks[rank], "places")?)
            })
            .sum();
        let host = last.get("ranks").and_then(|ranks| ranks.get(rank)?.get("host"));
        let cells = [
            rank.to_string(),
            host.map(word).unwrap_or_default(),
            format!("{:.0} %", 100.0 * (sum("busy_s") / room.max(1e-9)).min(1.0)),
            format!("{} s", significant(sum("busy_s"), 3)),
            as_typed(sum("cases")),
            as_typed(sum("trunks")),
        ];
        cells.to_vec()
    };
    let header = ["rank", "host", "busy", "busy time", "cases and companions", "shared stretches"];
    let shown = ranks.len().min(MOST_RANKS);
    let table = Table::new("", "Load", &header, (0..shown).map(line).collect());
    let left = ranks.len() - shown;
    let more = match left {
        0 => String::new(),
        left => format!("<p>... and {} in manifest.json.</p>", counted(left, "more rank")),
    };
    Some(format!(
        "<h3>Load per rank</h3>\n<p>The share of a rank's time in which it computed, shared stretches and \
         companions included.</p>{}{more}",
        grid(&table)
    ))
}

/// How many ranks the page shows.
const MOST_RANKS: usize = 64;

/// How many steps shared trunks saved.
fn saved(data: &Loaded) -> Option<String> {
    let sum = |name: &str| -> f64 {
        let read = |session: &Value| session.get("savings")?.get(name)?.as_f64();
        sessions(data).iter().filter_map(read).sum()
    };
    let (computed, from_rest) = (sum("steps_computed"), sum("steps_from_rest"));
    let share = 100.0 * (1.0 - computed / from_rest);
    (from_rest > computed && computed > 0.0).then(|| {
        format!(" Stretches that cases share were computed once, which spared {share:.0} % of the steps.")
    })
}

/// The manifest as a list, with a line for each session, and the sweep file as written.
pub fn provenance(manifest: &Value) -> String {
    let mut lines = Vec::new();
    for (name, value) in manifest.as_object().into_iter().flatten() {
        match name.as_str() {
            "sum" | "sweep_file" => (),
            "sessions" => {
                for session in value.as_array().into_iter().flatten() {
                    lines.push(("worked on".to_owned(), words(session)));
                }
            }
            _ => lines.push((name.replace('_', " "), word(value))),
        }
    }
    let line = |(name, value): &(String, String)| {
        format!("<dt>{}</dt><dd>{}</dd>", escape(name), escape(value))
    };
    lines.retain(|(_, value)| !value.is_empty());
    let list = format!("<dl>{}</dl>", lines.iter().map(line).collect::<String>());
    let file = manifest.get("sweep_file").and_then(Value::as_str).filter(|file| !file.is_empty());
    let file =
        file.map(|file| format!("<h3>The file as written</h3>\n<pre>{}</pre>", escape(file)));
    list + &file.unwrap_or_default()
}

/// One process that worked on the study.
fn words(session: &Value) -> String {
    let text = |name: &str| session.get(name).and_then(Value::as_str).unwrap_or("");
    let ranks = session.get("ranks").and_then(Value::as_array);
    let rank = |rank: &Value| {
        let threads = rank.get("threads").and_then(Value::as_u64).unwrap_or(1) as usize;
        format!("{} ({})", word(&rank["host"]), counted(threads, "thread"))
    };
    let ranks: Vec<_> = ranks.into_iter().flatten().map(rank).collect();
    let time = session.get("wall_time_s").and_then(Value::as_f64);
    let parts = [
        text("started").to_owned(),
        time.map(|time| format!("{} s", significant(time, 3))).unwrap_or_default(),
        text("executor").to_owned(),
        ranks.join(", "),
        text("ending").to_owned(),
    ];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}

fn word(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(items) => items.iter().map(word).collect::<Vec<_>>().join(", "),
        Value::Null => String::new(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn sessions_are_told_in_a_line_and_the_file_as_it_is_written() {
        let manifest = json!({
            "version": "0.1.0", "git_commit": "abc", "overrides": [],
            "sweep_file": "name = \"a\"\n# k < 5\n",
            "sessions": [{ "executor": "threads", "started": "2026-01-01T00:00:00Z",
                "wall_time_s": 12.345, "ending": null,
                "ranks": [{ "host": "here", "threads": 2 }] }],
        });
        let text = provenance(&manifest);
        assert!(text.contains("<dt>git commit</dt><dd>abc</dd>"), "{text}");
        assert!(text.contains("<dd>2026-01-01T00:00:00Z, 12.3 s, threads, here (2 threads)</dd>"));
        assert!(text.contains("<pre>name = &quot;a&quot;\n# k &lt; 5\n</pre>"));
        assert!(!text.contains("overrides"), "what is empty is left out: {text}");
    }
}
