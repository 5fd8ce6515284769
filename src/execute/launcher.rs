//! Whether an MPI launcher started this process, and its rank and number of processes.

/// The data of a launcher in the environment.
///
/// Of `SLURM_*` only a step's own number of processes and rank count, where there are several: plain
/// batch shells have the rest, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Launcher {
    /// Whether there is a launcher.
    pub present: bool,
    /// Number of processes, if given.
    pub size: Option<usize>,
    /// This process's rank; 0 if not given.
    pub rank: usize,
    /// Whether the launcher's command line has several commands, separated by colons. Open MPI
    /// provides this.
    pub several: bool,
}

impl Launcher {
    /// Reads the environment.
    pub fn detect() -> Launcher {
        Launcher::from_variables(|name| std::env::var(name).ok())
    }

    fn from_variables(variable: impl Fn(&str) -> Option<String>) -> Launcher {
        let number = |names: &[&str]| {
            names.iter().find_map(|name| variable(name).and_then(|text| text.trim().parse().ok()))
        };
        let present = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"];
        let present = present.iter().any(|name| variable(name).is_some());
        let step = number(&["SLURM_STEP_NUM_TASKS"]).filter(|&size| size > 1);
        let of_step = step.filter(|_| !present).and_then(|_| number(&["SLURM_PROCID"]));
        let rank = number(&["OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"]);
        Launcher {
            present: present || step.is_some(),
            size: number(&["OMPI_COMM_WORLD_SIZE", "PMI_SIZE"]).or(step),
            rank: rank.or(of_step).unwrap_or(0),
            several: number(&["OMPI_NUM_APP_CTX"]).is_some_and(|commands| commands > 1),
        }
    }

    /// Why this process's MPI, which sees `world` processes, does not suit what started it; `None`
    /// where both agree. The processes of another MPI each believe that they are alone.
    pub fn misfit(self, world: usize, mpi: &str) -> Option<String> {
        let size = self.size.filter(|&size| size != world)?;
        Some(format!(
            "the launcher started {size} processes, but this program's MPI sees {world}: take the launcher of \
             {mpi}, under Slurm `srun --mpi=pmix` for Open MPI or `srun --mpi=pmi2` for MPICH"
        ))
    }

    /// Whether other copies of this process run beside it. A launcher that does not give their
    /// number may have started any number.
    pub fn is_parallel(self) -> bool {
        self.present && self.size != Some(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn launcher(variables: &[(&str, &str)]) -> Launcher {
        Launcher::from_variables(|name| {
            let found = variables.iter().find(|(key, _)| *key == name);
            found.map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn only_a_launchers_own_variables_count() {
        assert!(!launcher(&[("SLURM_NTASKS", "8"), ("SLURM_PROCID", "3")]).present);
        let shell = [("SLURM_NTASKS", "8"), ("SLURM_PROCID", "0"), ("SLURM_STEP_NUM_TASKS", "1")];
        assert_eq!(launcher(&shell), Launcher::default());
        let step = launcher(&[("SLURM_STEP_NUM_TASKS", "8"), ("SLURM_PROCID", "3")]);
        assert_eq!(step, Launcher { present: true, size: Some(8), rank: 3, several: false });
        // Inside mpirun a step is one of its daemons.
        let mpirun = [("PMI_SIZE", "4"), ("PMI_RANK", "1"), ("SLURM_STEP_NUM_TASKS", "2")];
        assert_eq!(launcher(&mpirun), Launcher { size: Some(4), rank: 1, ..step });
        let open_mpi = launcher(&[("OMPI_COMM_WORLD_SIZE", "4"), ("OMPI_COMM_WORLD_RANK", "2")]);
        assert_eq!(open_mpi, Launcher { present: true, size: Some(4), rank: 2, several: false });
        assert!(!launcher(&[("OMPI_NUM_APP_CTX", "1")]).several);
        assert!(launcher(&[("OMPI_NUM_APP_CTX", "2")]).several);
        assert!(open_mpi.is_parallel());
        assert!(!launcher(&[("PMI_SIZE", "1"), ("PMI_RANK", "0")]).is_parallel());
        assert!(launcher(&[("PMIX_RANK", "0")]).is_parallel());
    }
    /// The story: each of two processes under the launcher of another MPI took itself for the whole job.
    #[test]
    fn another_mpi_than_the_launchers_is_told() {
        let two = Launcher { present: true, size: Some(2), ..Launcher::default() };
        assert_eq!(two.misfit(2, "MPICH"), None);
        let told = two.misfit(1, "MPICH").unwrap();
        let wanted = "the launcher started 2 processes, but this program's MPI sees 1: take the launcher of MPICH";
        assert!(told.starts_with(wanted), "{told}");
        assert_eq!(Launcher { size: None, ..two }.misfit(1, "MPICH"), None);
        assert_eq!(Launcher::default().misfit(1, "MPICH"), None);
    }
}
