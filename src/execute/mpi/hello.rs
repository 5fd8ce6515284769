//! The first message of every rank to rank 0, and how ranks share a node's cores.

use std::ffi::OsString;

use serde::{Deserialize, Serialize};

use crate::execute::{available_cores, host_name, widest_simd};
use crate::math::simd::SimdPath;
use crate::results::{Program, RankInfo, checksum_of};

/// The data of a rank for rank 0.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Hello {
    pub(super) build: String,
    /// Hash of its command line's arguments.
    pub(super) arguments: String,
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
            arguments: arguments_sum(std::env::args_os().skip(1)),
            host: host_name(),
            simd: widest_simd().unwrap_or(SimdPath::Portable),
            cores: available_cores(),
            allowed: allowed.unwrap_or_default().trim().to_owned(),
        }
    }
}

/// A hash that differs if any argument differs, or where one ends.
fn arguments_sum(arguments: impl Iterator<Item = OsString>) -> String {
    let words: Vec<_> = arguments.flat_map(|word| [word, OsString::from("\0")]).collect();
    checksum_of(words.iter().map(|word| word.as_encoded_bytes()))
}

/// The first rank that does not belong to rank 0's job, and why.
pub(super) fn stranger(hellos: &[Hello]) -> Option<(usize, String)> {
    let first = hellos.first()?;
    hellos.iter().enumerate().find_map(|(rank, hello)| {
        if hello.build != first.build {
            return Some((rank, format!("runs build {}, rank 0 {}", hello.build, first.build)));
        }
        let alike = hello.arguments == first.arguments;
        (!alike).then(|| (rank, "was started with other arguments than rank 0".to_owned()))
    })
}

/// Threads for each rank. By default it is the processors that it may use, shared with the ranks on
/// the same node that may use the same ones.
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
        let (build, arguments) = ("a".to_owned(), String::new());
        Hello { build, arguments, host, simd: SimdPath::Portable, cores, allowed }
    }

    #[test]
    fn a_rank_of_another_build_or_with_other_arguments_is_named() {
        let same = || hello("a", 2, "0-1");
        assert_eq!(stranger(&[same(), same()]), None);
        let other = Hello { build: "b".to_owned(), ..same() };
        assert_eq!(stranger(&[same(), other]), Some((1, "runs build b, rank 0 a".to_owned())));
        let sum = |words: &[&str]| arguments_sum(words.iter().map(OsString::from));
        assert!(sum(&["a", "bc"]) != sum(&["ab", "c"]) && sum(&["a"]) == sum(&["a"]));
        let other = Hello { arguments: sum(&["a"]), ..same() };
        let (rank, why) = stranger(&[same(), same(), other]).unwrap();
        assert!(rank == 2 && why.contains("other arguments"), "{why}");
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
