//! Gives the shared library its SONAME, which names the ABI: before 1.0 that of each minor version. And keeps the library
//! loaded once it is. Debuggers know it by its build ID.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        let [major, minor] = ["MAJOR", "MINOR"].map(|part| std::env::var(format!("CARGO_PKG_VERSION_{part}")).unwrap());
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libazulejo.so.{major}.{minor}");
        println!("cargo::rustc-cdylib-link-arg=-Wl,--no-undefined");
        println!("cargo::rustc-cdylib-link-arg=-Wl,--build-id=sha1");
        // dlclose would take the code away from under threads that are just ending.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
