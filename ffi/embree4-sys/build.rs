//! Binds the installed Embree: finds its headers, lets bindgen read them and cc compile what they hold inline.
//!
//! `EMBREE_DIR`, if set, is the only place that is looked at; otherwise the system's. The version decides: 4 before 3.

use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const SHIM: &str = "shim/azulejo_embree.h";
const SYSTEM_PREFIXES: [&str; 2] = ["/usr/local", "/usr"];

/// Everything of Embree's that the crate exports, as regular expressions.
const FUNCTIONS: &str = "azulejo_(rtc.*|sizes)|rtc(New|Release)(Device|Scene|Geometry)|rtc(Commit|Attach)(Geometry|Scene)|\
    rtc(Get|Set)Device(Property|Error|ErrorFunction)|rtcSetScene(Flags|BuildQuality|ProgressMonitorFunction)|\
    rtcSetNewGeometryBuffer|rtcGetGeometry(BufferData)?|rtcGetSceneDevice";
const TYPES: &str = "AzulejoSceneFlags|RTC(RayHit(|4|8|16)|FilterFunctionNArguments|RayQueryFlags)";
const VALUES: &str = "RTC_(VERSION_(MAJOR|MINOR|PATCH)|(SCENE|RAY_QUERY)_FLAG_.*|ERROR_.*|\
    DEVICE_PROPERTY_.*|(GEOMETRY|BUFFER)_TYPE_.*|FORMAT_(FLOAT|UINT)3|BUILD_QUALITY_.*)";

/// An installed Embree.
struct Embree {
    major: u32,
    include: PathBuf,
    /// Where the library is, if the linker would not look there by itself.
    library: Option<PathBuf>,
}

impl Embree {
    /// The Embree of this major version below a prefix.
    fn below(prefix: &Path, major: u32) -> Option<Self> {
        let include = prefix.join("include");
        include.join(format!("embree{major}/rtcore.h")).is_file().then_some(Self { major, include, library: None })
    }

    fn find() -> Result<Self, String> {
        if let Some(directory) = env::var_os("EMBREE_DIR").map(PathBuf::from) {
            let mut embree = [4, 3].iter().find_map(|&major| Self::below(&directory, major)).ok_or_else(|| {
                let directory = directory.display();
                format!(
                    "EMBREE_DIR is {directory}, but neither embree4/rtcore.h nor embree3/rtcore.h is in its include/"
                )
            })?;
            embree.library = ["lib", "lib64"].map(|name| directory.join(name)).into_iter().find(|path| path.is_dir());
            return Ok(embree);
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

    fn library_name(&self) -> String {
        format!("embree{}", self.major)
    }
}

fn bind(embree: &Embree, out: &Path) -> Result<(), String> {
    let arguments = [format!("-I{}", embree.include.display()), format!("-DAZULEJO_EMBREE_MAJOR={}", embree.major)];
    let bindings = bindgen::Builder::default()
        .header(SHIM)
        .clang_args(&arguments)
        .parse_callbacks(Box::new(bindgen::CargoCallbacks::new()))
        .allowlist_function(FUNCTIONS)
        .allowlist_type(TYPES)
        .allowlist_var(VALUES)
        .prepend_enum_name(false)
        .derive_default(true)
        .generate_comments(false)
        .wrap_static_fns(true)
        .wrap_static_fns_path(out.join("inline"))
        .generate()
        .map_err(|error| format!("bindgen cannot read Embree's headers: {error}"))?;
    bindings.write_to_file(out.join("bindings.rs")).map_err(|error| error.to_string())?;

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
    if let Some(library) = &embree.library {
        println!("cargo::rustc-link-search=native={}", library.display());
        println!("cargo::metadata=library_dir={}", library.display());
    }
    println!("cargo::rustc-link-lib=dylib={}", embree.library_name());
    println!("cargo::metadata=library={}", embree.library_name());
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
