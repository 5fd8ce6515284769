//! Films of the water. A camera is a [`Monitor`] that receives a run's water. It reads, and changes
//! nothing.
//!
//! - `vtk` and `vtu`: files for ParaView, with all data of the particles, and the walls;
//! - [`PageFilm`]: a page that plays in a browser, and a still of the crest at the wall. `camera`
//!   stores the frames, a `take` each; `reel`, `codec` and `coder` pack them, with the `curves` under them. `stage` has the
//!   surroundings of the water. `title` names the film; `page` and `still` draw it, with
//!   a `legend`.

mod camera;
mod codec;
mod coder;
mod curves;
mod legend;
mod page;
mod reel;
mod scale;
mod stage;
mod still;
mod take;
mod title;
mod tops;
mod vtk;
mod vtu;

use std::io;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

pub use page::PageFilm;
pub use scale::Colour;
pub use vtk::VtkFilm;

use crate::keys::named;
use crate::math::words::in_words;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, Film, HistoryRow, Monitor, Stopped};

/// How cases are filmed.
#[derive(Debug, Clone)]
pub enum Filming {
    /// For ParaView.
    Vtk(VtkFilm),
    /// As a page that plays.
    Page(PageFilm),
}

/// Names the file that an error concerns.
fn at(path: &Path) -> impl Fn(io::Error) -> io::Error + '_ {
    move |error| io::Error::new(error.kind(), format!("{}: {}", named(path), in_words(&error)))
}

/// Whether there are readings: without a wall there is no force and no runup.
fn is_read(result: &CaseResult, of: fn(&HistoryRow) -> f64) -> bool {
    result.history.iter().any(|row| of(row) != 0.0)
}

/// Watches one run.
trait Camera: Send {
    /// Time between two instants, seconds of simulated time.
    fn interval_s(&self) -> f64;

    /// Whether it needs the faces of walls.
    fn sees_faces(&self) -> bool {
        false
    }

    /// Takes an instant.
    fn shoot(&mut self, film: &Film<'_>);

    /// Writes the remaining files after a successful run.
    fn finish(self: Box<Self>, result: &CaseResult) -> io::Result<()>;

    /// The run has failed or was stopped. Files that were written stay.
    fn stop(self: Box<Self>) {}
}

impl Filming {
    /// Runs a case under a monitor that films it and passes all else to `inner`. If a film cannot
    /// be written, the result stays, and the film's error is returned beside it.
    ///
    /// # Errors
    /// The run's own.
    pub fn shoot(
        &self,
        config: &CaseConfig,
        inner: &dyn Monitor,
        run: impl FnOnce(&dyn Monitor) -> Result<CaseResult, Stopped>,
    ) -> Result<(CaseResult, io::Result<()>), Stopped> {
        let camera: Box<dyn Camera> = match self {
            Filming::Vtk(film) => match film.camera(config) {
                Ok(camera) => Box::new(camera),
                Err(error) => return Ok((run(inner)?, Err(error))),
            },
            Filming::Page(film) => Box::new(film.camera(config)),
        };
        let (interval_s, faces) = (camera.interval_s(), camera.sees_faces());
        let set = Set { inner, interval_s, faces, camera: Mutex::new(camera) };
        let result = run(&set);
        let camera = set.camera.into_inner().unwrap_or_else(PoisonError::into_inner);
        match result {
            Ok(result) => {
                let written = camera.finish(&result);
                Ok((result, written))
            }
            Err(stopped) => {
                camera.stop();
                Err(stopped)
            }
        }
    }
}

/// Films a run, and passes films on to its own monitor. A filmed run stores no checkpoints, because
/// its film could not go on from them.
struct Set<'a> {
    inner: &'a dyn Monitor,
    interval_s: f64,
    faces: bool,
    camera: Mutex<Box<dyn Camera + 'a>>,
}

impl Monitor for Set<'_> {
    fn inner(&self) -> Option<&dyn Monitor> {
        Some(self.inner)
    }

    fn film_interval(&self) -> Option<f64> {
        Some(self.interval_s)
    }

    fn films_faces(&self) -> bool {
        self.faces
    }

    fn film(&self, film: &Film<'_>) {
        self.camera.lock().unwrap_or_else(PoisonError::into_inner).shoot(film);
    }
}
