//! The command-line tool of azulejo: samples into files, and pictures of them.

use std::process::ExitCode;

fn main() -> ExitCode {
    azulejo_cli::main()
}
