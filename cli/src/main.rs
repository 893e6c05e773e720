//! The command-line tool of azulejo.

fn main() {}
