//! The page that plays a film: particles, curves, style and script in one file.

use std::fs;
use std::io;
use std::path::PathBuf;

use super::reel::Reel;
use super::scale::{self, Colour};
use super::stage::Stage;
use super::take::{Take, nearest};
use super::title::{about, moment, title};
use super::{at, is_read, still};
use crate::disk;
use crate::disk::names::{FILM_FILES, FILM_PAGE, FURTHEST, HIGHEST, STILL, film_file};
use crate::math::decimal::significant;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, cost};
use crate::study::CaseId;

/// A page of more particles than this would be too large to open.
const MOST_PARTICLES: u64 = 300_000;
/// The smallest displacement that a still can show, in depths of the still water.
const SEEN: f64 = 0.01;

/// The files of a film: `<folder>/<case_id>.html` and a still of the crest at the wall, `.svg`.
/// Further stills are one of the highest runup, `-highest.svg`, if that is another frame, and one
/// of the largest displacement, `-furthest.svg`, if the wall moves.
#[derive(Debug, Clone)]
pub struct PageFilm {
    /// The quantity that colours the particles.
    pub colour: Colour,
    /// Where the files go.
    pub folder: PathBuf,
}

impl PageFilm {
    /// Whether a case is small enough for a page.
    ///
    /// # Errors
    /// The quantity that is too large, and advice, in words.
    pub fn takes(config: &CaseConfig) -> Result<(), String> {
        let particles = cost(config).particles;
        if particles <= MOST_PARTICLES {
            return Ok(());
        }
        let most = MOST_PARTICLES;
        Err(format!(
            "{particles} particles are too many for a film of at most {most}; --vtk has no limit"
        ))
    }

    /// The page of a case.
    pub fn path(&self, id: CaseId) -> PathBuf {
        self.file(id, FILM_PAGE)
    }

    /// Every file that the film of a case may have.
    pub fn files(&self, id: CaseId) -> [PathBuf; 4] {
        FILM_FILES.map(|ending| self.file(id, ending))
    }

    fn file(&self, id: CaseId, ending: &str) -> PathBuf {
        film_file(&self.folder, id, ending)
    }

    /// Writes the page, the still of one frame, and those of the highest runup and of the largest
    /// displacement. A sweep relies on it that an existing file is complete.
    pub(super) fn write(
        &self,
        config: &CaseConfig,
        result: &CaseResult,
        takes: &[Take],
        crest: usize,
    ) -> io::Result<()> {
        if takes.len() <= crest {
            return Ok(());
        }
        let stage = Stage::of(config, takes);
        let id = CaseId::of(config);
        let page = self.path(id);
        let end = scale::end(takes.iter().flat_map(|take| &take.points).map(|point| point[2]));
        let span = takes[takes.len() - 1].time_s - takes[0].time_s;
        let draw = |take: &Take| {
            let still = still::Still { stage: &stage, take, colour: self.colour, end };
            still.svg(&title(config), &moment(config, take, result, span))
        };
        // Only if the directory still exists.
        if !self.folder.is_dir() {
            fs::create_dir(&self.folder).map_err(at(&self.folder))?;
        }
        let (mut stills, crest_s) = (String::new(), takes[crest].time_s);
        let climbs = is_read(result, |row| row.runup);
        let highest = if climbs { nearest(takes, result.outcome.runup_max.time_s) } else { crest };
        let other = |take: &&Take| take.time_s != crest_s;
        let moments = [
            (self.file(id, STILL), Some(&takes[crest]), true),
            (self.file(id, HIGHEST), Some(&takes[highest]).filter(other), false),
            (self.file(id, FURTHEST), furthest(takes, stage.depth).filter(other), true),
        ];
        for (picture, take, inside) in moments {
            let Some(take) = take else { continue };
            let still = draw(take);
            disk::put(&picture, &still).map_err(at(&picture))?;
            stills += if inside { &still } else { "" };
        }
        let reel = Reel { takes, crest, highest, stage: &stage, end };
        let film = reel
            .json(result, config.scene.frame().force_unit())
            .to_string()
            .replace('<', "\\u003c");
        let (colour, unit, units) = self.colour.legend();
        let fields = [
            ("{title}", title(config)),
            ("{about}", about(config)),
            (
                "{style}",
                concat!(include_str!("../palette.css"), include_str!("page.css")).to_owned(),
            ),
            ("{colour}", colour.to_owned()),
            ("{unit}", unit.to_owned()),
            ("{end}", significant(end / units, 3).to_string()),
            ("{gradient}", scale::colours().join(", ")),
            ("{still}", stills),
            ("{script}", concat!(include_str!("decode.js"), include_str!("page.js")).to_owned()),
            ("{film}", film),
        ];
        let text = include_str!("page.html").to_owned();
        let text = fields.iter().fold(text, |text, (field, value)| text.replacen(field, value, 9));
        disk::put(&page, text).map_err(at(&page))
    }
}

/// The first frame of the largest displacement, if the wall moved far enough to be seen.
fn furthest(takes: &[Take], depth: f64) -> Option<&Take> {
    let moved = takes.iter().filter(|take| take.walls[1] > SEEN * depth);
    moved.reduce(|most, take| if take.walls[1] > most.walls[1] { take } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::codec;
    use crate::results::made_up;
    use crate::simulation::HistoryRow;

    #[test]
    fn a_page_needs_nothing_but_itself() {
        let root = tempfile::tempdir().unwrap();
        let film = PageFilm { colour: Colour::Pressure, folder: root.path().join("films") };
        let scene =
            "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 50";
        let config = CaseConfig::of(scene, "");
        let points: Vec<_> = (0..40)
            .map(|k| [0.1 * (k / 4) as f32, 0.05 * (k % 4) as f32, 100.0 * (3 - k % 4) as f32])
            .collect();
        let take = |k: i32| {
            let time_s = 0.1 * f64::from(k);
            Take {
                time_s,
                walls: [0.01 * time_s, 0.02 * (3.0 - (time_s * 10.0 - 3.0).abs())],
                points: points.clone(),
            }
        };
        let takes: Vec<_> = (0..5).map(take).collect();
        let mut result = made_up(&config);
        result.outcome.runup_max.time_s = 0.4;
        film.write(&config, &result, &takes, 2).unwrap();
        let page = fs::read_to_string(film.path(CaseId::of(&config))).unwrap();
        let still =
            fs::read_to_string(film.path(CaseId::of(&config)).with_extension("svg")).unwrap();
        roxmltree::Document::parse(&still).unwrap();
        assert!(!still.contains("<script"));
        let files = film.files(CaseId::of(&config)).map(|path| fs::read_to_string(path).unwrap());
        assert!(files[0].contains(">t = 0.30 s, F* = "), "the largest displacement: {}", files[0]);
        assert!(files[0].contains(", X* = ") && files[2].contains(">t = 0.20 s, F* = "));
        assert!(files[1].contains(">t = 0.40 s, F* = "), "the highest runup: {}", files[1]);
        assert_eq!(page.matches("class=\"still\"").count(), 2, "two of them where scripts are off");
        for word in ["http:", "https:", "<link", "@import", "url(", "src=", "{film}", "{still}"] {
            assert!(!page.replace("http://www.w3.org/2000/svg", "").contains(word), "{word}");
        }
        for word in ["k = 500 N/m", "<noscript><svg", "aria-label", "\"wall\":\"spring\""] {
            assert!(page.contains(word), "{word}");
        }
    }

    /// A drop was once said to have F* = 0.00 and R* = 0.00, with a still of its highest runup.
    #[test]
    fn water_without_a_wall_has_neither_force_nor_runup() {
        let root = tempfile::tempdir().unwrap();
        let film = PageFilm { colour: Colour::Pressure, folder: root.path().to_owned() };
        let config = CaseConfig::of("kind = \"oscillating-drop\"", "");
        let take =
            |k: i32| Take { time_s: 0.1 * f64::from(k), walls: [0.0; 2], points: vec![[0.0; 3]] };
        let takes: Vec<_> = (0..5).map(take).collect();
        let mut result = made_up(&config);
        for row in &mut result.history {
            (row.force, row.runup, row.displacement) = (0.0, 0.0, 0.0);
        }
        film.write(&config, &result, &takes, 2).unwrap();
        let [furthest, highest, still, _] = film.files(CaseId::of(&config));
        let still = fs::read_to_string(still).unwrap();
        assert!(still.contains(">t = 0.20 s<"), "{still}");
        assert!(!highest.exists() && !furthest.exists());
    }

    #[test]
    fn a_page_of_sixty_frames_is_small() {
        let root = tempfile::tempdir().unwrap();
        let film = PageFilm { colour: Colour::Speed, folder: root.path().to_owned() };
        let config = CaseConfig::of("wall_angle_deg = 90", "");
        let take = |t: usize| {
            let [metres, speed] = [0.0013, 0.02];
            let points = codec::tests::frame(t).into_iter();
            let points = points.map(|[x, y, c]| [metres * x, metres * y, speed * c]).collect();
            Take { time_s: 0.05 * t as f64, walls: [0.0; 2], points }
        };
        let takes: Vec<_> = (0..60).map(take).collect();
        let mut result = made_up(&config);
        let row = |k: usize| HistoryRow { time_s: 0.003 * k as f64, ..result.history[k % 20] };
        result.history = (0..1000).map(row).collect();
        film.write(&config, &result, &takes, 58).unwrap();
        let page = fs::metadata(film.path(CaseId::of(&config))).unwrap().len();
        assert!(page < 400_000, "{page} bytes");
    }
}
