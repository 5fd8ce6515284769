use super::*;

#[test]
fn the_command_line_is_consistent() {
    Cli::command().debug_assert();
}

#[test]
fn the_readme_names_each_command() {
    let readme = include_str!("../../README.md");
    let command = Cli::command();
    for one in command.get_subcommands().filter(|one| !one.is_hide_set()) {
        let name = format!("`seawall {}", one.get_name());
        assert!(readme.contains(&name), "README.md does not name {name}`");
    }
}

#[test]
fn a_bad_number_is_refused_in_plain_words() {
    let mut refused = 0;
    for command in Cli::command().get_subcommands() {
        for option in command.get_arguments().filter_map(|option| option.get_long()) {
            for value in ["0", "-1", "1.5", "x", "99999999999999999999"] {
                let words = ["seawall", command.get_name(), &format!("--{option}={value}")];
                let Err(error) = Cli::try_parse_from(words) else { continue };
                let told = error.to_string();
                for word in ["..=", "digit", "literal", "too large to fit"] {
                    assert!(!told.contains(word), "{words:?}: {told}");
                }
                refused += usize::from(told.contains("must be a whole number from "));
            }
        }
    }
    assert!(refused > 20, "{refused}");
}
