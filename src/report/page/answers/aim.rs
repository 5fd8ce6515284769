//! Whether a study reaches the error that it aims at.

use std::path::Path;

use crate::disk::names::MAX_ERROR;
use crate::math::words::counted;
use crate::quantities::max_error::Line;
use crate::report::load::Loaded;

/// How many cases have force and displacement within the wanted error; `None` without such an aim.
pub fn met(data: &Loaded) -> Option<String> {
    read(&data.directory.join(MAX_ERROR))
}

fn read(path: &Path) -> Option<String> {
    let lines = csv::Reader::from_path(path).ok()?.into_deserialize();
    let lines: Vec<Line> = lines.map_while(Result::ok).collect();
    let percent = lines.first()?.max_error_percent;
    let kept = lines.iter().filter(|line| line.met).count();
    let cases = counted(lines.len(), "case");
    let rest = if kept < lines.len() { "; max_error.csv tells which" } else { "" };
    Some(format!(
        "By their error bars force and displacement are within the {percent} % that were asked for in {kept} of \
         {cases}{rest}."
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missed_aim_is_told() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("max_error.csv");
        assert_eq!(read(&path), None);
        let told = |rows: &str| {
            let head =
                "case_id,particle_spacing_m,numerics,error_bar_percent,max_error_percent,met";
            std::fs::write(&path, format!("{head}\n{rows}")).unwrap();
            read(&path).unwrap_or_default()
        };
        let well = "a,0.02,\"particle_spacing_m = 0.02, precision = f32\",1.5,2,true\n";
        assert!(told(well).ends_with(" the 2 % that were asked for in 1 of 1 case."));
        let told = told(&format!("{well}b,0.025,particle_spacing_m = 0.025,,2,false\n"));
        assert!(told.ends_with(" in 1 of 2 cases; max_error.csv tells which."), "{told}");
    }
}
