//! The words of `seawall run`: the inputs before it starts, and the results.

use crate::cli::output::{duration, short, with_bar};
use crate::cli::table::Table;
use crate::math::name::name_of;
use crate::quantities::summary::{
    ALL, COARSE_SPACING, DOUBTFUL_REASON, MEASURED_WAVE_HEIGHT_RATIO, SEAWALL_MASS,
    SPRING_STIFFNESS, WAVE_HEIGHT_RATIO,
};
use crate::quantities::{Bars, Case, Column, Value, energy};
use crate::report::as_typed;
use crate::results::CaseRecord;
use crate::scene::{CaseConfig, PaddleChoice, SeawallScene, WallChoice};
use crate::simulation::{EnergyBudget, NamedReading, PhaseShare};

/// Wave, wall, depth and spacing in a line.
pub(super) fn inputs(config: &CaseConfig) -> String {
    let scene = match config.scene.seawall() {
        Some(scene) => seawall(scene),
        None => config.scene.kind().to_owned(),
    };
    let (depth, spacing) = (config.scene.frame().depth, config.numerics.particle_spacing_m);
    format!("{scene}, depth {} m, particles {} mm apart", as_typed(depth), as_typed(1e3 * spacing))
}

fn seawall(scene: &SeawallScene) -> String {
    let value = |column: &Column, value: f64| column.with_value("=", &as_typed(value));
    let mut parts = Vec::new();
    match (scene.paddle, scene.wave_height_ratio) {
        (_, 0.0) => parts.push("still water".to_owned()),
        (PaddleChoice::Solitary, ratio) => parts.push(value(&WAVE_HEIGHT_RATIO, ratio)),
        (paddle, _) => parts.push(name_of(paddle)),
    }
    let angle = match scene.wall_angle_deg {
        90.0 => String::new(),
        angle => format!(" of {}°", as_typed(angle)),
    };
    parts.push(format!("{}{angle}", scene.wall.words()));
    parts.extend(scene.spring_stiffness_n_per_m.map(|k| value(&SPRING_STIFFNESS, k)));
    parts.extend(scene.seawall_mass_kg_per_m.map(|m| value(&SEAWALL_MASS, m)));
    parts.join(", ")
}

/// Results, readings, energy, and where the time went.
pub(super) fn results(record: &CaseRecord, config: &CaseConfig, bars: Bars) -> String {
    let mut text = format!("case {}", record.id);
    let (Some(outcome), Some(energy)) = (&record.outcome, &record.energy) else {
        text.push_str(&format!(" failed: {}\n", record.reason));
        return text;
    };
    let status = if outcome.doubtful_reason.is_some() { "ok, but doubtful" } else { "ok" };
    text.push_str(&format!(": {status}, {}\n\n", duration(record.wall_time_s)));
    text.push_str(&outcome_table(&record.reported(config, bars)));
    if !record.readings.is_empty() {
        text.push_str("\nreadings\n");
        text.push_str(&readings_table(&record.readings));
    }
    let wall = config.scene.seawall().map(|scene| scene.wall);
    text.push_str(&energy_table(energy, outcome.energy_gap_percent, wall));
    text.push_str("\nwhere the time went\n");
    text.push_str(&phase_table(&record.phases));
    text
}

/// Columns that readers need before they read a number.
const FIRST: [&Column; 2] = [&DOUBTFUL_REASON, &COARSE_SPACING];

/// The results of a case, as far as it has them.
fn outcome_table(case: &Case<'_>) -> String {
    let number = |column: &Column, value: f64| {
        column.error(case).map_or_else(|| short(value), |bar| with_bar(value, bar))
    };
    let line = |column: &Column| {
        let text = match column.value(case)? {
            Value::Number(value) => format!("{} {}", number(column, value), column.unit.suffix()),
            Value::Count(count) => count.to_string(),
            Value::Flag(_) => return None, // its reason or mark stands beside a number
            Value::Text(text) => text,
        };
        let time = column.time(case).map(|time| format!(" at {time:.4} s")).unwrap_or_default();
        // The wall still moves at the end: the maximum is yet to come.
        let (start, end) =
            if column.is_bound(case) { ("≥ ", ", still moving at the end") } else { ("", "") };
        let text = text.trim_end();
        Some(format!("{:<32}{start}{text}{time}{end}\n", column.heading_without_unit()))
    };
    let results = ALL.iter().skip_while(|column| **column != &MEASURED_WAVE_HEIGHT_RATIO);
    // An error bar stands beside its number.
    let results = results
        .filter(|column| !FIRST.contains(column) && !column.is_bar() && column.is_told(case));
    FIRST.iter().chain(results).filter_map(|column| line(column)).collect()
}

fn readings_table(readings: &[NamedReading]) -> String {
    let mut table = Table::default();
    for reading in readings {
        table.row([reading.name.clone(), short(reading.value), reading.unit.clone()]);
    }
    table.render()
}

/// Every term, its share of the paddle's work if the paddle works, and the energy gap.
fn energy_table(budget: &EnergyBudget, gap_percent: f64, wall: Option<WallChoice>) -> String {
    let (paddle, spent) = energy::ALL.split_first().expect("a budget has terms");
    let work = (paddle.read)(budget);
    let total: f64 = spent.iter().map(|term| (term.read)(budget)).sum();
    let share = if work == 0.0 { "" } else { "  % of paddle work" };
    let mut text = format!("\n{:<26}{:>10}{share}\n", "energy budget", "J/m");
    let mut line = |name: &str, value: f64| {
        let share = match work {
            0.0 => String::new(),
            // A paddle that was pushed back has negative work.
            work => format!("  {:>16.2}", 100.0 * value / work.abs()),
        };
        text.push_str(&format!("{name:<26}{:>10}{share}\n", short(value)));
    };
    for term in energy::ALL.iter().filter(|term| work != 0.0 || *term != paddle) {
        let resistance = wall.filter(|_| **term == energy::THRESHOLD_DEVICE);
        let name = resistance.map_or_else(|| term.words(), |wall| wall.resistance().to_owned());
        line(&name, (term.read)(budget));
    }
    line("energy gap", work - total);
    text.push_str(&format!("energy gap over the most work at a time: {gap_percent:.2} %\n"));
    text
}

fn phase_table(phases: &[PhaseShare]) -> String {
    let total: f64 = phases.iter().map(|phase| phase.seconds).sum();
    let mut table = Table::default();
    for phase in phases {
        let share = if total > 0.0 { 100.0 * phase.seconds / total } else { 0.0 };
        let seconds = format!("{:.2} s", phase.seconds);
        table.row([phase.phase.clone(), seconds, format!("{share:.1} %")]);
    }
    table.render()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Study, SweepFile};

    fn told_of(scene: &str) -> String {
        let file = SweepFile::read(&format!("name = \"a\"\n[scene]\n{scene}"), &[]).unwrap();
        inputs(&Study::new(&file).unwrap().cases[0].config)
    }

    #[test]
    fn wave_wall_depth_and_spacing_are_told() {
        let numbers = "depth 0.2 m, particles 10 mm apart";
        assert_eq!(told_of(""), format!("H/h = 0.5, fixed wall, {numbers}"));
        let movable = "wall = \"movable\"\nspring_stiffness_n_per_m = 5e4\n\
                       seawall_mass_kg_per_m = 50\nwave_height_ratio = 0.3";
        let walls = "H/h = 0.3, movable wall, k = 50000 N/m, m = 50 kg/m";
        assert_eq!(told_of(movable), format!("{walls}, {numbers}"));
        assert!(told_of("wall_angle_deg = 120").contains("fixed wall of 120°"));
        let still = told_of("wave_height_ratio = 0\nend_time_s = 1");
        assert!(still.starts_with("still water, fixed wall"), "{still}");
        assert!(told_of("kind = \"rotating-patch\"").starts_with("rotating-patch, "));
    }

    #[test]
    fn energy_is_told_by_what_is_there() {
        let budget = EnergyBudget { threshold_device: 2.0, ..EnergyBudget::default() };
        let table = |wall| energy_table(&budget, 0.0, wall);
        let no_paddle = table(None);
        assert!(!no_paddle.contains("paddle") && no_paddle.contains("threshold device"));
        let caisson = table(Some(WallChoice::Caisson));
        assert!(caisson.contains("friction and water behind      2.000\n"), "{caisson}");
        let works = EnergyBudget { paddle_work: 4.0, ..budget };
        let works = energy_table(&works, 0.0, Some(WallChoice::Movable));
        assert!(works.contains("% of paddle work\npaddle work"), "{works}");
        assert!(works.contains("threshold device") && works.contains(" 50.00\n"), "{works}");
        let pushed = EnergyBudget { paddle_work: -4.0, threshold_device: -3.0, ..budget };
        let pushed = energy_table(&pushed, -25.0, Some(WallChoice::Movable));
        let line = |name: &str, end: &str| {
            pushed.lines().any(|line| line.starts_with(name) && line.ends_with(end))
        };
        assert!(line("paddle work", " -100.00") && line("stops", " 0.00"), "{pushed}");
        assert!(line("threshold device", " -75.00") && line("energy gap", " -25.00"), "{pushed}");
    }
}
