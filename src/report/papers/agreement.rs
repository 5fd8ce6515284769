//! Printed against computed: one panel for each of force, runup and displacement.

use super::Found;
use super::table::{couplings, words};
use crate::math::lists::ends;
use crate::quantities::Unit;
use crate::quantities::summary::FORCE_COUPLING;
use crate::report::number;
use crate::report::plots::{
    Axis, Chart, Curve, Drawing, Entry, Figure, Layout, Look, Point, key, points,
};

/// The panels: the prefixes of their quantities' names, and their unit.
const PANELS: [(&[&str], Unit); 3] = [
    (&["first_force", "force"], Unit::Force),
    (&["first_runup", "runup"], Unit::Runup),
    (&["displacement"], Unit::Displacement),
];

/// The figure; `None` where no force, runup or displacement is compared.
pub fn figure(found: &[Found]) -> Option<Figure> {
    let charts = PANELS.iter().filter_map(|(names, unit)| chart(found, names, *unit)).collect();
    Some(Figure {
        drawing: Drawing::filled(charts, Layout { columns: 3, size: (296.0, 250.0) })?,
        name: "papers_agreement".to_owned(),
        title: "Printed and computed".to_owned(),
        caption: format!(
            "What the papers print against what this study computes. On the line both are the same.{}{}",
            if found.iter().any(|one| one.error.is_some()) {
                " Bars: estimated errors."
            } else {
                ""
            },
            if found.iter().any(|one| one.bound) { " Open markers: lower bounds." } else { "" },
        ),
    })
}

fn chart(found: &[Found], names: &[&str], unit: Unit) -> Option<Chart> {
    let is_size = |one: &&Found| {
        let name = one.printed.quantity.as_str();
        let size = one.printed.is_size() && one.printed.unit != "m";
        size && names.iter().any(|start| name.starts_with(start))
    };
    let own: Vec<_> = found.iter().filter(is_size).collect();
    let of_walls = |label: &str, index: usize, s: Option<f64>| {
        let points = own.iter().filter(|one| one.coupling() == s).map(|one| point(one));
        let key = s.map_or_else(|| "wall=fixed".to_owned(), |s| key(&FORCE_COUPLING, s));
        let entry = Entry::dots(label, Look::of(index), false).keyed(key);
        Curve { entry, points: points.collect() }
    };
    let mut curves = vec![of_walls("fixed wall", 2, None)];
    for (index, s) in couplings(found).into_iter().enumerate() {
        curves.push(of_walls(&format!("s = {}", number::as_typed(s)), index, Some(s)));
    }
    curves.retain(|curve| !curve.points.is_empty());
    let numbers = points(&curves).flat_map(|point| [point.x, point.y]);
    let axis = Axis::around(numbers.clone(), 5.0)?;
    let (low, high) = ends(numbers)?;
    let same = Entry::line("the same", Look::ink());
    curves.insert(0, Curve::through(same, [(low, low), (high, high)]));
    let names = ["printed", "computed"];
    let titles = names.map(|what| format!("{} {what}", unit.axis()));
    let titles = titles.each_ref().map(String::as_str);
    Some(Chart::new((axis.clone(), axis), titles, names, curves))
}

fn point(found: &Found) -> Point {
    let (x, y) = (found.printed.value, found.computed);
    let source = format!("{}, Fig. {}", words(found.printed), found.printed.figure);
    Point {
        error: found.error.unwrap_or(0.0),
        bound: found.bound,
        case: found.row.id().to_owned(),
        told: format!("{source}: printed {x}, computed {}", number::significant(y, 4)),
        ..(x, y).into()
    }
}
