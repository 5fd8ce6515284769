//! Finds room for labels beside points, so that none covers another label, a marker or a line.

/// Half the size of a marker with a margin, CSS pixels.
const MARKER: f64 = 6.0;
/// Margin around words, CSS pixels.
const AIR: f64 = 2.0;
/// How far from their point words may stand, the nearest first, CSS pixels.
const DISTANCES: [f64; 18] = [
    8.0, 12.0, 17.0, 23.0, 30.0, 38.0, 47.0, 57.0, 68.0, 80.0, 95.0, 115.0, 140.0, 170.0, 205.0,
    245.0, 290.0, 340.0,
];
/// How many directions of a full turn are tried.
const DIRECTIONS: usize = 36;
/// From this distance on, a line leads from the point to its words, CSS pixels.
const LED: f64 = 13.0;

/// A rectangle with upright sides: left, top, right, bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field(pub [f64; 4]);

impl Field {
    fn around((x, y): (f64, f64), wide: f64, high: f64) -> Field {
        Field([x - wide / 2.0, y - high / 2.0, x + wide / 2.0, y + high / 2.0])
    }

    fn meets(&self, Field(b): &Field) -> bool {
        let Field(a) = self;
        a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
    }

    fn is_in(&self, Field(b): &Field) -> bool {
        let Field(a) = self;
        a[0] >= b[0] && a[1] >= b[1] && a[2] <= b[2] && a[3] <= b[3]
    }

    fn holds(&self, (x, y): (f64, f64)) -> bool {
        let Field(a) = self;
        a[0] <= x && x <= a[2] && a[1] <= y && y <= a[3]
    }

    /// The place in the rectangle that is nearest to a point.
    fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let Field(a) = self;
        (x.clamp(a[0], a[2]), y.clamp(a[1], a[3]))
    }
}

/// Where words stand.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Their middle.
    pub middle: (f64, f64),
    /// A line to their point, if that is not near.
    pub lead: Option<[(f64, f64); 2]>,
}

/// Places words of given widths and one height at their points. Earlier words choose first. `None`
/// where there is no room. Nothing is placed where a line of `lines` runs.
pub fn place(
    words: &[((f64, f64), f64)],
    high: f64,
    inside: Field,
    lines: &[(f64, f64)],
) -> Vec<Option<Placed>> {
    let mut taken: Vec<Field> =
        words.iter().map(|(point, _)| Field::around(*point, MARKER, MARKER)).collect();
    taken.extend(along(lines).map(|point| Field::around(point, 3.0, 3.0)));
    let mut said: Vec<Field> = Vec::new();
    let mut placed = Vec::new();
    for &(point, wide) in words {
        let size = (wide + 2.0 * AIR, high + AIR);
        let away = away(point, words);
        let free = |field: &Field, fields: &[Field]| !fields.iter().any(|other| field.meets(other));
        let fits = |(field, _): &(Field, f64)| {
            field.is_in(&inside) && free(field, &taken) && free(field, &said)
        };
        // A line from a point to its words crosses no words, and nothing else if possible.
        let leads = |(field, distance): &(Field, f64), others: &[&[Field]]| {
            let lead: Vec<_> = along(&[point, field.nearest(point)]).collect();
            let beyond = lead.iter().filter(|at| !Field::around(point, 8.0, 8.0).holds(**at));
            let clear = |at: &(f64, f64)| {
                others.iter().all(|fields| free(&Field::around(*at, 1.0, 1.0), fields))
            };
            *distance < LED || beyond.into_iter().all(clear)
        };
        let search = |others: &[&[Field]]| {
            candidates(point, size, away).find(|place| fits(place) && leads(place, others))
        };
        let found = search(&[&said, &taken]).or_else(|| search(&[&said])).or_else(|| search(&[]));
        placed.push(found.map(|(field, distance)| {
            said.push(field);
            let end = field.nearest(point);
            let lead = (distance >= LED).then_some([point, end]);
            if let Some(lead) = lead {
                taken.extend(along(&lead).skip(3).map(|at| Field::around(at, 2.0, 2.0)));
            }
            let Field(f) = field;
            Placed { middle: ((f[0] + f[2]) / 2.0, (f[1] + f[3]) / 2.0), lead }
        }));
    }
    placed
}

/// The direction with the fewest other points, so that lines lead out of a crowd. For a lone point:
/// to the right and a little up.
fn away((x, y): (f64, f64), words: &[((f64, f64), f64)]) -> f64 {
    let push = |sum: (f64, f64), ((a, b), _): &((f64, f64), f64)| {
        let (dx, dy) = (x - a, y - b);
        let square = dx * dx + dy * dy;
        if square < 1e-9 { sum } else { (sum.0 + dx / square, sum.1 + dy / square) }
    };
    let (dx, dy) = words.iter().fold((0.0, 0.0), push);
    if libm::hypot(dx, dy) < 0.1 { -0.4 } else { libm::atan2(dy, dx) }
}

/// Fields around a point with their distances. The nearest come first; of these, those in the
/// wanted direction.
fn candidates(
    (x, y): (f64, f64),
    (wide, high): (f64, f64),
    wanted: f64,
) -> impl Iterator<Item = (Field, f64)> {
    DISTANCES.into_iter().flat_map(move |distance| {
        (0..DIRECTIONS).map(move |index| {
            let turn = (index as f64 / 2.0).ceil() * if index % 2 == 0 { 1.0 } else { -1.0 };
            let angle = std::f64::consts::TAU * (turn / DIRECTIONS as f64) + wanted;
            let (sine, cosine) = libm::sincos(angle);
            let aside = |share: f64, size: f64| (1.6 * share).clamp(-1.0, 1.0) * size / 2.0;
            let middle = (
                x + distance * cosine + aside(cosine, wide),
                y + distance * sine + aside(sine, high),
            );
            (Field::around(middle, wide, high), distance)
        })
    })
}

/// Points along a line, a few pixels apart.
fn along(line: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    line.windows(2).flat_map(|ends| {
        let (a, b) = (ends[0], ends[1]);
        let count = (libm::hypot(b.0 - a.0, b.1 - a.1) / 3.0).ceil().max(1.0);
        (0..=count as usize).map(move |index| {
            let share = index as f64 / count;
            (a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixty_words_in_a_crowd_cover_nothing() {
        // Points of a low-discrepancy sequence, denser towards one side.
        let point = |index: u32| {
            let (a, b) = (f64::from(index) * 0.618_034 % 1.0, f64::from(index) * 0.754_878 % 1.0);
            ((60.0 + 640.0 * a * a, 30.0 + 420.0 * b), 70.0)
        };
        let words: Vec<_> = (1..=60).map(point).collect();
        let inside = Field([0.0, 0.0, 760.0, 520.0]);
        let placed = place(&words, 10.0, inside, &[]);
        let fields: Vec<_> = placed
            .iter()
            .map(|placed| Field::around(placed.as_ref().expect("room").middle, 70.0, 10.0))
            .collect();
        for (index, field) in fields.iter().enumerate() {
            assert!(field.is_in(&inside));
            assert!(!fields[..index].iter().any(|other| field.meets(other)), "{index}");
        }
    }
}
