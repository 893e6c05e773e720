//! The C ABI of azulejo.
