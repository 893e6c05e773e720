//! Gives the shared library its SONAME, which names the ABI: it changes when programs must be rebuilt; and keeps it
//! loaded once it is.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libazulejo.so.0");
        println!("cargo::rustc-cdylib-link-arg=-Wl,--no-undefined");
        // dlclose would take the code away from under threads that are just ending.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
