//! Whether values have the same text.

use toml::Value;

/// Whether two values have the same text. 0 and -0 are equal, but have different texts.
pub fn alike(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Float(one), Value::Float(other)) => one.to_bits() == other.to_bits(),
        (Value::Array(one), Value::Array(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| alike(one, other))
        }
        (Value::Table(_), Value::Table(_)) => one.to_string() == other.to_string(),
        _ => one == other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_alike_that_have_one_text() {
        let table: toml::Table =
            "a = [0.0, -0.0, 0, 1, true, \"1\", [[0.0]], [[-0.0]], [], { b = 0.0 }, { b = -0.0 }]"
                .parse()
                .unwrap();
        let values = table["a"].as_array().unwrap();
        for (at, one) in values.iter().enumerate() {
            for (place, other) in values.iter().enumerate() {
                assert_eq!(alike(one, other), at == place, "{one} and {other}");
            }
        }
    }
}
