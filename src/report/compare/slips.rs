//! Slips in a record: values that water cannot have, and columns in another unit.

use super::{Beside, Held};
use crate::math::decimal::significant;
use crate::math::lists::ends;
use crate::report::config::{Gauge, gauges};
use crate::report::load::Loaded;
use crate::report::series::at;
use crate::scene::{Frame, Scene};

/// Water gets no farther than so many depths over still water at a gauge.
const FARTHEST: f64 = 5.0;
/// A gauge on dry ground reads the ground, give or take this share of the depth.
const NOISE: f64 = 0.05;
/// Largest values that are so many times apart are in two units.
const APART: f64 = 10.0;
/// Smaller values, as shares of what is usual in their unit, are noise.
const LITTLE: f64 = 0.02;

/// What looks like a slip in the record that a case was held against, a sentence for each column.
pub fn slips(data: &Loaded, case_id: &str, held: &Held) -> Vec<String> {
    let basin = Basin::of(data, case_id);
    held.columns.iter().filter_map(|column| basin.slip(column)).collect()
}

/// What tells whether a value can be. Without a manifest nothing does.
struct Basin {
    scene: Option<Scene>,
    gauges: Vec<Gauge>,
}

impl Basin {
    fn of(data: &Loaded, case_id: &str) -> Basin {
        let row = data.rows.iter().position(|row| row.id() == case_id);
        let scene = row.and_then(|row| data.case(row)).map(|case| case.scene);
        Basin { scene, gauges: gauges(data) }
    }

    fn frame(&self) -> Option<Frame> {
        self.scene.as_ref().map(Scene::frame)
    }

    /// The bed through its points, m.
    fn bed(&self) -> Vec<(f64, f64)> {
        let bed = self.scene.as_ref().and_then(|scene| scene.seawall()?.bed.as_ref());
        bed.map_or_else(Vec::new, |bed| bed.points().iter().map(|&[x, y]| (x, y)).collect())
    }

    /// The lowest and the highest value that a gauge of the surface can read, m. Behind the bed's
    /// end only the highest is known.
    fn possible(&self, name: &str) -> Option<[f64; 2]> {
        let gauge = self.gauges.iter().find(|gauge| gauge.name == name)?;
        let depth = self.frame()?.depth;
        let bed = self.bed();
        let ground = if bed.is_empty() { Some(0.0) } else { at(&bed, gauge.x_m?) };
        let lowest = ground.map_or(-FARTHEST * depth, |ground| ground - NOISE * depth);
        match gauge.kind.as_str() {
            "level" => Some([lowest, (1.0 + FARTHEST) * depth]),
            "elevation" => Some([lowest - depth, FARTHEST * depth]),
            _ => None,
        }
    }

    /// What is usual in a unit.
    fn usual(&self, unit: &str) -> Option<f64> {
        let Frame { depth, gravity, density, .. } = self.frame()?;
        match unit {
            "m" => Some(depth),
            "m2" => Some(depth * depth),
            "m/s" => Some((gravity * depth).sqrt()),
            "m2/s" => Some(depth * (gravity * depth).sqrt()),
            "Pa" => Some(density * gravity * depth),
            _ => Some(1.0),
        }
    }

    /// Units that a column of this unit may be in by mistake, each with how many of it make one;
    /// `None` where the study's files do not tell the scene.
    fn others(&self, unit: &str) -> Option<Vec<(&'static str, f64)>> {
        let Frame { depth, gravity, density, .. } = self.frame()?;
        let force = self.scene.as_ref()?.force_unit_n_per_m();
        Some(match unit {
            "m" => vec![("mm", 1e3), ("cm", 1e2)],
            "m/s" => vec![("mm/s", 1e3), ("cm/s", 1e2)],
            "m2" | "m2/s" => vec![("litres per metre", 1e3)],
            "Pa" => vec![
                ("kPa", 1e-3),
                ("mbar", 1e-2),
                ("bar", 1e-5),
                ("metres of water", 1.0 / (density * gravity)),
            ],
            "½ρgh²" => {
                vec![("N per metre of wall", force), ("kN per metre of wall", 1e-3 * force)]
            }
            "h" => vec![("mm", 1e3 * depth), ("cm", 1e2 * depth), ("m", depth)],
            _ => Vec::new(),
        })
    }

    /// What looks like a slip in a column.
    fn slip(&self, column: &Beside) -> Option<String> {
        let told = self.impossible(column).or_else(|| self.apart(column))?;
        Some(format!("{}: {told}", column.name))
    }

    fn impossible(&self, column: &Beside) -> Option<String> {
        let [lowest, highest] = self.possible(&column.name)?;
        let outside = |point: &&(f64, f64)| !(lowest..=highest).contains(&point.1);
        let odd: Vec<_> = column.measured.iter().filter(outside).collect();
        let &(time, value) = *odd.first()?;
        let why = if value < lowest {
            "is below the bed".to_owned()
        } else {
            format!("is more than {FARTHEST} depths over still water")
        };
        let hint = if odd.iter().all(|point| point.1 == value) {
            ": leave cells empty where nothing was measured".to_owned()
        } else {
            self.ratio(column).map_or_else(String::new, |ratio| self.unit(column, ratio))
        };
        let [value, time] = [value, time].map(|number| significant(number, 6));
        Some(format!(
            "{} of {} measured values cannot be. The first, {value} m at {time} s, {why}{hint}",
            odd.len(),
            column.measured.len()
        ))
    }

    /// The largest measured value over the largest computed one, where both are more than noise.
    fn ratio(&self, column: &Beside) -> Option<f64> {
        let [measured, computed] = [&column.measured, &column.computed].map(|points| {
            ends(points.iter().map(|point| point.1.abs())).map_or(0.0, |(_, largest)| largest)
        });
        let least = LITTLE * self.usual(&column.unit).unwrap_or(0.0);
        let are_some = measured > 0.0 && computed > 0.0 && measured.max(computed) > least;
        are_some.then(|| measured / computed)
    }

    fn apart(&self, column: &Beside) -> Option<String> {
        let ratio = self.ratio(column)?;
        let told = |[large, small]: [&str; 2], times: f64| {
            let (times, hint) = (significant(times, 2), self.unit(column, ratio));
            format!("the largest {large} value is {times} times the largest {small} one{hint}")
        };
        if ratio >= APART {
            Some(told(["measured", "computed"], ratio))
        } else {
            (ratio <= 1.0 / APART).then(|| told(["computed", "measured"], 1.0 / ratio))
        }
    }

    /// The unit that a column is likely to be in.
    fn unit(&self, column: &Beside, ratio: f64) -> String {
        let far = |times: f64| libm::log10(ratio / times).abs();
        let mut near = self.others(&column.unit).unwrap_or_default();
        near.retain(|(_, times)| far(*times) < 0.5);
        let nearest = near.iter().min_by(|a, b| far(a.1).total_cmp(&far(b.1)));
        let name = nearest.map_or("another unit", |(name, _)| name);
        format!(": is the column in {name}?")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLUME: &str = "name = \"a\"\n[scene]\nstill_water_depth_m = 0.3\n\
        bed = [[0, 0], [1, 0], [2, 0.15], [2.5, 0.15]]\n\
        [[probe]]\nname = \"W\"\nkind = \"elevation\"\nx_m = 2.2\n\
        [[probe]]\nname = \"L\"\nkind = \"level\"\nx_m = 0.5\n[grid]";

    /// A column of this unit, whose largest computed value is the first.
    fn column(name: &str, unit: &str, computed: f64, measured: &[f64]) -> Beside {
        let measured = measured.iter().enumerate();
        Beside {
            name: name.to_owned(),
            unit: unit.to_owned(),
            axis: (String::new(), 1.0),
            measured: measured.map(|(at, value)| (at as f64, *value)).collect(),
            computed: vec![(0.0, 0.0), (1.0, computed)],
            gaps: Default::default(),
            rms: 0.0,
        }
    }

    fn told(name: &str, unit: &str, computed: f64, measured: &[f64]) -> Option<String> {
        let data = Loaded::swept(&[("wave_height_ratio", &["0.3"])]).made_from(FLUME, &[]);
        Basin::of(&data, "").slip(&column(name, unit, computed, measured))
    }

    /// The story: gauges in millimetres were 89 m high in 0.3 m of water, and 0.1 % off.
    #[test]
    fn water_is_neither_below_the_bed_nor_in_the_sky() {
        assert_eq!(told("W", "m", 0.09, &[-0.155, 0.08, 0.4]), None);
        assert_eq!(
            told("W", "m", 0.09, &[0.0, 89.0, -20.0]).unwrap(),
            "W: 2 of 3 measured values cannot be. The first, 89 m at 1 s, is more than 5 depths \
             over still water: is the column in mm?"
        );
        assert_eq!(
            told("L", "m", 0.4, &[0.3, -999.0, -999.0]).unwrap(),
            "L: 2 of 3 measured values cannot be. The first, -999 m at 1 s, is below the bed: \
             leave cells empty where nothing was measured"
        );
        assert!(told("W", "m", 0.09, &[-0.2, 0.08, 0.09]).unwrap().contains("below the bed"));
    }

    /// The story: forces in newtons were 11,000 % off without a word.
    #[test]
    fn a_likely_unit_is_named() {
        let force = told("force", "½ρgh²", 6.0, &[110.0, 650.0]).unwrap();
        assert_eq!(
            force,
            "force: the largest measured value is 110 times the largest computed one: is the \
             column in N per metre of wall?"
        );
        let unit = |unit: &str, computed: f64, measured: f64| {
            told("P", unit, computed, &[0.0, measured]).map(|told| told[3..].to_owned())
        };
        let pressure = unit("Pa", 2600.0, 2.7).unwrap();
        assert!(pressure.starts_with("the largest computed value is 960 times"), "{pressure}");
        assert!(pressure.ends_with("in kPa?"), "{pressure}");
        assert!(unit("Pa", 2600.0, 0.27).unwrap().ends_with("in metres of water?"));
        assert!(unit("h", 0.5, 150.0).unwrap().ends_with("in mm?"));
        assert!(unit("Pa", 2600.0, 33_000.0).unwrap().ends_with("in another unit?"));
        assert_eq!(unit("Pa", 2600.0, 400.0), None);
        assert_eq!(unit("Pa", 0.001, 30.0), None, "noise of a gauge that stays dry");
        assert_eq!(unit("m", 0.0, 0.1), None);
    }

    /// The story: a study whose scene was not known had water a metre deep, and a unit was named by it.
    #[test]
    fn no_unit_is_named_without_the_scene() {
        let force = column("force", "½ρgh²", 6.0, &[6.0 * 4905.0]);
        let told = Basin::of(&Loaded::default(), "").slip(&force).unwrap();
        assert!(told.ends_with("is the column in another unit?"), "{told}");
    }
}
