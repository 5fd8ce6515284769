//! Particles for ParaView: one VTU file per instant and a PVD file that lists them.

use std::cell::RefCell;
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::case::CaseId;
use super::runner::Runner;
use crate::scene::CaseConfig;
use crate::simulation::{
    CaseResult, Failure, FailureKind, Film, Monitor, Resources, Stopped, TrunkResult, run_case,
    run_trunk,
};

/// The physics, filmed: `<folder>/<case_id>.pvd` and `<folder>/<case_id>/<number>.vtu`.
#[derive(Debug, Clone)]
pub struct FilmingRunner {
    /// Instruction set and threads.
    pub resources: Resources,
    /// Between two instants, seconds of simulated time.
    pub interval_s: f64,
    /// Where the files go.
    pub folder: PathBuf,
}

impl Runner for FilmingRunner {
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        run_trunk(config, self.resources, monitor)
    }

    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        let id = CaseId::of(config).to_string();
        let camera = Camera::new(&self.folder, &id, self.interval_s).map_err(unwritable)?;
        let camera = Filming { inner: monitor, camera: std::sync::Mutex::new(camera) };
        let result = run_case(config, checkpoint, self.resources, &camera)?;
        let camera = camera.camera.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        camera.finish().map_err(unwritable)?;
        Ok(result)
    }
}

fn unwritable(error: io::Error) -> Stopped {
    let detail = format!("vtk: {error}");
    Stopped::Failed(Failure { kind: FailureKind::Internal, time_s: 0.0, detail })
}

struct Filming<'a> {
    inner: &'a dyn Monitor,
    camera: std::sync::Mutex<Camera>,
}

impl Monitor for Filming<'_> {
    fn progress(&self, share: f64) {
        self.inner.progress(share);
    }

    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }

    fn film_interval(&self) -> Option<f64> {
        self.camera.lock().ok().map(|camera| camera.interval)
    }

    fn film(&self, film: &Film<'_>) {
        if let Ok(camera) = self.camera.lock() {
            camera.shoot(film);
        }
    }
}

struct Camera {
    folder: PathBuf,
    id: String,
    interval: f64,
    taken: RefCell<Vec<f64>>,
    error: RefCell<Option<io::Error>>,
}

impl Camera {
    fn new(folder: &Path, id: &str, interval: f64) -> io::Result<Camera> {
        fs::create_dir_all(folder.join(id))?;
        Ok(Camera {
            folder: folder.to_owned(),
            id: id.to_owned(),
            interval,
            taken: RefCell::default(),
            error: RefCell::default(),
        })
    }

    fn shoot(&self, film: &Film<'_>) {
        let mut taken = self.taken.borrow_mut();
        let name = format!("{:05}.vtu", taken.len());
        match fs::write(self.folder.join(&self.id).join(name), vtu(film)) {
            Ok(()) => taken.push(film.time_s),
            Err(error) => {
                self.error.borrow_mut().get_or_insert(error);
            }
        }
    }

    /// Lists what was taken.
    fn finish(self) -> io::Result<()> {
        if let Some(error) = self.error.into_inner() {
            return Err(error);
        }
        let mut text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n\
            <Collection>\n"
            .to_owned();
        for (number, time) in self.taken.into_inner().iter().enumerate() {
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
        let camera = Camera::new(root.path(), "case", 0.1).unwrap();
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
