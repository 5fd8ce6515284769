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
    assert!(told.starts_with("2 cases fit; say which one by spring_stiffness_n_per_m"), "{told}");
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

/// The story: `--case H/h=0.5,k=10` was one value, "0.5,k=10", and no case had it.
#[test]
fn a_word_may_have_several_parts() {
    assert_eq!(pick(&["H/h=0.5,k=10"]), Ok(2));
    assert_eq!(pick(&["H/h=0.5, k=21540", "m=50"]), Ok(3));
    let id = study().cases[2].id.to_string();
    assert_eq!(pick(&[&format!("{},k=10", &id[..6])]), Ok(2));
    // A comma within a number, a list or a text begins no part.
    assert_eq!(parts("H/h=0,5"), ["H/h=0,5"]);
    let list = "bed_m=[[0, 0],[1,0.1]]";
    assert_eq!(parts(&format!("{list},k=10")), [list, "k=10"]);
    assert_eq!(parts("recorded_stroke=\"a,b=1\",k=10"), ["recorded_stroke=\"a,b=1\"", "k=10"]);
}
