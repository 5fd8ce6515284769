//! Whether an MPI launcher started this process, and its rank and number of processes.

/// The data of a launcher in the environment.
///
/// `SLURM_*` is not used on purpose: plain batch shells have it too.
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
        Launcher {
            present: present.iter().any(|name| variable(name).is_some()),
            size: number(&["OMPI_COMM_WORLD_SIZE", "PMI_SIZE"]),
            rank: number(&["OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"]).unwrap_or(0),
            several: number(&["OMPI_NUM_APP_CTX"]).is_some_and(|commands| commands > 1),
        }
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
        let open_mpi = launcher(&[("OMPI_COMM_WORLD_SIZE", "4"), ("OMPI_COMM_WORLD_RANK", "2")]);
        assert_eq!(open_mpi, Launcher { present: true, size: Some(4), rank: 2, several: false });
        assert!(!launcher(&[("OMPI_NUM_APP_CTX", "1")]).several);
        assert!(launcher(&[("OMPI_NUM_APP_CTX", "2")]).several);
        assert!(open_mpi.is_parallel());
        assert!(!launcher(&[("PMI_SIZE", "1"), ("PMI_RANK", "0")]).is_parallel());
        assert!(launcher(&[("PMIX_RANK", "0")]).is_parallel());
    }
}
