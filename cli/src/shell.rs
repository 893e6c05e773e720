//! `azulejo completions` and `man`: the commands as shells and the manual describe them.

use azulejo::{Error, Result};
use clap::Args;
use clap_complete::Shell;

use crate::output::print;

#[derive(Args)]
pub struct Completions {
    /// The shell. For bash: azulejo completions bash > ~/.local/share/bash-completion/completions/azulejo
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    pub fn run(&self, mut program: clap::Command) -> Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, "azulejo", &mut script);
        print(&script)
    }
}

#[derive(Args)]
pub struct Man {
    /// The command that the page is about, such as draw points [default: all of azulejo].
    #[arg(value_name = "COMMAND")]
    command: Vec<String>,
}

impl Man {
    pub fn run(&self, mut program: clap::Command) -> Result<()> {
        program.build();
        let mut command = &program;
        for word in &self.command {
            command = command.find_subcommand(word).ok_or_else(|| Error::InvalidArgument {
                argument: "COMMAND",
                reason: format!("{} has no command {word:?}", command.get_name()),
            })?;
        }
        let mut page = Vec::new();
        let written = clap_mangen::Man::new(command.clone()).render(&mut page);
        written.expect("writing into memory does not fail");
        print(&page)
    }
}
