//! Films of the water. A camera is a [`Monitor`] that a run shows its water to; it reads, and changes
//! nothing.
//!
//! - `vtk` and `vtu`: files for ParaView, with everything that a particle has, and the walls;
//! - [`PageFilm`]: one page that plays in a browser, and a still of the crest at the wall. `camera`
//!   keeps what it saw, `reel`, `codec` and `coder` pack it, `stage` knows what stands around the
//!   water, `title` names it, `page` and `still` draw.

mod camera;
mod codec;
mod coder;
mod page;
mod reel;
mod scale;
mod stage;
mod still;
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
use crate::simulation::{CaseResult, Film, Monitor, Stopped};

/// How cases are filmed.
#[derive(Debug, Clone)]
pub enum Filming {
    /// For ParaView.
    Vtk(VtkFilm),
    /// As a page that plays.
    Page(PageFilm),
}

/// Names the file that an error concerns.
fn at(path: &Path) -> impl FnOnce(io::Error) -> io::Error + '_ {
    move |error| io::Error::new(error.kind(), format!("{}: {}", named(path), in_words(&error)))
}

/// What watches one run.
trait Camera: Send {
    /// Between two instants, seconds of simulated time.
    fn interval_s(&self) -> f64;

    /// Whether it looks at the faces of walls.
    fn sees_faces(&self) -> bool {
        false
    }

    /// Takes an instant.
    fn shoot(&mut self, film: &Film<'_>);

    /// Writes what is still to be written, once the run is well.
    fn finish(self: Box<Self>, result: &CaseResult) -> io::Result<()>;

    /// The run has failed, or was stopped: what was written already is left so that it can be looked at.
    fn stop(self: Box<Self>) {}
}

impl Filming {
    /// Lets a case run under a monitor that films it and asks `inner` for the rest. A film that cannot be
    /// written costs no result: its error stands beside it.
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

/// Films a run, for its own monitor's eyes too. A run that is filmed keeps no checkpoints: it could not go on with
/// its film.
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
