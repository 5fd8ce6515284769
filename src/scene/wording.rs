//! Reading tables, and plain words for what does not fit them.

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::error::ConfigError;

/// Deserialises a table.
///
/// # Errors
/// The first unknown key or value that does not fit, by its key, its value and what is allowed.
pub(super) fn read_table<T: DeserializeOwned>(
    section: &str,
    table: Table,
    known: &[String],
) -> Result<T, ConfigError> {
    if let Some(key) = table.keys().find(|key| !known.contains(key)) {
        return Err(ConfigError::unknown(&format!("{section}.{key}"), known));
    }
    let values = table.clone();
    serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
        let message = error.inner().to_string();
        if let Some(key) = quoted(&message).filter(|_| message.starts_with("missing field")) {
            return ConfigError::new(&format!("{section}.{key}"), "", "is missing");
        }
        let key = error.path().to_string();
        let path = format!("{section}.{key}");
        let Some(value) = values.get(&key) else {
            return ConfigError::new(&path, "", first_line(&message));
        };
        match names::<T>(&key, &values) {
            Some(names) => ConfigError::one_of(&path, value, &names),
            None => ConfigError::new(&path, value, allowed(&message)),
        }
    })
}

/// The names that a key takes, where it takes names: what the deserialiser says to one that is none.
fn names<T: DeserializeOwned>(key: &str, values: &Table) -> Option<Vec<String>> {
    let mut values = values.clone();
    values.insert(key.to_owned(), Value::String(String::new()));
    let error = serde_path_to_error::deserialize::<_, T>(Value::Table(values)).err()?;
    let message = error.inner().to_string();
    let listed = message.strip_prefix("unknown variant ``, expected ")?;
    Some(first_line(listed).split('`').skip(1).step_by(2).map(str::to_owned).collect())
}

/// What a type takes.
fn allowed(message: &str) -> String {
    let line = first_line(message);
    let plain = match line.rsplit_once("expected ").map(|(_, expected)| expected) {
        Some("f64" | "f32") => "must be a number",
        Some("u8" | "u16" | "u32" | "u64" | "usize") => "must be a whole number, 0 or above",
        Some("a boolean") => "must be true or false",
        Some("a string") => "must be a string",
        _ => line,
    };
    plain.to_owned()
}

fn first_line(message: &str) -> &str {
    message.trim().lines().next().unwrap_or_default()
}

/// What stands between the first backticks.
fn quoted(message: &str) -> Option<&str> {
    message.split('`').nth(1)
}

/// The field names of a struct, as its own deserialiser states them.
pub(super) fn serde_keys<T: DeserializeOwned>() -> Vec<String> {
    struct Names(Vec<String>);
    impl<'de> serde::Deserializer<'de> for &mut Names {
        type Error = serde::de::value::Error;
        fn deserialize_any<V: serde::de::Visitor<'de>>(
            self,
            _: V,
        ) -> Result<V::Value, Self::Error> {
            Err(serde::de::Error::custom("only field names are asked for"))
        }
        fn deserialize_struct<V: serde::de::Visitor<'de>>(
            self,
            _: &'static str,
            fields: &'static [&'static str],
            visitor: V,
        ) -> Result<V::Value, Self::Error> {
            self.0 = fields.iter().map(|name| (*name).to_owned()).collect();
            self.deserialize_any(visitor)
        }
        serde::forward_to_deserialize_any! {
            bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit
            unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
        }
    }
    let mut names = Names(Vec::new());
    let _ = T::deserialize(&mut names);
    names.0
}

#[cfg(test)]
mod tests {
    use super::super::config::CaseConfig;

    #[test]
    fn what_is_allowed_is_told_in_plain_words() {
        let names = "must be one of none, pair, triple";
        let bad = [
            ("", "error_bars = true", format!("numerics.error_bars = true: {names}")),
            ("", "error_bars = { a = 1 }", format!("numerics.error_bars = {{ a = 1 }}: {names}")),
            (
                "",
                "boundary = \"sdfi\"",
                "numerics.boundary = \"sdfi\": must be one of improved-shepard, normalized, sfdi, \
                 mls-linear, mls-quadratic, dummy; did you mean sfdi?"
                    .to_owned(),
            ),
            (
                "",
                "boundary = \"brick\"",
                "numerics.boundary = \"brick\": must be one of improved-shepard, normalized, sfdi, \
                 mls-linear, mls-quadratic, dummy"
                    .to_owned(),
            ),
            (
                "wave_height_ratio = \"high\"",
                "",
                "scene.wave_height_ratio = \"high\": must be a number".to_owned(),
            ),
            ("", "retries = -1", "numerics.retries = -1: must be a whole number, 0 or above".into()),
            ("", "retries = 1.5", "numerics.retries = 1.5: must be a whole number, 0 or above".into()),
            (
                "",
                "corrected_gradients = 1",
                "numerics.corrected_gradients = 1: must be true or false".to_owned(),
            ),
            (
                "wall = \"moveable\"",
                "",
                "scene.wall = \"moveable\": must be one of fixed, movable, caisson; did you mean movable?"
                    .to_owned(),
            ),
            (
                "kind = \"dambreak\"",
                "",
                "scene.kind = \"dambreak\": must be one of hydrostatic, dam-break, seawall, \
                 standing-wave, taylor-green, rotating-patch, oscillating-drop; did you mean \
                 dam-break?"
                    .to_owned(),
            ),
            (
                "kind = \"hydrostatic\"\nseawall_mass_kg_per_m = 1",
                "",
                "scene.seawall_mass_kg_per_m: unknown key of kind = \"hydrostatic\"; kind = \
                 \"seawall\" has it"
                    .to_owned(),
            ),
            (
                "particle_spacing_m = 0.01",
                "",
                "scene.particle_spacing_m: unknown key; did you mean numerics.particle_spacing_m?"
                    .to_owned(),
            ),
            (
                "",
                "wave_height_ratio = 0.3",
                "numerics.wave_height_ratio: unknown key; did you mean scene.wave_height_ratio?"
                    .to_owned(),
            ),
            ("", "colour = 1", "numerics.colour: unknown key".to_owned()),
        ];
        for (scene, numerics, message) in bad {
            let told = CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap());
            assert_eq!(told.unwrap_err().to_string(), message);
        }
    }
}
