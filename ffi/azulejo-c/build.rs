//! Gives the shared library its SONAME, which names the ABI: it changes when programs must be rebuilt.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libazulejo.so.0");
        println!("cargo::rustc-cdylib-link-arg=-Wl,--no-undefined");
    }
}
