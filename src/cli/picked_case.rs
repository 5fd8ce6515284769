//! Picking one case of a study: by its id, by the start of it, or by values of swept keys.

use std::str::FromStr;

use super::failure::BadInput;
use crate::keys::{Section, When, hint, number};
use crate::math::lists::different;
use crate::math::words::counted;
use crate::quantities::{meant_by, name_of_symbol};
use crate::scene::{ConfigError, SeawallScene};
use crate::study::{Assignments, Case, Override, Study};

/// A case that may be picked: its id, and the values of the swept keys, none where one means nothing.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    pub(super) id: String,
    pub(super) values: Assignments,
}

/// The only case that fits the words: an id or the start of one, or values of swept keys.
pub(super) fn the_case<'a>(study: &'a Study, words: &[String]) -> Result<&'a Case, BadInput> {
    let choice = |case: &Case| Choice { id: case.id.to_string(), values: case.assignments.clone() };
    let choices: Vec<_> = study.cases.iter().map(choice).collect();
    let fixed = |key: &str| in_every_case(study, key);
    the_one(&study.keys, &fixed, &choices, words).map(|place| &study.cases[place])
}

/// The value of a key that all cases of a study share; `None` if they differ, or none has it.
pub(super) fn in_every_case(study: &Study, key: &str) -> Option<toml::Value> {
    let value = |case: &Case| {
        let scene = toml::Table::try_from(&case.config.scene).ok()?;
        scene.get(key).or(case.config.numerics.table().get(key)).cloned()
    };
    let first = value(study.cases.first()?)?;
    study.cases.iter().all(|case| value(case).as_ref() == Some(&first)).then_some(first)
}

/// The place of the only choice that fits the words. `fixed` tells the value of a key that all of them have.
pub(super) fn the_one(
    keys: &[String],
    fixed: &dyn Fn(&str) -> Option<toml::Value>,
    choices: &[Choice],
    words: &[String],
) -> Result<usize, BadInput> {
    let mut fitting: Vec<&Choice> = choices.iter().collect();
    for word in words {
        if word.contains('=') {
            keep_with_value(&mut fitting, keys, fixed, word)?;
        } else {
            keep_with_id(&mut fitting, word)?;
        }
    }
    let place = |one: &Choice| choices.iter().position(|choice| choice.id == one.id);
    if let [one] = fitting[..]
        && let Some(place) = place(one)
    {
        return Ok(place);
    }
    let open = (0..keys.len()).filter(|&place| values(&fitting, place).contains(','));
    let open: Vec<_> =
        open.map(|place| format!("{} ({})", keys[place], values(&fitting, place))).collect();
    let cases = counted(fitting.len(), "case");
    let by = if open.is_empty() { "more digits of its id".to_owned() } else { open.join(", ") };
    Err(BadInput(format!("{cases} fit; say which one by {by}")))
}

fn keep_with_id(fitting: &mut Vec<&Choice>, word: &str) -> Result<(), BadInput> {
    fitting.retain(|choice| choice.id.starts_with(word));
    if fitting.is_empty() {
        let allowed = "no case of this study has an id that starts so; name one by its id, the start \
                       of it, or KEY=VALUE of swept keys";
        return Err(BadInput(format!("{word}: {allowed}")));
    }
    Ok(())
}

fn keep_with_value(
    fitting: &mut Vec<&Choice>,
    keys: &[String],
    fixed: &dyn Fn(&str) -> Option<toml::Value>,
    word: &str,
) -> Result<(), BadInput> {
    let wanted = Override::from_str(word).map_err(|error| BadInput(format!("{word}: {error}")))?;
    let path = wanted.path();
    let key = path.rsplit('.').next().unwrap_or_default();
    let place = |key: &str| keys.iter().position(|swept| swept == key);
    let Some(place) = place(key).or_else(|| place(name_of_symbol(key)?)) else {
        if let Some(value) = fixed(key).or_else(|| fixed(name_of_symbol(key)?)) {
            let told = || format!("{word}: is {} in every case of this study", in_words(&value));
            return if alike(&value, wanted.value(), FOUR_DIGITS) {
                Ok(())
            } else {
                Err(BadInput(told()))
            };
        }
        if let Some(told) = elsewhere(name_of_symbol(key).unwrap_or(key), keys, fixed) {
            return Err(BadInput(format!("{word}: {told}")));
        }
        let told = ConfigError::unknown(&path, keys).to_string();
        let swept = || format!("; this study sweeps {}", keys.join(", "));
        let help = match keys {
            [_, ..] if hint(key, keys).is_empty() => meant_by(key).unwrap_or_else(swept),
            _ => String::new(),
        };
        return Err(BadInput(told + &help));
    };
    let values = values(fitting, place);
    let fits = |choice: &Choice, share: f64| {
        choice.values[place].as_deref().is_some_and(|value| alike(value, wanted.value(), share))
    };
    let exact = fitting.iter().any(|choice| fits(choice, 0.0));
    fitting.retain(|choice| fits(choice, if exact { 0.0 } else { FOUR_DIGITS }));
    if fitting.is_empty() {
        return Err(BadInput(format!("{word}: no such case; there is {values}")));
    }
    Ok(())
}

/// Why no case of the study has a key of walls or paddles. For example, a spring's key has no
/// meaning at a fixed wall. `None` if there is another reason.
fn elsewhere(
    key: &str,
    swept: &[String],
    fixed: &dyn Fn(&str) -> Option<toml::Value>,
) -> Option<String> {
    // Other kinds of scenes have none of these keys.
    fixed("wall")?;
    let all = SeawallScene::keys();
    let key = all.iter().find(|known| known.name == key)?;
    let told = |when: When| {
        // A case may leave out a key that is at its default.
        let default = || (all.iter().find(|known| known.name == when.key)?.default)();
        let is_swept = swept.iter().any(|key| key == when.key);
        let has = fixed(when.key).or_else(default).filter(|_| !is_swept)?;
        let differs = !when.has(&has);
        differs.then(|| {
            format!("{} belongs to {when}; {} is {has} in every case here", key.name, when.key)
        })
    };
    key.conditions().find_map(told)
}

/// The values of a swept key among some cases, in words.
fn values(cases: &[&Choice], place: usize) -> String {
    let values = cases.iter().filter_map(|case| case.values[place].as_deref());
    different(values.map(in_words)).join(", ")
}

/// A value as people write it: without quotes, and without decimals if it is whole.
fn in_words(value: &toml::Value) -> String {
    match value {
        toml::Value::String(word) => word.clone(),
        toml::Value::Float(number) => number.to_string(),
        other => other.to_string(),
    }
}

/// Four digits of a number: nobody types more.
const FOUR_DIGITS: f64 = 5e-4;

/// Whether settings are equal. Numbers may differ by a share of themselves.
fn alike(value: &toml::Value, wanted: &toml::Value, share: f64) -> bool {
    match (number(value), number(wanted)) {
        (Some(value), Some(wanted)) => (value - wanted).abs() <= share * value.abs(),
        _ => match (value.as_array(), wanted.as_array()) {
            (Some(value), Some(wanted)) => {
                let mut both = value.iter().zip(wanted);
                value.len() == wanted.len() && both.all(|(a, b)| alike(a, b, share))
            }
            _ => value == wanted,
        },
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::study::SweepFile;

    /// Two waves and two springs: the softer one makes its cases 0 and 2.
    pub(in crate::cli) fn study() -> Study {
        let text = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n[grid]\n\
            wave_height_ratio = [0.3, 0.5]\nspring_stiffness_n_per_m = [10, 21544.3469003188]";
        Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap()
    }

    fn pick(words: &[&str]) -> Result<usize, String> {
        let words: Vec<_> = words.iter().map(|&word| word.to_owned()).collect();
        the_case(&study(), &words).map(|case| case.index).map_err(|error| error.to_string())
    }

    /// The story: three waves had the same four digits. The message named all three, and none of them could be picked.
    #[test]
    fn a_value_that_is_there_to_the_last_digit_wins() {
        let text = "name = \"a\"\n[grid]\nwave_height_ratio = [0.3, 0.30001, 0.3001]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let pick = |word: &str| the_case(&study, &[word.to_owned()]).map(|case| case.index);
        let picked = ["H/h=0.3", "H/h=0.30001", "H/h=0.3001"].map(|word| pick(word).unwrap());
        assert_eq!(picked, [0, 1, 2]);
        assert!(pick("H/h=0.30005").is_err(), "near all three");
    }

    /// The story: at a fixed wall `k=3` was called mistyped, and the spring's key was proposed.
    #[test]
    fn keys_of_another_wall_are_told_with_the_wall_that_has_them() {
        let told = |scene: &str, word: &str| {
            let text =
                format!("name = \"a\"\n[scene]\n{scene}\n[grid]\nwave_height_ratio = [0.2, 0.3]");
            let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
            the_case(&study, &[word.to_owned()]).unwrap_err().to_string()
        };
        let key = "spring_stiffness_n_per_m";
        let whose = crate::scene::belongs(key) + "; wall is \"fixed\" in every case here";
        assert_eq!(told("", "k=3"), format!("k=3: {key} {whose}"));
        let long = format!("{key}=3");
        assert_eq!(told("wall = \"fixed\"", &long), format!("{long}: {key} {whose}"));
        let stroke = told("", "wave_period_s=1");
        assert!(stroke.contains("belongs to paddle = \"wave-train\"; paddle is"), "{stroke}");
        assert!(told("", "colour=3").starts_with("colour: unknown key"));
    }

    #[test]
    fn words_pick_a_case() {
        let id = study().cases[2].id.to_string();
        assert_eq!(pick(&["wave_height_ratio=0.5", "spring_stiffness_n_per_m=21540"]), Ok(3));
        assert_eq!(pick(&[&id]), Ok(2));
        assert_eq!(pick(&[&id[..6]]), Ok(2));
        let told = pick(&["wave_height_ratio=0.5"]).unwrap_err();
        assert!(
            told.starts_with("2 cases fit; say which one by spring_stiffness_n_per_m"),
            "{told}"
        );
        let told = pick(&["stiffness=10"]).unwrap_err();
        assert_eq!(told, "stiffness: unknown key; did you mean spring_stiffness_n_per_m?");
        assert_eq!(pick(&["H/h=0.5", "k=2.154×10⁴"]), Ok(3), "as tables print it");
        assert_eq!(pick(&["m=50", "k=10", "H/h=0.3", "kernel=wendland-c2"]), Ok(0));
        let told = pick(&["m=60", "k=10"]).unwrap_err();
        assert_eq!(told, "m=60: is 50 in every case of this study");
        let told = pick(&["k=10"]).unwrap_err();
        assert_eq!(told, "2 cases fit; say which one by wave_height_ratio (0.3, 0.5)");
        let told = pick(&["H/h=0.5"]).unwrap_err();
        assert!(told.ends_with("(10, 21544.3469003188)"), "{told}");
        let told = pick(&["colour=10"]).unwrap_err();
        let swept = "wave_height_ratio, spring_stiffness_n_per_m";
        assert_eq!(told, format!("colour: unknown key; this study sweeps {swept}"));
        let told = pick(&["wave_height_ratio=0.4"]).unwrap_err();
        assert_eq!(told, "wave_height_ratio=0.4: no such case; there is 0.3, 0.5");
        assert!(pick(&["0123456789abcdef"]).is_err());
    }
}
