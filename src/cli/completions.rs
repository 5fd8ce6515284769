//! `seawall completions` and `seawall man`: descriptions of this program for a shell and for `man`.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_complete::Shell;
use serde_json::json;

use super::SUCCESS;
use super::output::{Output, json_path};
use crate::keys::named;
use crate::results::SweepError;

/// Print a script with which a shell completes commands and options.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall completions bash > ~/.local/share/bash-completion/completions/seawall
  seawall completions zsh > ~/.zfunc/_seawall
  seawall completions fish > ~/.config/fish/completions/seawall.fish")]
pub(super) struct CompletionsArgs {
    /// The shell that is to complete.
    #[arg(value_enum)]
    shell: Shell,
}

/// Print the manual page, or write one for every command.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall man | man -l -
  seawall man --out ~/.local/share/man/man1")]
pub(super) struct ManArgs {
    /// Write seawall.1, seawall-sweep.1 and the others into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub(super) fn completions(
    args: &CompletionsArgs,
    command: &Command,
    output: &Output,
) -> anyhow::Result<u8> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut offered(command), "seawall", &mut script);
    let script = String::from_utf8(script)?;
    output.result(&script, &json!({ "shell": args.shell.to_string(), "script": script }))?;
    Ok(SUCCESS)
}

/// The commands that people use. Completion scripts would show hidden commands, too.
fn offered(command: &Command) -> Command {
    let for_people = command.get_subcommands().filter(|one| !one.is_hide_set()).cloned();
    let plain = Command::new("seawall").version(env!("CARGO_PKG_VERSION")).propagate_version(true);
    plain.args(command.get_arguments().cloned()).subcommands(for_people)
}

pub(super) fn man(args: &ManArgs, command: Command, output: &Output) -> anyhow::Result<u8> {
    let Some(directory) = &args.out else {
        let mut page = Vec::new();
        clap_mangen::Man::new(command).render(&mut page)?;
        let page = String::from_utf8(page)?;
        output.result(&page, &json!({ "page": page }))?;
        return Ok(SUCCESS);
    };
    let unusable = |error: std::io::Error| SweepError::unusable(directory, &error);
    std::fs::create_dir_all(directory).map_err(unusable)?;
    clap_mangen::generate_to(command, directory).map_err(unusable)?;
    let told = format!("pages: {}\n", named(directory));
    output.result(&told, &json!({ "out": json_path(directory) }))?;
    Ok(SUCCESS)
}
