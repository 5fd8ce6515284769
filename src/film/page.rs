//! The page that plays a film: particles, curves, style and script in one file.

use std::path::PathBuf;
use std::{fs, io};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::camera::{PageCamera, Take};
use super::codec::{self, Point};
use super::scale::{self, Colour};
use super::stage::Stage;
use super::{at, still};
use crate::math::decimal::significant;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, HistoryRow, cost};
use crate::study::CaseId;

/// Places are whole numbers up to the first of these, eleven bits; up to the next where that takes too
/// much room, as water that is torn apart does.
const FARTHEST: [f64; 3] = [2047.0, 1023.0, 511.0];
/// Room for a particle in a frame, bytes, as long as a film does not fit into little room anyway.
const ROOM: f64 = 0.4;
const LITTLE_ROOM: usize = 100_000;
/// A page of more particles than this would be too large to open.
const MOST_PARTICLES: u64 = 300_000;
/// Points of a curve.
const MOST_POINTS: usize = 800;

/// Where a film goes, and what it shows: `<folder>/<case_id>.html` and `.svg`.
#[derive(Debug, Clone)]
pub struct PageFilm {
    /// What particles are coloured by.
    pub colour: Colour,
    /// Where the files go.
    pub folder: PathBuf,
}

impl PageFilm {
    pub(super) fn camera<'a>(&'a self, config: &'a CaseConfig) -> PageCamera<'a> {
        PageCamera::new(self, config)
    }

    /// Whether a case is small enough for a page.
    ///
    /// # Errors
    /// What is too large, and what helps, in words.
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
        self.folder.join(format!("{id}.html"))
    }

    /// Writes the page and the still of one of the frames.
    pub(super) fn write(
        &self,
        config: &CaseConfig,
        result: &CaseResult,
        takes: &[Take],
        crest: usize,
    ) -> io::Result<()> {
        let Some(take) = takes.get(crest) else { return Ok(()) };
        let stage = Stage::of(config, takes);
        let page = self.path(CaseId::of(config));
        let end = scale::end(takes.iter().flat_map(|take| &take.points).map(|point| point[2]));
        let still = still::Still { stage: &stage, take, colour: self.colour, end };
        let still = still.svg(&caption(config, take, result));
        fs::create_dir_all(&self.folder).map_err(at(&self.folder))?;
        let picture = page.with_extension("svg");
        fs::write(&picture, &still).map_err(at(&picture))?;
        let reel = Reel { takes, crest, stage: &stage, end };
        let film = reel.json(&result.history).to_string().replace('<', "\\u003c");
        let (colour, unit, units) = self.colour.told();
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
            ("{still}", still),
            ("{script}", concat!(include_str!("decode.js"), include_str!("page.js")).to_owned()),
            ("{film}", film),
        ];
        let text = include_str!("page.html").to_owned();
        let text = fields.iter().fold(text, |text, (field, value)| text.replacen(field, value, 9));
        // A page that is there is whole: a sweep goes by that.
        let partial = page.with_extension("html.partial");
        fs::write(&partial, text).map_err(at(&partial))?;
        fs::rename(&partial, &page).map_err(at(&page))
    }
}

/// Frames of a film and what is around them.
struct Reel<'a> {
    takes: &'a [Take],
    crest: usize,
    stage: &'a Stage,
    /// Of the scale of colours.
    end: f64,
}

/// All frames as bytes.
struct Packed {
    /// Metres.
    quantum: f64,
    /// Particles in a column.
    column: usize,
    bytes: Vec<u8>,
}

impl Reel<'_> {
    /// All that the script needs.
    fn json(&self, history: &[HistoryRow]) -> Value {
        let [left, low, span] = self.extent();
        let particles = self.takes[0].points.len();
        let room = (ROOM * (self.takes.len() * particles) as f64) as usize;
        let [finest, coarser @ ..] = FARTHEST.map(|farthest| span / farthest);
        let mut packed = self.pack([left, low], finest);
        for quantum in coarser {
            if packed.bytes.len() > room.max(LITTLE_ROOM) {
                packed = self.pack([left, low], quantum);
            }
        }
        let times = |read: fn(&Take) -> f64| self.takes.iter().map(read).map(brief);
        let mut film = serde_json::to_value(self.stage).unwrap_or_default();
        film["particles"] = json!(particles);
        film["column"] = json!(packed.column);
        film["x0"] = json!(left);
        film["y0"] = json!(low);
        film["quantum"] = json!(packed.quantum);
        film["crest"] = json!(self.crest);
        film["times"] = times(|take| take.time_s).collect();
        film["left"] = times(|take| take.walls[0]).collect();
        film["right"] = times(|take| take.walls[1]).collect();
        film["colours"] = json!(scale::colours());
        film["history"] = curves(history);
        film["data"] = json!(STANDARD.encode(&packed.bytes));
        film
    }

    /// The frames with places in quanta of so many metres from a corner.
    fn pack(&self, [left, low]: [f64; 2], quantum: f64) -> Packed {
        let place = |value: f32, from: f64| ((f64::from(value) - from) / quantum) as f32;
        let point =
            |&[x, y, value]: &Point| [place(x, left), place(y, low), scale::level(value, self.end)];
        let frame = |take: &Take| -> Vec<Point> { take.points.iter().map(point).collect() };
        let frames: Vec<_> = self.takes.iter().map(frame).collect();
        let (order, column) = codec::order(&frames[0], (self.stage.spacing / quantum) as f32);
        Packed { quantum, column, bytes: codec::encode(&frames, &order, column) }
    }

    /// The left and the lower side of all water, and how far it reaches, metres.
    fn extent(&self) -> [f64; 3] {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in self.takes.iter().flat_map(|take| &take.points) {
            for axis in 0..2 {
                low[axis] = low[axis].min(f64::from(point[axis]));
                high[axis] = high[axis].max(f64::from(point[axis]));
            }
        }
        [low[0], low[1], (high[0] - low[0]).max(high[1] - low[1]).max(1e-9)]
    }
}

/// F*, R* and X* over time, each where it changes.
fn curves(history: &[HistoryRow]) -> Value {
    let rows: Vec<_> = history.iter().step_by(history.len().div_ceil(MOST_POINTS).max(1)).collect();
    let read = |read: fn(&HistoryRow) -> f64| rows.iter().map(move |row| brief(read(row)));
    let mut curves = Vec::new();
    let mut curve = |symbol: &str, name: &str, values: Vec<f64>| {
        if values.iter().any(|&value| value != values[0]) {
            curves.push(json!({ "symbol": symbol, "name": name, "values": values }));
        }
    };
    curve("F*", "force on the wall over ρgh²/2", read(|row| row.force).collect());
    curve("R*", "runup over h", read(|row| row.runup).collect());
    curve("X*", "displacement of the wall over h", read(|row| row.displacement).collect());
    json!({ "time_s": read(|row| row.time_s).collect::<Value>(), "curves": curves })
}

fn brief(value: f64) -> f64 {
    significant(value, 5)
}

fn title(config: &CaseConfig) -> String {
    let kind = config.scene.kind();
    match config.scene.seawall() {
        Some(scene) => {
            let wave = if scene.wave_train.is_some() { "Waves" } else { "Wave" };
            format!("{wave} of H/h = {} at a {}", scene.wave_height_ratio, wall(config))
        }
        None if kind == "taylor-green" => "Taylor-Green vortices".to_owned(),
        None => kind[..1].to_uppercase() + &kind[1..].replace('-', " "),
    }
}

/// The wall of a tank in words.
fn wall(config: &CaseConfig) -> String {
    let Some(scene) = config.scene.seawall() else { return String::new() };
    let numbers = [
        (scene.spring_stiffness_n_per_m, "k", " N/m"),
        (scene.seawall_mass_kg_per_m, "m", " kg/m"),
    ];
    let told: String = numbers
        .iter()
        .filter_map(|(value, name, unit)| Some(format!(", {name} = {}{unit}", (*value)?)))
        .collect();
    let kind = match (scene.wall.moves(), scene.spring_stiffness_n_per_m) {
        (false, _) if scene.wall_angle_deg == 90.0 => match &scene.crest {
            Some(crest) => format!("fixed wall of {} m over still water", crest.crest_freeboard_m),
            None => "fixed wall".to_owned(),
        },
        (false, _) => format!("fixed wall at {}°", scene.wall_angle_deg),
        (true, Some(_)) => "wall on a spring".to_owned(),
        (true, None) => "sliding caisson".to_owned(),
    };
    kind + &told
}

fn about(config: &CaseConfig) -> String {
    let spacing = significant(1000.0 * config.numerics.particle_spacing_m, 4);
    format!("Case {}, particles {spacing} mm apart.", CaseId::of(config))
}

fn caption(config: &CaseConfig, take: &Take, result: &CaseResult) -> String {
    let row = |row: &&HistoryRow| (row.time_s - take.time_s).abs();
    let near = result.history.iter().min_by(|a, b| row(a).total_cmp(&row(b)));
    let told = near
        .map_or_else(String::new, |row| format!(", F* = {:.2}, R* = {:.2}", row.force, row.runup));
    format!("{}: t = {:.2} s{told}", title(config), take.time_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::made_up;

    fn tables(text: &str) -> CaseConfig {
        CaseConfig::from_tables(&text.parse().unwrap(), &toml::Table::new()).unwrap()
    }

    #[test]
    fn a_page_needs_nothing_but_itself() {
        let root = tempfile::tempdir().unwrap();
        let film = PageFilm { colour: Colour::Pressure, folder: root.path().join("films") };
        let config = tables(
            "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 50",
        );
        let points: Vec<_> = (0..40)
            .map(|k| [0.1 * (k / 4) as f32, 0.05 * (k % 4) as f32, 100.0 * (3 - k % 4) as f32])
            .collect();
        let take = |k: i32| {
            let time_s = 0.1 * f64::from(k);
            Take { time_s, walls: [0.01 * time_s, 0.0], points: points.clone() }
        };
        let takes: Vec<_> = (0..5).map(take).collect();
        film.write(&config, &made_up(&config), &takes, 2).unwrap();
        let page = fs::read_to_string(film.path(CaseId::of(&config))).unwrap();
        let still =
            fs::read_to_string(film.path(CaseId::of(&config)).with_extension("svg")).unwrap();
        roxmltree::Document::parse(&still).unwrap();
        assert!(!still.contains("<script"));
        for word in ["http:", "https:", "<link", "@import", "url(", "src=", "{film}", "{still}"] {
            assert!(!page.replace("http://www.w3.org/2000/svg", "").contains(word), "{word}");
        }
        for word in ["k = 500 N/m", "<noscript><svg", "aria-label", "\"wall\":\"spring\""] {
            assert!(page.contains(word), "{word}");
        }
    }

    #[test]
    fn a_page_of_sixty_frames_is_small() {
        let root = tempfile::tempdir().unwrap();
        let film = PageFilm { colour: Colour::Speed, folder: root.path().to_owned() };
        let config = tables("wall_angle_deg = 90");
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
