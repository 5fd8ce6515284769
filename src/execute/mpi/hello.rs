//! Getting acquainted: what every rank tells rank 0, and how ranks share a node's cores.

use serde::{Deserialize, Serialize};

use crate::execute::{available_cores, host_name};
use crate::math::simd::SimdPath;
use crate::results::{Program, RankInfo};

/// What rank 0 has to know of a rank.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Hello {
    pub(super) build: String,
    pub(super) host: String,
    pub(super) simd: SimdPath,
    pub(super) cores: usize,
    /// The processors that it may run on, as the kernel lists them.
    pub(super) allowed: String,
}

impl Hello {
    pub(super) fn of_this_process() -> Hello {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let allowed = status.lines().find_map(|line| line.strip_prefix("Cpus_allowed_list:"));
        Hello {
            build: Program::this().to_string(),
            host: host_name(),
            simd: SimdPath::widest(),
            cores: available_cores(),
            allowed: allowed.unwrap_or_default().trim().to_owned(),
        }
    }
}

/// Threads for each rank: by default the processors that it may use, shared with the ranks on the
/// same node that may use the same ones.
pub(super) fn share_cores(hellos: &[Hello], threads: Option<usize>) -> Vec<RankInfo> {
    let share = |hello: &Hello| {
        let same = |other: &&Hello| other.host == hello.host && other.allowed == hello.allowed;
        let sharing = hellos.iter().filter(same).count().max(1);
        threads.unwrap_or(hello.cores / sharing).max(1)
    };
    hellos.iter().map(|hello| RankInfo::new(hello.host.clone(), share(hello))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hello(host: &str, cores: usize, allowed: &str) -> Hello {
        let (host, allowed) = (host.to_owned(), allowed.to_owned());
        Hello { build: String::new(), host, simd: SimdPath::Portable, cores, allowed }
    }

    fn threads(hellos: &[Hello]) -> Vec<usize> {
        share_cores(hellos, None).iter().map(|rank| rank.threads).collect()
    }

    #[test]
    fn ranks_share_the_cores_that_they_share() {
        assert_eq!(threads(&[hello("a", 8, "0-7"), hello("a", 8, "0-7")]), [4, 4]);
        assert_eq!(threads(&[hello("a", 1, "0"), hello("a", 1, "1")]), [1, 1]);
        assert_eq!(threads(&[hello("a", 2, "0-1"), hello("b", 4, "0-1")]), [2, 4]);
        assert_eq!(threads(&vec![hello("a", 2, "0-1"); 4]), [1; 4]);
    }
}
