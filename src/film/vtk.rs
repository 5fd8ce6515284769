//! Particles for ParaView: one VTU file per instant and a PVD file that lists them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::Camera;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, Film};
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
    pub(super) fn camera(&self, config: &CaseConfig) -> io::Result<VtkCamera> {
        VtkCamera::new(&self.folder, CaseId::of(config).to_string(), self.interval_s)
    }
}

/// Where the pictures of a case go, the times of those taken, and the first error.
pub(super) struct VtkCamera {
    interval_s: f64,
    folder: PathBuf,
    id: String,
    taken: io::Result<Vec<f64>>,
}

impl VtkCamera {
    fn new(folder: &Path, id: String, interval_s: f64) -> io::Result<VtkCamera> {
        fs::create_dir_all(folder.join(&id))?;
        Ok(VtkCamera { interval_s, folder: folder.to_owned(), id, taken: Ok(Vec::new()) })
    }
}

impl Camera for VtkCamera {
    fn interval_s(&self) -> f64 {
        self.interval_s
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
    fn finish(self: Box<Self>, _: &CaseResult) -> io::Result<()> {
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
    use crate::results::made_up;

    #[test]
    fn a_film_has_all_particles_and_a_list() {
        let root = tempfile::tempdir().unwrap();
        let fluid = Fluid::at_rest((0..3).map(|k| [f64::from(k), 0.5, 1000.0, 1.0]));
        let mut camera = VtkCamera::new(root.path(), "case".to_owned(), 0.1).unwrap();
        for k in 0..2 {
            let time_s = 0.1 * f64::from(k);
            let pressure = &[1.0, 2.5, 3.0, 0.0];
            camera.shoot(&Film { time_s, fluid: &fluid, pressure, walls: [0.0; 2] });
        }
        let result =
            made_up(&CaseConfig::from_tables(&toml::Table::new(), &toml::Table::new()).unwrap());
        Box::new(camera).finish(&result).unwrap();
        let list = fs::read_to_string(root.path().join("case.pvd")).unwrap();
        assert!(list.contains("<DataSet timestep=\"0.1\" file=\"case/00001.vtu\"/>"), "{list}");
        let film = fs::read_to_string(root.path().join("case/00001.vtu")).unwrap();
        assert!(film.contains("NumberOfPoints=\"3\"") && film.contains("\n1\n2.5\n3\n"), "{film}");
        let (open, close) =
            (film.matches("<DataArray").count(), film.matches("</DataArray").count());
        assert_eq!((open, close), (8, 8));
    }
}
