//! Binds the installed Embree: finds its headers, lets bindgen read them and cc compile what they hold inline. Nothing is
//! linked: the library is loaded at run time, by its SONAME.
//!
//! `EMBREE_DIR`, if set, is the only place that is looked at; otherwise the system's. The version decides: 4 before 3.

use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const SHIM: &str = "shim/azulejo_embree.h";
const SYSTEM_PREFIXES: [&str; 2] = ["/usr/local", "/usr"];

/// The library's functions that are loaded, as regular expressions, as all lists here.
const FUNCTIONS: &str = "rtc(New|Release)(Device|Scene|Geometry)|rtc(Commit|Attach)(Geometry|Scene)|rtcJoinCommitScene|\
    rtc(Get|Set)Device(Property|Error|ErrorFunction)|rtcSetScene(Flags|BuildQuality|ProgressMonitorFunction)|\
    rtcSetNewGeometryBuffer|rtcGetGeometry(BufferData)?|rtcGetSceneDevice|rtcIntersect(1|4|8|16)";
/// The functions that are compiled into the crate.
const INLINE: &str = "azulejo_(rtc.*|sizes)";
const TYPES: &str = "Azulejo(SceneFlags|Sizes|Intersect.*)|\
    RTC(RayHit(|4|8|16)|FilterFunctionNArguments|RayQueryFlags|RayQueryContext|IntersectArguments)";
const VALUES: &str = "RTC_(VERSION_(MAJOR|MINOR|PATCH)|(SCENE|RAY_QUERY)_FLAG_.*|ERROR_.*|\
    DEVICE_PROPERTY_.*|(GEOMETRY|BUFFER)_TYPE_.*|FORMAT_(FLOAT|UINT)3|BUILD_QUALITY_.*)";

/// An installed Embree.
struct Embree {
    major: u32,
    include: PathBuf,
}

impl Embree {
    /// The Embree of this major version below a prefix.
    fn below(prefix: &Path, major: u32) -> Option<Self> {
        let include = prefix.join("include");
        include.join(format!("embree{major}/rtcore.h")).is_file().then_some(Self { major, include })
    }

    fn find() -> Result<Self, String> {
        if let Some(directory) = env::var_os("EMBREE_DIR").map(PathBuf::from) {
            return [4, 3].iter().find_map(|&major| Self::below(&directory, major)).ok_or_else(|| {
                let directory = directory.display();
                format!(
                    "EMBREE_DIR is {directory}, but neither embree4/rtcore.h nor embree3/rtcore.h is in its include/"
                )
            });
        }
        [4, 3]
            .iter()
            .find_map(|&major| SYSTEM_PREFIXES.iter().find_map(|prefix| Self::below(Path::new(prefix), major)))
            .ok_or_else(|| {
                "Embree (4, or 3.13) is not installed: `apt-get install libembree-dev`, \
                or set EMBREE_DIR to a folder that has it in include/ and lib/"
                    .into()
            })
    }

    /// The name that programs link it by.
    fn link_name(&self) -> String {
        format!("embree{}", self.major)
    }

    /// The file that such programs load, which contains the major version: the SONAME, where the system has one.
    fn file_name(&self) -> String {
        let (name, major) = (self.link_name(), self.major);
        match env::var("CARGO_CFG_TARGET_OS").as_deref() {
            Ok("windows") => format!("{name}.dll"),
            Ok("macos") => format!("lib{name}.{major}.dylib"),
            _ => format!("lib{name}.so.{major}"),
        }
    }
}

fn bind(embree: &Embree, out: &Path) -> Result<(), String> {
    let arguments = [format!("-I{}", embree.include.display()), format!("-DAZULEJO_EMBREE_MAJOR={}", embree.major)];
    let write = |builder: bindgen::Builder, file: &str| {
        let bindings = builder.generate().map_err(|error| format!("bindgen cannot read Embree's headers: {error}"))?;
        bindings.write_to_file(out.join(file)).map_err(|error| error.to_string())
    };
    let header = bindgen::Builder::default()
        .header(SHIM)
        .clang_args(&arguments)
        .parse_callbacks(Box::new(bindgen::CargoCallbacks::new()))
        .prepend_enum_name(false)
        .generate_comments(false);
    let loaded = header
        .clone()
        .allowlist_function(FUNCTIONS)
        .allowlist_type(TYPES)
        .allowlist_var(VALUES)
        .derive_default(true)
        .dynamic_library_name("Embree")
        .dynamic_link_require_all(true);
    write(loaded, "bindings.rs")?;
    let inline = header
        .allowlist_function(INLINE)
        .allowlist_recursively(false)
        .wrap_static_fns(true)
        .wrap_static_fns_path(out.join("inline"));
    write(inline, "inline.rs")?;

    let mut compiler = cc::Build::new();
    arguments.iter().for_each(|argument| {
        compiler.flag(argument);
    });
    compiler
        .include(".")
        .file(out.join("inline.c"))
        .try_compile("azulejo_embree_inline")
        .map_err(|error| format!("cannot compile the inline functions of Embree's headers: {error}"))
}

fn run() -> Result<(), String> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=EMBREE_DIR");
    let embree = Embree::find()?;
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("OUT_DIR is not set")?);
    bind(&embree, &out)?;
    println!("cargo::rustc-env=EMBREE_FILE={}", embree.file_name());
    println!("cargo::metadata=library={}", embree.link_name());
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            println!("cargo::error={}", message.replace('\n', " "));
            ExitCode::FAILURE
        }
    }
}
