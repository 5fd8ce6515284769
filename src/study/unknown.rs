//! Unknown keys, all reported at once, so that nobody has to correct them one by one.

use toml::{Table, Value};

use crate::quantities::name_of_symbol;
use crate::scene::{ConfigError, Kind, Place, WallChoice, place_of, scene_keys, unknown_keys};

/// This many are reported after the first.
const MOST: usize = 3;

/// Refuses a file for errors at its top, and for keys of its sections if there are several errors.
/// A single error is reported where its section is read.
pub(super) fn refuse(at_the_top: Vec<ConfigError>, file: &Table) -> Result<(), ConfigError> {
    let mut sections = in_sections(file);
    let mut by_symbol = false;
    for error in &mut sections {
        if let Some(told) = meant(&error.key, file) {
            (*error, by_symbol) = (told, true);
        }
    }
    if at_the_top.is_empty() && sections.len() < 2 && !by_symbol {
        return Ok(());
    }
    let mut all = at_the_top.into_iter().chain(sections);
    let Some(first) = all.next() else { return Ok(()) };
    let others: Vec<_> = all.map(|error| error.to_string()).collect();
    let mut allowed = first.allowed;
    for other in others.iter().take(MOST) {
        allowed += &format!("; besides, {other}");
    }
    if others.len() > MOST {
        allowed += &format!("; and {} more", others.len() - MOST);
    }
    Err(ConfigError { allowed, ..first })
}

/// The error of a key that is named by its symbol, as other commands take it: `k`, `H/h`.
pub(super) fn meant(key: &str, file: &Table) -> Option<ConfigError> {
    let (section, symbol) = key.rsplit_once('.').unwrap_or(("", key));
    let name = name_of_symbol(symbol)?;
    let scene = file.get("scene").and_then(Value::as_table).cloned().unwrap_or_default();
    let own = place_of(name, &scene).ok()?.name();
    let section = if section == "grid" { section } else { own };
    let error = ConfigError::misplaced(key, &format!("{section}.{name}"));
    let allowed = error.allowed + &apart(name, &scene, file).unwrap_or_default();
    Some(ConfigError { allowed, ..error })
}

/// For a key that this file's wall or paddle does not have, names those that have it: ` It belongs
/// to wall = "movable"; ...`.
fn apart(name: &str, scene: &Table, file: &Table) -> Option<String> {
    let keys = scene_keys(Kind::of(scene).ok()?);
    let known = |name: &str| keys.iter().find(|key| key.name == name);
    let when = known(name)?.rule.only?;
    let own = scene.get(when.key).cloned().or_else(|| (known(when.key)?.default)())?;
    let swept = file.get("grid").is_some_and(|grid| grid.get(when.key).is_some());
    let holds = when.has(&own);
    let stands = own.clone().try_into().is_ok_and(|wall: WallChoice| !wall.moves());
    let means = if stands { ", which stands still" } else { "" };
    (!swept && !holds).then(|| format!(" It belongs to {when}; here {} = {own}{means}", when.key))
}

/// The unknown keys of `[scene]`, `[numerics]` and `[grid]`.
fn in_sections(file: &Table) -> Vec<ConfigError> {
    let section =
        |name: &str| file.get(name).and_then(Value::as_table).cloned().unwrap_or_default();
    let (scene, grid) = (section("scene"), section("grid"));
    // The known keys depend on the kind.
    if place_of("kind", &scene).is_err() || grid.contains_key("kind") {
        return Vec::new();
    }
    let mut all = unknown_keys(Place::Scene, &scene, &scene);
    all.extend(unknown_keys(Place::Numerics, &scene, &section("numerics")));
    let swept = grid.keys().filter(|key| *key != "refine");
    all.extend(swept.filter_map(|key| place_of(key, &scene).err()));
    all
}

#[cfg(test)]
mod tests {
    use crate::scene::belongs;
    use crate::study::SweepFile;

    fn told(text: &str) -> String {
        SweepFile::read(text, &[]).unwrap_err().to_string()
    }

    /// A file without a name once hid a misspelt key, which was reported only after the name was
    /// added.
    #[test]
    fn several_errors_of_keys_are_told_together() {
        let both = told("[scene]\nwave_hight_ratio = 0.3");
        assert!(both.starts_with("name: is required"), "{both}");
        let besides =
            "besides, scene.wave_hight_ratio: unknown key; did you mean wave_height_ratio?";
        assert!(both.ends_with(besides), "{both}");
        let three = told(
            "name = \"a\"\n[scene]\ncolour = 1\n[numerics]\nkernle = \"gaussian\"\n[grid]\nx = [1]",
        );
        let all = "scene.colour: unknown key (`seawall explain` lists all); besides, numerics.kernle: unknown key; \
                   did you mean kernel?; besides, grid.x: unknown key (`seawall explain` lists all)";
        assert_eq!(three, all);
        let many = told("[scene]\na = 1\nb = 1\nc = 1\nd = 1\ne = 1");
        assert!(many.ends_with("; and 2 more"), "{many}");
    }

    /// The README once said that k and H/h are taken "where a key is asked for", but `--set
    /// H/h=0.3` was an unknown key.
    #[test]
    fn a_symbol_is_told_with_its_key() {
        let asked = |key: &str, meant: &str| format!("{key}: unknown key; did you mean {meant}?");
        let scene = "name = \"a\"\n[scene]\nwall = \"movable\"\nk = 10";
        assert_eq!(told(scene), asked("scene.k", "scene.spring_stiffness_n_per_m"));
        for walls in
            ["[scene]\nwall = \"caisson\"\n[grid]", "[grid]\nwall = [\"fixed\", \"movable\"]"]
        {
            let grid = format!("name = \"a\"\n{walls}\nm = [10]");
            assert_eq!(told(&grid), asked("grid.m", "grid.seawall_mass_kg_per_m"));
        }
        assert_eq!(told("name = \"a\"\n\"H/h\" = 1"), asked("H/h", "scene.wave_height_ratio"));
    }

    /// `--set k=3` with a fixed wall once named the spring's key, which was then refused.
    #[test]
    fn a_symbol_of_another_wall_is_told_with_that_wall() {
        let belongs = belongs("spring_stiffness_n_per_m");
        let asked = format!(
            "scene.k: unknown key; did you mean scene.spring_stiffness_n_per_m? It {belongs}; here \
             wall = \"fixed\", which stands still"
        );
        assert_eq!(told("name = \"a\"\n[scene]\nk = 10"), asked);
        let caisson = told("name = \"a\"\n[scene]\nwall = \"caisson\"\nk = 10");
        assert!(caisson.ends_with(&format!("{belongs}; here wall = \"caisson\"")), "{caisson}");
    }

    #[test]
    fn a_single_one_is_told_where_its_section_is_read() {
        for text in ["[scene]\ncolour = 1", "[grid]\nx = [1]", "[scene]\nkind = \"none\"\na = 1"] {
            assert!(SweepFile::read(&format!("name = \"a\"\n{text}"), &[]).is_ok(), "{text}");
        }
    }
}
