use super::*;

pub(in crate::accuracy) const TEXT: &str = r#"
name = "small"
[[case]]
name = "still"
about = "water at rest"
quick = true
scene = { wave_height_ratio = 0.0, end_time_s = 1.0 }
truth = { force_end = 1.0 }
pass = { force_end = [0.9, 1.1] }
[[case]]
name = "wave"
about = "a wave"
methods = ["plain"]
scene = { wave_height_ratio = 0.3 }
[case.same]
case = "still"
tolerance = 0.1
quantities = ["force_end"]
[[method]]
name = "plain"
quick = true
[[method]]
name = "odd"
numerics = { kernel = "no-such-kernel" }
[[method]]
name = "plain-again"
numerics = { courant_number = 1.8 }
"#;

#[test]
fn a_matrix_becomes_a_study() {
    let matrix = Matrix::read(TEXT).unwrap();
    let (study, pairs) = matrix.study(false, TEXT);
    let runs: Vec<_> = pairs.iter().map(|pair| pair.run.as_ref().ok().copied()).collect();
    assert_eq!(runs, [Some(0), None, Some(0), Some(1)], "the same numerics run once");
    assert_eq!(study.cases.len(), 2);
    assert!(pairs[1].run.as_ref().unwrap_err().starts_with("numerics.kernel"));
    let (quick, pairs) = matrix.study(true, TEXT);
    assert_eq!((quick.cases.len(), pairs.len()), (1, 1));
    assert_ne!(quick.name, study.name);
}

#[test]
fn bad_matrices_are_told() {
    let told =
        |from: &str, to: &str| Matrix::read(&TEXT.replacen(from, to, 1)).unwrap_err().to_string();
    assert!(told("methods = [\"plain\"]", "methods = [\"fine\"]").contains("case.wave.methods"));
    assert!(told("about", "abuot").contains("abuot"));
    assert!(told("case = \"still\"", "case = \"stil\"").contains("must be one of still, wave"));
}
