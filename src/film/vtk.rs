//! Files for ParaView: a VTU file each of water, bed and walls per instant, and a PVD file with
//! their times.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::vtu::{Cells, Grid, Values};
use super::{Camera, at};
use crate::body::Place;
use crate::disk;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, Face, Film};
use crate::study::CaseId;

/// Where and how often to film: `<folder>/<case_id>.pvd` and `<folder>/<case_id>/<part>_<number>.vtu`.
#[derive(Debug, Clone)]
pub struct VtkFilm {
    /// Time between two instants, seconds of simulated time.
    pub interval_s: f64,
    /// Where the files go.
    pub folder: PathBuf,
}

impl VtkFilm {
    pub(super) fn camera(&self, config: &CaseConfig) -> io::Result<VtkCamera> {
        let has_paddle = config.scene.seawall().is_some_and(|scene| scene.paddle().is_some());
        let id = CaseId::of(config).to_string();
        VtkCamera::new(&self.folder, id, self.interval_s, has_paddle)
    }
}

/// The place of a case's files, the times of the instants, and the first error.
pub(super) struct VtkCamera {
    interval_s: f64,
    folder: PathBuf,
    id: String,
    has_paddle: bool,
    /// Times, and the names of the files' parts.
    taken: io::Result<Vec<(f64, Vec<&'static str>)>>,
}

impl VtkCamera {
    fn new(folder: &Path, id: String, interval_s: f64, has_paddle: bool) -> io::Result<VtkCamera> {
        let own = folder.join(&id);
        fs::create_dir_all(&own).map_err(at(&own))?;
        Ok(VtkCamera {
            interval_s,
            folder: folder.to_owned(),
            id,
            has_paddle,
            taken: Ok(Vec::new()),
        })
    }

    /// The name of a body.
    fn name(&self, place: Place) -> &'static str {
        match place {
            Place::Bed => "bed",
            Place::Left if self.has_paddle => "paddle",
            Place::Left => "left_wall",
            Place::Right => "wall",
            Place::Lid => "lid",
            Place::Behind => "behind",
        }
    }

    /// Writes the files of an instant; returns their names.
    fn write(&self, number: usize, film: &Film<'_>) -> io::Result<Vec<&'static str>> {
        let faces = film.faces.iter().map(|seen| (self.name(seen.place), face(seen)));
        let mut names = Vec::new();
        for (name, grid) in std::iter::once(("water", water(film))).chain(faces) {
            let file = self.folder.join(path(&self.id, name, number));
            disk::put(&file, grid.text(film.time_s)).map_err(at(&file))?;
            names.push(name);
        }
        Ok(names)
    }
}

/// A file's path from the folder.
fn path(id: &str, name: &str, number: usize) -> String {
    format!("{id}/{name}_{number:05}.vtu")
}

impl Camera for VtkCamera {
    fn interval_s(&self) -> f64 {
        self.interval_s
    }

    fn sees_faces(&self) -> bool {
        true
    }

    fn shoot(&mut self, film: &Film<'_>) {
        let Ok(taken) = &mut self.taken else { return };
        // A run that became unstable starts again.
        taken.retain(|(time_s, _)| *time_s < film.time_s);
        let number = taken.len();
        match self.write(number, film) {
            Ok(names) => {
                self.taken.iter_mut().for_each(|all| all.push((film.time_s, names.clone())))
            }
            Err(error) => self.taken = Err(error),
        }
    }

    fn finish(self: Box<Self>, _: &CaseResult) -> io::Result<()> {
        self.list()
    }

    fn stop(self: Box<Self>) {
        // The run's own failure is reported instead.
        let _ = self.list();
    }
}

impl VtkCamera {
    /// Writes the list of instants.
    fn list(self) -> io::Result<()> {
        let mut text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n\
            <Collection>\n"
            .to_owned();
        for (number, (time, names)) in self.taken?.iter().enumerate() {
            for (part, name) in names.iter().enumerate() {
                let file = path(&self.id, name, number);
                let place = format!("part=\"{part}\" name=\"{name}\"");
                let _ = writeln!(text, "<DataSet timestep=\"{time}\" {place} file=\"{file}\"/>");
            }
        }
        text.push_str("</Collection>\n</VTKFile>\n");
        let list = self.folder.join(format!("{}.pvd", self.id));
        disk::put(&list, text).map_err(at(&list))
    }
}

/// A vertex per particle with pressure, velocity, density and number, in the order of the numbers.
fn water(film: &Film<'_>) -> Grid {
    let Film { fluid, pressure, .. } = *film;
    let mut order: Vec<usize> = (0..fluid.len()).collect();
    order.sort_unstable_by_key(|&k| fluid.id[k]);
    let scalars = |all: &[f64]| Values::Scalars(order.iter().map(|&k| all[k]).collect());
    let vectors =
        |x: &[f64], y: &[f64]| order.iter().map(|&k| [x[k], y[k]]).collect::<Vec<[f64; 2]>>();
    Grid {
        cells: Cells::Vertices,
        points: vectors(&fluid.x, &fluid.y),
        values: vec![
            (PRESSURE, scalars(pressure)),
            (VELOCITY, Values::Vectors(vectors(&fluid.vx, &fluid.vy))),
            ("density_kg_per_m3", scalars(&fluid.density)),
            ("id", Values::Whole(order.iter().map(|&k| fluid.id[k]).collect())),
        ],
    }
}

/// A body's face as lines, with the water's pressure on it and its own velocity.
fn face(face: &Face) -> Grid {
    let velocity = vec![[face.velocity, 0.0]; face.points.len()];
    Grid {
        cells: Cells::Lines,
        points: face.points.clone(),
        values: vec![
            (PRESSURE, Values::Scalars(face.pressure.clone())),
            (VELOCITY, Values::Vectors(velocity)),
        ],
    }
}

const PRESSURE: &str = "pressure_pa";
const VELOCITY: &str = "velocity_m_per_s";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairs::Fluid;
    use crate::results::made_up;

    #[test]
    fn a_film_has_a_file_for_every_part_and_a_list() {
        let root = tempfile::tempdir().unwrap();
        let fluid = Fluid::at_rest((0..3).map(|k| [f64::from(k), 0.5, 1000.0, 1.0]));
        let mut camera = VtkCamera::new(root.path(), "case".to_owned(), 0.1, true).unwrap();
        let points = vec![[0.0, 0.0], [0.0, 1.0]];
        let place = Place::Left;
        let face = Face { place, velocity: 0.5, points, pressure: vec![9.0, 0.0] };
        let shoot = |camera: &mut VtkCamera, time_s| {
            let (pressure, faces) = (&[1.0, 2.5, 3.0, 0.0], std::slice::from_ref(&face));
            camera.shoot(&Film { time_s, fluid: &fluid, pressure, walls: [0.0; 2], faces });
        };
        // The second attempt of a run replaces the first.
        [0.0, 0.1, 0.2, 0.0, 0.15].into_iter().for_each(|time_s| shoot(&mut camera, time_s));
        let result = made_up(&CaseConfig::of("", ""));
        Box::new(camera).finish(&result).unwrap();
        let list = fs::read_to_string(root.path().join("case.pvd")).unwrap();
        let paddle = "timestep=\"0.15\" part=\"1\" name=\"paddle\" file=\"case/paddle_00001.vtu\"";
        assert!(list.contains(paddle), "{list}");
        assert_eq!(list.matches("<DataSet").count(), 4, "{list}");
        let water = fs::read_to_string(root.path().join("case/water_00001.vtu")).unwrap();
        assert!(water.contains("NumberOfPoints=\"3\"") && water.contains("density_kg_per_m3"));

        // A failed run once left its instants without the list that opens them.
        let mut failed = VtkCamera::new(root.path(), "failed".to_owned(), 0.1, true).unwrap();
        shoot(&mut failed, 0.0);
        Box::new(failed).stop();
        let list = fs::read_to_string(root.path().join("failed.pvd")).unwrap();
        assert_eq!(list.matches("<DataSet").count(), 2, "{list}");
    }
}
