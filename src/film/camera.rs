//! What a page's camera stores of a run, and the choice of instants for the film.

use std::io;

use super::codec::Point;
use super::is_read;
use super::page::PageFilm;
use super::take::{Take, nearest};
use super::{Camera, Colour};
use crate::scene::{CaseConfig, SeawallScene};
use crate::simulation::{CaseResult, Film, cost};

/// Number of frames of a film.
const FRAMES: usize = 60;
/// A camera keeps up to this many times more frames, from which the film's are chosen ...
const MOST_SPARE: usize = 8;
/// ... unless they need more memory than this, bytes.
const MOST_MEMORY: usize = 200_000_000;
/// Water that was taken away behind a crest is drawn under the ground, which hides it, at this
/// height in depths.
const UNDER: f64 = -0.075;
/// Half of a film's frames are within this many √(h/g) of the crest.
const CLOSE: f64 = 5.0;

impl PageFilm {
    /// What watches a case for it.
    pub(super) fn camera<'a>(&'a self, config: &'a CaseConfig) -> PageCamera<'a> {
        PageCamera::new(self, config)
    }
}

/// Watches a case and makes a page of it.
pub(super) struct PageCamera<'a> {
    film: &'a PageFilm,
    config: &'a CaseConfig,
    interval_s: f64,
    takes: Vec<Take>,
}

impl<'a> PageCamera<'a> {
    pub fn new(film: &'a PageFilm, config: &'a CaseConfig) -> PageCamera<'a> {
        let frame_bytes = cost(config).particles as usize * size_of::<Point>();
        let spare = (MOST_MEMORY / (FRAMES * frame_bytes).max(1)).clamp(1, MOST_SPARE);
        // The clock of a recorded stroke may begin late.
        let start_s = config.scene.seawall().map_or(0.0, SeawallScene::start_s);
        let interval_s = (config.scene.frame().end_time - start_s) / (FRAMES * spare) as f64;
        PageCamera { film, config, interval_s, takes: Vec::new() }
    }
}

impl Camera for PageCamera<'_> {
    fn interval_s(&self) -> f64 {
        self.interval_s
    }

    fn shoot(&mut self, film: &Film<'_>) {
        // A run that became unstable starts again.
        self.takes.retain(|take| take.time_s < film.time_s);
        let fluid = film.fluid;
        let count = fluid.id[..fluid.len()].iter().map(|&id| id as usize + 1).max().unwrap_or(0);
        let under = (UNDER * self.config.scene.frame().depth) as f32;
        // Particles that were taken away stay under the ground at their last x.
        let mut points: Vec<Point> = match self.takes.last() {
            Some(take) => take.points.iter().map(|&[x, ..]| [x, under, 0.0]).collect(),
            None => Vec::new(),
        };
        points.resize(count.max(points.len()), [0.0, under, 0.0]);
        for k in 0..fluid.len() {
            let value = match self.film.colour {
                Colour::Pressure => film.pressure[k],
                Colour::Speed => fluid.vx[k].hypot(fluid.vy[k]),
            };
            points[fluid.id[k] as usize] = [fluid.x[k] as f32, fluid.y[k] as f32, value as f32];
        }
        self.takes.push(Take { time_s: film.time_s, walls: film.walls, points });
    }

    fn finish(self: Box<Self>, result: &CaseResult) -> io::Result<()> {
        let frame = self.config.scene.frame();
        let close = CLOSE * frame.unit_time();
        let (takes, crest) = pick(self.takes, &moments(result), close);
        self.film.write(self.config, result, &takes, crest)
    }
}

/// When the force was largest, and then the runup and the displacement where a case has them, seconds.
fn moments(result: &CaseResult) -> Vec<f64> {
    let outcome = &result.outcome;
    let runup = Some(outcome.runup_max).filter(|_| is_read(result, |row| row.runup));
    let others = [runup, outcome.displacement_max].into_iter().flatten();
    std::iter::once(outcome.force_max).chain(others).map(|maximum| maximum.time_s).collect()
}

/// The film's frames, and the index of the crest, which is the first of the moments. All moments
/// have a frame. Half of the frames are evenly spread over the run, half are within `close` seconds
/// of the crest.
fn pick(takes: Vec<Take>, moments: &[f64], close: f64) -> (Vec<Take>, usize) {
    let (Some(first), Some(last)) = (takes.first(), takes.last()) else { return (takes, 0) };
    let (first, last, crest_s) = (first.time_s, last.time_s, moments[0]);
    let crest = nearest(&takes, crest_s);
    let spread = |from: f64, to: f64, count: usize| {
        (0..count).map(move |k| from + k as f64 / (count - 1) as f64 * (to - from))
    };
    let mut wanted = moments.to_vec();
    wanted.extend(spread(first, last, FRAMES / 2 - moments.len()));
    wanted.extend(spread((crest_s - close).max(first), (crest_s + close).min(last), FRAMES / 2));
    let chosen: std::collections::BTreeSet<usize> =
        wanted.into_iter().map(|time| nearest(&takes, time)).collect();
    let place = chosen.iter().position(|&at| at == crest).unwrap_or(0);
    let all = takes.len() <= FRAMES;
    let keep = |at: &usize| all || chosen.contains(at);
    let picked = takes.into_iter().enumerate().filter(|(at, _)| keep(at)).map(|(_, take)| take);
    (picked.collect(), if all { crest } else { place })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairs::Fluid;
    use crate::results::made_up;
    use crate::study::CaseId;

    #[test]
    fn a_film_has_sixty_frames_and_half_of_them_at_the_crest() {
        let take = |k: i32| Take { time_s: 0.0125 * f64::from(k), walls: [0.0; 2], points: vec![] };
        let (picked, crest) = pick((0..480).map(take).collect(), &[4.0], 0.5);
        assert!((50..=FRAMES).contains(&picked.len()), "{}", picked.len());
        assert_eq!(picked[crest].time_s, 4.0);
        assert_eq!((picked[0].time_s, picked[picked.len() - 1].time_s), (0.0, 479.0 * 0.0125));
        let at_crest = picked.iter().filter(|take| (take.time_s - 4.0).abs() <= 0.51).count();
        assert!((30..=36).contains(&at_crest), "{at_crest}");
        let (few, crest) = pick((0..7).map(take).collect(), &[0.04], 0.5);
        assert_eq!((few.len(), crest), (7, 3));
    }

    /// The story: in a long train the still of the highest runup, R* = 0.45, was of a frame 0.2 s
    /// away, where the water stood at R* = 0.06.
    #[test]
    fn stills_show_their_own_moments() {
        let root = tempfile::tempdir().unwrap();
        let film = PageFilm { colour: Colour::Speed, folder: root.path().to_owned() };
        let scene =
            "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 50";
        let config = CaseConfig::of(scene, "");
        let mut camera = PageCamera::new(&film, &config);
        let take = |k: i32| {
            let time_s = 0.1 * f64::from(k);
            let out = 0.05 - 0.01 * (time_s - 11.3).abs().min(4.0);
            Take { time_s, walls: [0.0, out], points: vec![[0.0; 3]] }
        };
        camera.takes = (0..480).map(take).collect();
        let mut result = made_up(&config);
        result.outcome.force_max.time_s = 30.0;
        result.outcome.runup_max.time_s = 7.6;
        result.outcome.displacement_max.as_mut().unwrap().time_s = 11.3;
        Box::new(camera).finish(&result).unwrap();
        let stills =
            film.files(CaseId::of(&config)).map(std::fs::read_to_string).map(Result::unwrap);
        for (still, time) in stills.iter().zip(["11.30", "7.60", "30.00"]) {
            assert!(still.contains(&format!(">t = {time} s, F* = ")), "{time}");
        }
    }

    /// A run from 258 to 283 s on the clock of its stroke is 25 s long.
    #[test]
    fn a_film_spreads_over_the_run_and_not_over_its_clock() {
        let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/usace_1995/case_b.toml");
        let mut file: toml::Table = std::fs::read_to_string(shipped).unwrap().parse().unwrap();
        let scene = file["scene"].as_table_mut().unwrap();
        let stroke = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/usace_1995/stroke_b.csv");
        scene["recorded_stroke"] = stroke.into();
        let config = CaseConfig::of(&scene.to_string(), "");
        let film = PageFilm { colour: Colour::Speed, folder: std::path::PathBuf::new() };
        let interval_s = PageCamera::new(&film, &config).interval_s;
        let frames = FRAMES as f64;
        assert!(25.0 / interval_s >= frames && 25.0 / interval_s <= frames * MOST_SPARE as f64);
    }

    #[test]
    fn particles_keep_their_numbers_and_a_new_attempt_starts_anew() {
        let config = CaseConfig::of("", "");
        let film = PageFilm { colour: Colour::Speed, folder: std::path::PathBuf::new() };
        let mut camera = PageCamera::new(&film, &config);
        let mut fluid = Fluid::at_rest((0..3).map(|k| [f64::from(k), 0.5, 1000.0, 1.0]));
        (fluid.vx[0], fluid.vy[0]) = (3.0, 4.0);
        fluid.id[..3].reverse();
        for time_s in [0.0, 0.1, 0.2, 0.0] {
            let (fluid, pressure) = (&fluid, &[0.0; 3]);
            camera.shoot(&Film { time_s, walls: [0.1, 0.2], fluid, pressure, faces: &[] });
        }
        assert_eq!(camera.takes.len(), 1);
        let points = &camera.takes[0].points;
        assert_eq!(points[..], [[2.0, 0.5, 0.0], [1.0, 0.5, 0.0], [0.0, 0.5, 5.0]]);
    }
}
