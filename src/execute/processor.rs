//! The instruction set of a rank's processor, or the limit that is set for it.

use crate::math::simd::SimdPath;

/// Lowers the instruction set of a process, as if its processor were older.
const LIMIT: &str = "SEAWALL_SIMD_LIMIT";

/// The widest instruction set of this process.
///
/// # Errors
/// The limit in the environment is unknown.
pub fn widest_simd() -> Result<SimdPath, String> {
    limited(SimdPath::widest(), std::env::var_os(LIMIT).map(|it| it.to_string_lossy().into_owned()))
}

fn limited(widest: SimdPath, limit: Option<String>) -> Result<SimdPath, String> {
    let limit = match limit.as_deref() {
        None | Some("") => return Ok(widest),
        Some("avx512") => SimdPath::Avx512,
        Some("avx2") => SimdPath::Avx2,
        Some("portable") => SimdPath::Portable,
        Some(other) => {
            return Err(format!("{LIMIT}={other}: must be avx512, avx2 or portable"));
        }
    };
    Ok(widest.min(limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_only_lowers() {
        let of = |limit: &str| limited(SimdPath::Avx2, Some(limit.to_owned()));
        assert_eq!(of("avx512"), Ok(SimdPath::Avx2));
        assert_eq!(of("portable"), Ok(SimdPath::Portable));
        assert_eq!(of(""), Ok(SimdPath::Avx2));
        assert!(of("sse").unwrap_err().contains("must be avx512, avx2 or portable"));
    }
}
