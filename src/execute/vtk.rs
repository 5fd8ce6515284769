//! Particles for ParaView: one VTU file per instant and a PVD file that lists them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, Failure, FailureKind, Film, Monitor, Stopped};
use crate::study::CaseId;

/// Where and how often to film: `<folder>/<case_id>.pvd` and `<folder>/<case_id>/<number>.vtu`.
#[derive(Debug, Clone)]
pub struct VtkFilm {
    /// Between two instants, seconds of simulated time.
    pub interval_s: f64,
    /// Where the files go.
    pub folder: PathBuf,
}

impl VtkFilm {
    /// Lets a case run under a monitor that films it and asks `inner` for the rest.
    pub(super) fn shoot(
        &self,
        config: &CaseConfig,
        inner: &dyn Monitor,
        run: impl FnOnce(&dyn Monitor) -> Result<CaseResult, Stopped>,
    ) -> Result<CaseResult, Stopped> {
        let id = CaseId::of(config).to_string();
        let camera = Mutex::new(Camera::new(&self.folder, id).map_err(unwritable)?);
        let filming = Filming { inner, interval_s: self.interval_s, camera };
        let result = run(&filming)?;
        let camera = filming.camera.into_inner().unwrap_or_else(PoisonError::into_inner);
        camera.finish().map_err(unwritable)?;
        Ok(result)
    }
}

fn unwritable(error: io::Error) -> Stopped {
    let detail = format!("vtk: {error}");
    Stopped::Failed(Failure { kind: FailureKind::Internal, time_s: 0.0, detail })
}

/// Films a run, for its own monitor's eyes too.
struct Filming<'a> {
    inner: &'a dyn Monitor,
    interval_s: f64,
    camera: Mutex<Camera>,
}

impl Monitor for Filming<'_> {
    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }

    fn film_interval(&self) -> Option<f64> {
        Some(self.interval_s)
    }

    fn film(&self, film: &Film<'_>) {
        self.camera.lock().unwrap_or_else(PoisonError::into_inner).shoot(film);
    }
}

/// Where the pictures of a case go, the times of those taken, and the first error.
struct Camera {
    folder: PathBuf,
    id: String,
    taken: io::Result<Vec<f64>>,
}

impl Camera {
    fn new(folder: &Path, id: String) -> io::Result<Camera> {
        fs::create_dir_all(folder.join(&id))?;
        Ok(Camera { folder: folder.to_owned(), id, taken: Ok(Vec::new()) })
    }

    fn shoot(&mut self, film: &Film<'_>) {
        let Ok(taken) = &mut self.taken else { return };
        let name = format!("{:05}.vtu", taken.len());
        match fs::write(self.folder.join(&self.id).join(name), vtu(film)) {
            Ok(()) => taken.push(film.time_s),
            Err(error) => self.taken = Err(error),
        }
    }

    /// Lists what was taken.
    fn finish(self) -> io::Result<()> {
        let mut text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n\
            <Collection>\n"
            .to_owned();
        for (number, time) in self.taken?.iter().enumerate() {
            let file = format!("{}/{number:05}.vtu", self.id);
            let _ = writeln!(text, "<DataSet timestep=\"{time}\" file=\"{file}\"/>");
        }
        text.push_str("</Collection>\n</VTKFile>\n");
        fs::write(self.folder.join(format!("{}.pvd", self.id)), text)
    }
}

/// One instant: a vertex per particle with velocity, pressure, density and number.
fn vtu(film: &Film<'_>) -> String {
    let Film { fluid, pressure, .. } = *film;
    let n = fluid.len();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{n}\">\n<Points>\n"
    );
    array(&mut text, "Float64", "", 3, (0..n).flat_map(|k| [fluid.x[k], fluid.y[k], 0.0]));
    text.push_str("</Points>\n<Cells>\n");
    array(&mut text, "Int32", "connectivity", 1, 0..n);
    array(&mut text, "Int32", "offsets", 1, 1..=n);
    array(&mut text, "UInt8", "types", 1, std::iter::repeat_n(1, n));
    text.push_str("</Cells>\n<PointData Scalars=\"pressure_pa\" Vectors=\"velocity_m_per_s\">\n");
    let velocity = (0..n).flat_map(|k| [fluid.vx[k], fluid.vy[k], 0.0]);
    array(&mut text, "Float64", "velocity_m_per_s", 3, velocity);
    array(&mut text, "Float64", "pressure_pa", 1, &pressure[..n]);
    array(&mut text, "Float64", "density_kg_per_m3", 1, &fluid.density[..n]);
    array(&mut text, "UInt32", "id", 1, &fluid.id[..n]);
    text.push_str("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

fn array<T: std::fmt::Display>(
    text: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    values: impl IntoIterator<Item = T>,
) {
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">"
    );
    for (number, value) in values.into_iter().enumerate() {
        let end = if (number + 1).is_multiple_of(components) { '\n' } else { ' ' };
        let _ = write!(text, "{value}{end}");
    }
    text.push_str("</DataArray>\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairs::Fluid;

    #[test]
    fn a_film_has_all_particles_and_a_list() {
        let root = tempfile::tempdir().unwrap();
        let fluid = Fluid::at_rest((0..3).map(|k| [f64::from(k), 0.5, 1000.0, 1.0]));
        let mut camera = Camera::new(root.path(), "case".to_owned()).unwrap();
        for k in 0..2 {
            let time_s = 0.1 * f64::from(k);
            camera.shoot(&Film { time_s, fluid: &fluid, pressure: &[1.0, 2.5, 3.0, 0.0] });
        }
        camera.finish().unwrap();
        let list = fs::read_to_string(root.path().join("case.pvd")).unwrap();
        assert!(list.contains("<DataSet timestep=\"0.1\" file=\"case/00001.vtu\"/>"), "{list}");
        let film = fs::read_to_string(root.path().join("case/00001.vtu")).unwrap();
        assert!(film.contains("NumberOfPoints=\"3\"") && film.contains("\n1\n2.5\n3\n"), "{film}");
        let (open, close) =
            (film.matches("<DataArray").count(), film.matches("</DataArray").count());
        assert_eq!((open, close), (8, 8));
    }
}
