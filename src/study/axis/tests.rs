use super::*;

fn read(text: &str) -> Result<GridAxis, ConfigError> {
    let table: Table = format!("x = {text}").parse().unwrap();
    GridAxis::read("x", &table["x"], false)
}

fn numbers(text: &str) -> Vec<f64> {
    read(text).unwrap().values.iter().map(|value| number(value).unwrap()).collect()
}

#[test]
fn ranges_hit_round_numbers() {
    let decades = numbers("{ from = 0.01, to = 1e7, points = 10, spacing = \"log\" }");
    assert_eq!(decades, [0.01, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7]);
    let steps = numbers("{ from = 0.1, to = 0.7, points = 7 }");
    assert_eq!(steps, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
}

#[test]
fn a_bed_is_a_value() {
    let axis = read("[[[0, 0], [1, 0.1]], [[0, 0], [1, 0.2]]]").unwrap();
    assert_eq!((axis.values.len(), axis.numbers()), (2, None));
    assert_eq!(axis.first(), "x=[[0, 0], [1, 0.1]]");
}

/// More bad axes are in `tests/bad_inputs`.
#[test]
fn every_bad_axis_is_told_with_its_key() {
    let bad = [
        ("[1, nan]", "grid.x = nan: must be a finite number"),
        ("[1, 2, 1.0]", "grid.x = 1.0: stands in the list twice"),
        (
            "{ from = 1, to = 2, points = 1000000000 }",
            "grid.x.points = 1000000000: must be a whole number from 2 to 1000000",
        ),
        (
            "{ from = 1, to = 2, step = 0.5 }",
            "grid.x.step: unknown key; must be one of from, to, points, spacing",
        ),
    ];
    for (text, message) in bad {
        let told = read(text).unwrap_err().to_string();
        assert!(told.starts_with(message), "{told:?} should start with {message:?}");
    }
}
