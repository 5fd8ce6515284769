//! Gauges of a scene, read at the history's times.

use super::named_readings::{ProbeColumn, ProbeTable};
use super::overtopping;
use super::sounding::Sounding;
use crate::body::Place;
use crate::scene::{Behind, CaseConfig, Probe, ProbeKind, Side};

/// What the method of a volume adds where water is taken away.
const WITH_TAKEN: &str = "; with the water that the outflow took away";

/// A column for every probe of a case, and those of its crest if it has one.
pub fn probe_columns(config: &CaseConfig) -> Vec<ProbeColumn> {
    let takes_away = config.scene.seawall().is_some_and(|scene| scene.behind == Behind::Outflow);
    let of_probe = |probe: &Probe| ProbeColumn {
        name: probe.name.clone(),
        unit: probe.unit().to_owned(),
        method: match probe.kind {
            ProbeKind::Volume if takes_away => probe.method() + WITH_TAKEN,
            _ => probe.method(),
        },
    };
    let crest = config.scene.seawall().is_some_and(|scene| scene.crest.is_some());
    let of_crest = crest.then(overtopping::columns);
    config.probes.iter().map(of_probe).chain(of_crest.into_iter().flatten()).collect()
}

/// An empty table with these columns; none without a column.
pub(super) fn table(config: &CaseConfig) -> Option<ProbeTable> {
    let columns = probe_columns(config);
    (!columns.is_empty()).then(|| ProbeTable { columns, ..ProbeTable::default() })
}

/// A reading of each probe over still water of this depth, metres. Levels and voids are searched up
/// to four times that height.
pub(super) fn read(
    probes: &[Probe],
    water: &mut Sounding<'_>,
    depth: f64,
) -> impl Iterator<Item = f64> {
    let highest = 4.0 * depth;
    probes.iter().map(move |probe| match probe.kind {
        ProbeKind::Level => water.level(probe.x_m.unwrap_or(0.0), highest),
        ProbeKind::Elevation => water.level(probe.x_m.unwrap_or(0.0), highest) - depth,
        ProbeKind::Volume => water.beyond(probe.x_m.unwrap_or(0.0)),
        ProbeKind::Discharge => water.discharge(probe.x_m.unwrap_or(0.0)),
        ProbeKind::Void => water.void(face(probe, water), highest),
        ProbeKind::Pressure => {
            let (place, along) = place(probe, water);
            water.pressure(place, along, probe.diameter_m.unwrap_or(0.0))
        }
    })
}

/// The present place of a pressure probe, and the direction of its disc.
fn place(probe: &Probe, water: &Sounding<'_>) -> ([f64; 2], [f64; 2]) {
    let y = probe.y_m.unwrap_or(0.0);
    if probe.wall.is_none() {
        return ([probe.x_m.unwrap_or(0.0), y], [0.0, 1.0]);
    }
    let ([toe, foot], up) = face(probe, water);
    ([toe + up[0] * (y - foot) / up[1], y], up)
}

/// The wall of a probe: the point where its face meets the bed, metres, and the direction up the
/// face.
fn face(probe: &Probe, water: &Sounding<'_>) -> ([f64; 2], [f64; 2]) {
    let face = water.face(match probe.wall {
        Some(Side::Left) => Place::Left,
        Some(Side::Right) | None => Place::Right,
    });
    let [nx, ny] = face.normal;
    (face.point, [-ny * nx.signum(), nx.abs()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: a volume beyond a section held the water that an outflow had taken away, and
    /// nothing said so.
    #[test]
    fn a_volume_says_that_it_counts_what_was_taken_away() {
        let method = |scene: &str| {
            let probe = "name = \"V\"\nkind = \"volume\"\nx_m = 1".parse().unwrap();
            let (scene, numerics) = (scene.parse().unwrap(), toml::Table::new());
            let config = CaseConfig::with_probes(&scene, &numerics, &[probe]).unwrap();
            probe_columns(&config).remove(0).method
        };
        let beyond = "mass beyond x = 1 m over the density";
        assert_eq!(method(""), beyond);
        let outflow = "behind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.2";
        assert_eq!(method(outflow), format!("{beyond}{WITH_TAKEN}"));
    }
}
