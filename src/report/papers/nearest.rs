//! For a study without a case of the papers: the wall of the papers that is nearest to its own.

use super::super::config::{Config, each_config};
use super::super::curves::spread;
use super::super::load::Loaded;
use super::super::number;
use super::super::row::{PLACE, Row};
use crate::papers::{Printed, Span, paper, printed, scenes};
use crate::quantities::Column;

/// How many cases are looked at.
const LOOKED_AT: usize = 200;

/// The place of the papers' nearest numbers, and the command that makes their figure. `None` where
/// the study has no solitary waves at walls that are fixed or have a spring.
pub fn nearest(data: &Loaded) -> Option<String> {
    let finished: Vec<usize> = data.placed().map(|(at, _)| at).collect();
    let places = spread(&finished, LOOKED_AT);
    let configs: Vec<_> = each_config(data, places.iter().copied()).collect();
    let rows = places.iter().map(|&at| &data.rows[at]);
    let cases = rows.zip(&configs).filter_map(|(row, config)| Some((row, config.as_ref()?)));
    let cases: Vec<(&Row, &Config)> = cases.filter(|(_, config)| is_theirs(config)).collect();
    let apart = |number: &Printed| {
        let own = cases.iter().filter(|(_, config)| text(config, "wall") == Some(&number.scene));
        own.map(|(row, _)| distance(number, row)).min_by(f64::total_cmp)
    };
    // A number for many stiffnesses together belongs to no single wall.
    let is_of_a_wall = |number: &&Printed| {
        let has_spring = number.scene != "movable" || number.spring_stiffness_n_per_m.is_some();
        number.wave_height_ratio.is_some() && has_spring
    };
    let walls = printed().iter().filter(is_of_a_wall);
    let walls = walls.filter_map(|number| Some((number, apart(number)?)));
    let (nearest, _) = walls.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let in_their_tank = cases.iter().any(|(_, config)| scenes(&config.scene).next().is_some());
    let none = if in_their_tank {
        "None of these cases is one that the papers print numbers of."
    } else {
        "The papers print numbers of other tanks alone."
    };
    let (name, figure) = (&nearest.paper, &nearest.figure);
    let words = paper(name).map_or("", |paper| paper.words.as_str());
    Some(format!(
        "{none} The nearest of theirs is {} (Fig. {figure} of {words}): run seawall reproduce {name} --figure \
         {figure} to see them.",
        place(nearest)
    ))
}

/// Whether it is a solitary wave at an upright wall that is fixed, or at a wall with a spring.
fn is_theirs(config: &Config) -> bool {
    let upright = || config.value("wall_angle_deg") == Some(90.0);
    text(config, "kind") == Some("seawall")
        && text(config, "paddle").is_none_or(|paddle| paddle == "solitary")
        && match text(config, "wall") {
            Some("fixed") => upright(),
            wall => wall == Some("movable"),
        }
}

fn text<'a>(config: &'a Config, key: &str) -> Option<&'a str> {
    config.scene.get(key)?.as_str()
}

fn spans(number: &Printed) -> [(&'static Column, Option<Span>); 3] {
    let spans =
        [number.wave_height_ratio, number.spring_stiffness_n_per_m, number.seawall_mass_kg_per_m];
    std::array::from_fn(|at| (PLACE[at], spans[at]))
}

/// How far a case is from a printed one in wave, stiffness and mass, as logarithms of ratios.
/// Stiffness counts least, as it spans many powers of ten.
fn distance(number: &Printed, row: &Row) -> f64 {
    let weights = [1.0, 0.2, 0.5];
    let off = |((column, span), weight): ((&Column, Option<Span>), f64)| {
        let (Some(span), Some(value)) = (span, row.number(column)) else { return 0.0 };
        let target = value.clamp(span.low, span.high);
        let ratio = value.max(1e-9) / target.max(1e-9);
        weight * libm::log(ratio).abs()
    };
    spans(number).into_iter().zip(weights).map(off).sum()
}

/// The wall and the wave in words: `H/h = 0.3, k = 1000 N/m, m = 50 kg/m`.
fn place(number: &Printed) -> String {
    let part = |(column, span): (&Column, Option<Span>)| {
        let (sign, value) = match span? {
            Span { low, .. } if low.is_finite() && span?.high.is_infinite() => ("≥", low),
            Span { low, high } if low.is_infinite() => ("≤", high),
            Span { low, .. } => ("=", low),
        };
        Some(column.with_value(sign, &number::as_typed(value)))
    };
    spans(number).into_iter().filter_map(part).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::tests::study;
    use super::*;

    fn of(length: f64, mass: f64) -> Option<String> {
        nearest(&Loaded::read(study(length, mass, 1.0).path()).unwrap())
    }

    #[test]
    fn the_nearest_wall_of_the_papers_is_told_with_its_figure() {
        assert_eq!(
            of(2.5, 47.0).unwrap(),
            "None of these cases is one that the papers print numbers of. The nearest of theirs is \
             H/h = 0.3, k = 100 N/m, m = 50 kg/m (Fig. 10 of Liang et al. 2017): run seawall reproduce \
             liang2017 --figure 10 to see them."
        );
        let other = of(3.0, 50.0).unwrap();
        assert!(
            other.starts_with("The papers print numbers of other tanks alone. The nearest"),
            "{other}"
        );
    }

    #[test]
    fn other_scenes_have_nothing_to_do_with_them() {
        let directory = crate::report::fixture::dam_breaks(2);
        assert_eq!(nearest(&Loaded::read(directory.path()).unwrap()), None);
    }
}
