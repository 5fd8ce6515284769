//! Sorts rows into the panels and curves that figures and tables share: one panel per mass, one
//! curve per wave height.

use super::row::Row;

/// A response that is plotted against the spring stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Response {
    /// Largest displacement of the run, X/h.
    Displacement,
    /// Largest force over the first impact, F/(½ρgh²).
    Force,
    /// Largest runup over the first impact, R/h.
    Runup,
}

impl Response {
    /// All of them, in the order of Figs. 13 to 15 of Liang et al. 2017.
    pub const ALL: [Response; 3] = [Response::Displacement, Response::Force, Response::Runup];

    /// The word used in file names.
    pub fn name(self) -> &'static str {
        match self {
            Response::Displacement => "displacement",
            Response::Force => "force",
            Response::Runup => "runup",
        }
    }

    /// The column of `summary.csv`.
    pub fn column(self) -> &'static str {
        match self {
            Response::Displacement => "displacement_max",
            Response::Force => "first_force_max",
            Response::Runup => "first_runup_max",
        }
    }

    /// The title of an axis.
    pub fn axis_title(self) -> &'static str {
        match self {
            Response::Displacement => "X / h",
            Response::Force => "F / (½ρgh²)",
            Response::Runup => "R / h",
        }
    }

    /// Its value in a case, non-dimensional.
    pub fn value(self, row: &Row) -> Option<f64> {
        match self {
            Response::Displacement => row.displacement_max,
            Response::Force => row.first_force_max,
            Response::Runup => row.first_runup_max,
        }
    }

    /// The value's estimated absolute error.
    pub fn error(self, row: &Row) -> Option<f64> {
        match self {
            Response::Displacement => row.displacement_error,
            Response::Force => row.force_error,
            Response::Runup => row.runup_error,
        }
    }

    /// The wall was still moving outwards at the end: the value is a lower bound.
    pub fn is_truncated(self, row: &Row) -> bool {
        self == Response::Displacement && row.displacement_truncated == Some(true)
    }
}

/// One case in a response curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Which case.
    pub case_id: String,
    /// log10 of k*.
    pub log10_k_star: f64,
    /// The response, non-dimensional.
    pub value: f64,
    /// Its estimated absolute error.
    pub error: Option<f64>,
    /// The wall was still moving outwards at the end: the value is a lower bound.
    pub truncated: bool,
    /// The factor s of the wall's law of motion.
    pub force_coupling: Option<f64>,
}

/// All cases of one wave height in a panel, by rising stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// H/h.
    pub wave_height_ratio: f64,
    /// Its points, never empty.
    pub points: Vec<Point>,
}

/// All cases of one mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// m*.
    pub m_star: f64,
    /// Its curves, by rising wave height, never empty.
    pub curves: Vec<Curve>,
}

/// The panels of a response, by rising mass, of the finished cases of one variant. Cases without
/// a spring have no place on a logarithmic axis and are left out.
pub fn panels(rows: &[Row], variant: &str, response: Response) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for row in rows.iter().filter(|row| row.is_ok() && row.variant == variant) {
        let (Some(wave), Some(m_star)) = (finite(row.wave_height_ratio), finite(row.m_star)) else {
            continue;
        };
        let Some((log10_k_star, value)) = finite(row.log10_k_star).zip(finite(response.value(row)))
        else {
            continue;
        };
        let at = position(
            &mut panels,
            m_star,
            |panel| panel.m_star,
            || Panel { m_star, curves: Vec::new() },
        );
        let curves = &mut panels[at].curves;
        let at = position(
            curves,
            wave,
            |curve| curve.wave_height_ratio,
            || Curve { wave_height_ratio: wave, points: Vec::new() },
        );
        curves[at].points.push(Point {
            case_id: row.case_id.clone(),
            log10_k_star,
            value,
            error: finite(response.error(row)),
            truncated: response.is_truncated(row),
            force_coupling: row.force_coupling,
        });
    }
    for curve in panels.iter_mut().flat_map(|panel| &mut panel.curves) {
        curve.points.sort_by(|a, b| a.log10_k_star.total_cmp(&b.log10_k_star));
    }
    panels
}

/// The place of `key` in a list sorted by key, where an item is inserted if there is none.
fn position<T>(
    list: &mut Vec<T>,
    key: f64,
    read: impl Fn(&T) -> f64,
    create: impl FnOnce() -> T,
) -> usize {
    match list.binary_search_by(|item| read(item).total_cmp(&key)) {
        Ok(at) => at,
        Err(at) => {
            list.insert(at, create());
            at
        }
    }
}

/// The different values of a column among rows, rising; empty cells are left out.
pub fn distinct<'a>(
    rows: impl Iterator<Item = &'a Row>,
    read: impl Fn(&Row) -> Option<f64>,
) -> Vec<f64> {
    let mut values: Vec<f64> = rows.filter_map(|row| finite(read(row))).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// At most so many of the items, evenly spread and with both ends.
pub fn spread<T: Clone>(items: &[T], most: usize) -> Vec<T> {
    let count = items.len().min(most);
    let last = items.len().saturating_sub(1);
    let at = |index: usize| (index * last + (count - 1) / 2) / (count - 1).max(1);
    (0..count).map(|index| items[at(index)].clone()).collect()
}

/// The variants of a sweep in the order of their first row; one, without a name, as a rule.
pub fn variants(rows: &[Row]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for row in rows {
        if !names.contains(&row.variant) {
            names.push(row.variant.clone());
        }
    }
    names
}

fn finite(value: Option<f64>) -> Option<f64> {
    value.filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(wave: f64, log10_k_star: f64, m_star: f64, value: Option<f64>) -> Row {
        Row {
            case_id: format!("{wave}-{log10_k_star}-{m_star}"),
            status: if value.is_some() { "ok" } else { "failed" }.to_owned(),
            wave_height_ratio: Some(wave),
            log10_k_star: Some(log10_k_star),
            m_star: Some(m_star),
            displacement_max: value,
            displacement_truncated: Some(true),
            ..Row::default()
        }
    }

    #[test]
    fn panels_curves_and_points_rise() {
        let rows = [
            row(0.4, 1.0, 5.0, Some(1.0)),
            row(0.2, 2.0, 5.0, Some(0.2)),
            row(0.2, 1.0, 5.0, Some(0.3)),
            row(0.2, 1.0, 1.0, Some(0.5)),
            row(0.6, 1.0, 1.0, None),
        ];
        let panels = panels(&rows, "", Response::Displacement);
        assert_eq!(panels.iter().map(|p| p.m_star).collect::<Vec<_>>(), [1.0, 5.0]);
        let heavy = &panels[1];
        assert_eq!(heavy.curves[0].wave_height_ratio, 0.2);
        assert_eq!(heavy.curves[0].points[0].value, 0.3);
        assert!(heavy.curves[0].points[0].truncated);
        assert_eq!(panels[0].curves.len(), 1, "a failed case has no point");
    }

    #[test]
    fn a_spring_of_no_stiffness_has_no_place_on_a_logarithmic_axis() {
        let rows = [row(0.4, f64::NEG_INFINITY, 5.0, Some(1.0))];
        assert!(panels(&rows, "", Response::Displacement).is_empty());
    }

    #[test]
    fn spreading_keeps_both_ends() {
        let ten: Vec<f64> = (0..10).map(f64::from).collect();
        assert_eq!(spread(&ten, 6), [0.0, 2.0, 4.0, 5.0, 7.0, 9.0]);
        assert_eq!(spread(&[3.0], 6), [3.0]);
        assert_eq!(spread::<f64>(&[], 6), [0.0; 0]);
    }
}
