//! The exact solitary wave at a wall, and a smooth line through its known values.

/// The exact solitary wave of the Euler equations, reflected by a vertical wall: H/h, runup over
/// h, and the first peak of F/(½ρgh²). A wave of no height leaves still water.
const KNOWN: [[f64; 3]; 7] = [
    [0.0, 0.0, 1.0],
    [0.1, 0.20555, 1.4245],
    [0.2, 0.42413, 1.8726],
    [0.3, 0.6602, 2.3015],
    [0.4, 0.9237, 2.6779],
    [0.5, 1.2384, 3.0617],
    [0.6, 1.66, 3.489],
];

/// How many pieces the line has between two known heights.
const PIECES: u32 = 8;

/// The wave heights with known values.
pub fn waves() -> impl Iterator<Item = f64> {
    KNOWN.iter().map(|known| known[0])
}

/// The line of runup (1) or force (2) over the wave's height. It has cubics between known values,
/// which rise where those rise (Fritsch and Butland 1984).
pub fn line(of: usize) -> Vec<(f64, f64)> {
    let rise = |at: usize| (KNOWN[at + 1][of] - KNOWN[at][of]) / (KNOWN[at + 1][0] - KNOWN[at][0]);
    let last = KNOWN.len() - 1;
    // The heights are evenly spaced, so the slope is the harmonic mean of both sides.
    let slope = |at: usize| match at {
        0 => 1.5 * rise(0) - 0.5 * rise(1),
        _ if at == last => 1.5 * rise(last - 1) - 0.5 * rise(last - 2),
        _ => 2.0 / (1.0 / rise(at - 1) + 1.0 / rise(at)),
    };
    let piece = |at: usize| {
        let ([a, b], [from, to]) = ([KNOWN[at], KNOWN[at + 1]], [slope(at), slope(at + 1)]);
        (0..PIECES).map(move |step| {
            let (t, long) = (f64::from(step) / f64::from(PIECES), b[0] - a[0]);
            let (near, far) = ((1.0 - t) * (1.0 - t), t * t);
            let ends = near * (1.0 + 2.0 * t) * a[of] + far * (3.0 - 2.0 * t) * b[of];
            let slopes = near * t * from - far * (1.0 - t) * to;
            (a[0] + t * long, ends + long * slopes)
        })
    };
    (0..last).flat_map(piece).chain([(KNOWN[last][0], KNOWN[last][of])]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: the line had a corner at each of the seven heights.
    #[test]
    fn it_is_smooth_and_holds_what_is_known() {
        for of in [1, 2] {
            let line = line(of);
            for known in KNOWN {
                let near = |point: &&(f64, f64)| (point.0 - known[0]).abs() < 1e-9;
                assert!((line.iter().find(near).unwrap().1 - known[of]).abs() < 1e-9);
            }
            let slopes: Vec<_> = line
                .windows(2)
                .map(|ends| (ends[1].1 - ends[0].1) / (ends[1].0 - ends[0].0))
                .collect();
            let turn = slopes.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
            // Seven straight pieces had turns of up to 1.07 and 0.52.
            assert!(slopes.iter().all(|slope| *slope > 0.0) && turn < 0.25, "{turn}");
        }
    }
}
