//! Frames of particles as bytes.
//!
//! A particle has three numbers, x, y and a colour, in quanta. Particles are in the order of the
//! first frame: column after column, each from the bed up. The decoder can predict each number. Only
//! the difference from the prediction is coded.
//!
//! The first frame predicts from three neighbours in the lattice: the one before, the one a column
//! before, and the one before that. Later frames predict from the particle's own place in the frame
//! before, moved like the two neighbours that are already known.
//!
//! After the first frame a difference of less than one quantum is left out, so numbers are right
//! within a quantum. Still and slow water then needs almost no bytes.

use super::coder::{Chances, Coder, Encoder};

/// A particle's x, y and colour.
pub(super) type Point = [f32; 3];

/// Number of contexts: how large the differences beside, below and before were.
const SURROUNDINGS: usize = 8;

/// The state of coding, frame after frame.
struct Codec<'a, C> {
    coder: &'a mut C,
    /// Particles in a column.
    column: usize,
    /// Points as the decoder has them, and the last frame's displacements and differences.
    points: Vec<[i32; 3]>,
    moves: Vec<[i32; 3]>,
    differences: Vec<[i32; 3]>,
    chances: Vec<Chances>,
    first: bool,
}

impl<'a, C: Coder> Codec<'a, C> {
    fn new(coder: &'a mut C, particles: usize, column: usize) -> Codec<'a, C> {
        Codec {
            coder,
            column,
            points: vec![[0; 3]; particles],
            moves: vec![[0; 3]; particles],
            differences: vec![[0; 3]; particles],
            chances: vec![Chances::EVEN; 2 * 3 * SURROUNDINGS],
            first: true,
        }
    }

    /// Codes a frame. A decoder ignores `wanted`.
    fn frame(&mut self, wanted: impl Fn(usize) -> Point) {
        for at in 0..self.points.len() {
            let wanted = wanted(at);
            for (channel, wanted) in wanted.into_iter().enumerate() {
                self.number(at, channel, wanted);
            }
        }
        self.first = false;
    }

    fn number(&mut self, at: usize, channel: usize, wanted: f32) {
        let [beside, below, both] = [1, self.column, self.column + 1].map(|back| {
            at.checked_sub(back).map_or([0; 3], |at| {
                if self.first {
                    [self.points[at][channel], self.differences[at][channel], 0]
                } else {
                    [self.moves[at][channel], self.differences[at][channel], 0]
                }
            })
        });
        let before = self.points[at][channel];
        let (predicted, restless) = if self.first {
            (beside[0] + below[0] - both[0], 0)
        } else {
            (before + ((beside[0] + below[0]) >> 1), self.differences[at][channel].abs())
        };
        let off = wanted - predicted as f32;
        let off = if self.first { off.round() } else { off.trunc() } as i32;
        let unrest = (beside[1].abs() + below[1].abs() + restless) as usize;
        let surrounding = [0, 1, 2, 3, 4, 4, 5, 5, 5].get(unrest).copied();
        let surrounding = surrounding.unwrap_or(if unrest < 16 { 6 } else { 7 });
        let place = (3 * usize::from(self.first) + channel) * SURROUNDINGS + surrounding;
        let off = self.chances[place].code(self.coder, off);
        self.points[at][channel] = predicted + off;
        self.moves[at][channel] = if self.first { 0 } else { predicted + off - before };
        self.differences[at][channel] = off;
    }
}

/// The order in which particles are coded, and the number of particles in a column. Columns are one
/// `spacing` wide, in quanta.
pub(super) fn order(first: &[Point], spacing: f32) -> (Vec<usize>, usize) {
    let left = first.iter().map(|point| point[0]).fold(f32::INFINITY, f32::min);
    let column = |at: usize| ((first[at][0] - left) / spacing + 0.5).floor();
    let mut order: Vec<usize> = (0..first.len()).collect();
    order.sort_by(|&a, &b| {
        column(a).total_cmp(&column(b)).then(first[a][1].total_cmp(&first[b][1]))
    });
    let count = order.iter().take_while(|&&at| column(at) == column(order[0])).count();
    (order, count.max(1))
}

/// The bytes of frames whose points are in quanta, each frame's particles in the same order.
pub(super) fn encode(frames: &[Vec<Point>], order: &[usize], column: usize) -> Vec<u8> {
    let mut encoder = Encoder::new();
    let mut codec = Codec::new(&mut encoder, order.len(), column);
    for frame in frames {
        codec.frame(|at| frame[order[at]]);
    }
    encoder.finish()
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::coder::decoder::Decoder;
    use super::*;

    /// A wave runs through 7,800 particles and throws some into the air; `t` counts frames.
    pub fn frame(t: usize) -> Vec<Point> {
        let (t, mut seed) = (t as f32, 12345_u32 + t as u32);
        let mut noise = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / 16_777_216.0 - 0.5
        };
        (0..7800)
            .map(|k| {
                let (column, row) = ((k / 26) as f32, (k % 26) as f32);
                let (x, y) = (6.8 * column, 6.8 * row);
                let s = 1.0 / ((x - 40.0 * t + 200.0) / 150.0).cosh().powi(2);
                let splash = if column > 285.0 && t > 40.0 { 3.0 * (t - 40.0) } else { 0.0 };
                let shift = 100.0 * (((40.0 * t - 200.0 - x) / 150.0).tanh() + 1.0);
                [
                    x + shift + 0.4 * noise() + splash * noise(),
                    y * (1.0 + 0.5 * s) + 0.4 * noise() + splash * noise(),
                    63.0 * (1.0 - y / 180.0 + 0.5 * s).clamp(0.0, 1.0) + noise(),
                ]
            })
            .collect()
    }

    #[test]
    fn a_film_comes_back_within_a_quantum_and_is_small() {
        let frames: Vec<_> = (0..60).map(frame).collect();
        let (order, column) = order(&frames[0], 6.8);
        assert_eq!(column, 26);
        let bytes = encode(&frames, &order, column);
        assert!(bytes.len() < 225_000, "{} bytes", bytes.len());
        let mut decoder = Decoder::new(&bytes);
        let mut codec = Codec::new(&mut decoder, order.len(), column);
        for frame in &frames {
            codec.frame(|_| [0.0; 3]);
            for (&at, point) in order.iter().zip(&codec.points) {
                for (exact, coded) in frame[at].iter().zip(point) {
                    assert!((exact - *coded as f32).abs() < 1.0, "{exact} {coded}");
                }
            }
        }
    }
}
