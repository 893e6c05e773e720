//! Bindings to the installed Embree: version 4, or 3.13 behind a shim with the same API.
//!
//! The functions and structs are those of Embree 4's manual, under their own names, and as few as azulejo uses. They
//! are read from the *installed* headers, since Embree's structs grow between minor versions (`RTCHit` has 32 bytes in
//! 4.2 and 48 in 4.3) and the library writes all of its own. [`Embree::check`] compares the library that was loaded
//! with the headers that were bound; call it with each new device, before anything is traced.
//!
//! # Loading
//! Nothing is linked: [`Embree::load`] opens the library on first use, by the SONAME of the headers' version and without
//! a path, so that the dynamic linker finds it as it would for a program that links it. In a program that has loaded that
//! SONAME before it is the same library. It is never closed.
//!
//! # Building
//! `EMBREE_DIR` names a folder that holds Embree in `include/`; without it the system's is taken. A library outside the
//! system's folders is found at run time by other means (`LD_LIBRARY_PATH`, rpath). Build scripts of crates that depend on
//! this one get `DEP_EMBREE_LIBRARY`, `embree3` or `embree4`: what a program with scenes of its own should be linked with.

use std::ffi::c_int;
use std::fmt;
use std::mem::size_of;
use std::sync::OnceLock;

mod bindings {
    #![allow(
        missing_docs,
        non_camel_case_types,
        non_snake_case,
        non_upper_case_globals,
        unsafe_op_in_unsafe_fn,
        clippy::all,
        clippy::undocumented_unsafe_blocks
    )]
    include!(concat!(env!("OUT_DIR"), "/bindings.rs"));
}

/// The inline functions of the headers, compiled into this crate.
mod inline {
    #![allow(missing_docs, non_snake_case, clippy::all, clippy::undocumented_unsafe_blocks)]
    use crate::bindings::*;
    include!(concat!(env!("OUT_DIR"), "/inline.rs"));
}

pub use bindings::*;
pub use inline::{
    azulejo_rtcInitIntersectArguments as rtcInitIntersectArguments,
    azulejo_rtcInitRayQueryContext as rtcInitRayQueryContext,
};

/// The file that is loaded: the SONAME of the bound version.
pub const FILE: &str = env!("EMBREE_FILE");

/// No geometry: a ray starts with it, and keeps it if it hits nothing. (A macro with a cast, which bindgen leaves out.)
pub const RTC_INVALID_GEOMETRY_ID: u32 = u32::MAX;

/// A version of Embree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Version {
    /// 3 or 4.
    pub major: u32,
    /// Structs change with it.
    pub minor: u32,
    /// Nothing that a caller sees changes with it.
    pub patch: u32,
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}.{}.{}", self.major, self.minor, self.patch)
    }
}

/// The version of the headers that this crate was bound to.
pub const BOUND_VERSION: Version =
    Version { major: RTC_VERSION_MAJOR, minor: RTC_VERSION_MINOR, patch: RTC_VERSION_PATCH };

/// Embree is not on this machine, or lacks functions of the bound version.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// The message of the dynamic linker.
    pub reason: String,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{FILE} (version {BOUND_VERSION}) cannot be loaded: {}", self.reason)
    }
}

impl std::error::Error for Missing {}

impl Embree {
    /// The library: loaded by the first call, which any thread may make; the others wait for it. If it cannot be loaded,
    /// later calls fail in the same way.
    ///
    /// # Errors
    /// [`Missing`].
    pub fn load() -> Result<&'static Self, Missing> {
        static EMBREE: OnceLock<Result<Embree, Missing>> = OnceLock::new();
        // SAFETY: this is Embree, whose initialisers may run on any thread; its functions have the types of its headers.
        let open = || unsafe { Self::new(FILE) }.map_err(|error| Missing { reason: error.to_string() });
        EMBREE.get_or_init(open).as_ref().map_err(Missing::clone)
    }

    /// The functions of the Embree that the program itself has linked, of whatever version, if it has one.
    #[cfg(unix)]
    pub fn of_program() -> Option<Self> {
        // SAFETY: the functions that the program finds under these names are Embree's; `check` compares the version
        // before structs of the headers are used.
        unsafe { Self::from_library(libloading::os::unix::Library::this()) }.ok()
    }

    /// The functions of the Embree that the program itself has linked: names are not shared on this system.
    #[cfg(not(unix))]
    pub fn of_program() -> Option<Self> {
        None
    }

    /// `rtcIntersect1` of Embree 4.
    ///
    /// # Safety
    /// As in its manual.
    pub unsafe fn intersect1(&self, scene: RTCScene, rayhit: *mut RTCRayHit, arguments: *mut RTCIntersectArguments) {
        // SAFETY: by the contract.
        unsafe { inline::azulejo_rtcIntersect1(Some(self.rtcIntersect1), scene, rayhit, arguments) };
    }

    /// `rtcIntersect4` of Embree 4.
    ///
    /// # Safety
    /// As in its manual.
    pub unsafe fn intersect4(
        &self,
        valid: *const c_int,
        scene: RTCScene,
        rayhit: *mut RTCRayHit4,
        arguments: *mut RTCIntersectArguments,
    ) {
        // SAFETY: by the contract.
        unsafe { inline::azulejo_rtcIntersect4(Some(self.rtcIntersect4), valid, scene, rayhit, arguments) };
    }

    /// `rtcIntersect8` of Embree 4.
    ///
    /// # Safety
    /// As in its manual.
    pub unsafe fn intersect8(
        &self,
        valid: *const c_int,
        scene: RTCScene,
        rayhit: *mut RTCRayHit8,
        arguments: *mut RTCIntersectArguments,
    ) {
        // SAFETY: by the contract.
        unsafe { inline::azulejo_rtcIntersect8(Some(self.rtcIntersect8), valid, scene, rayhit, arguments) };
    }

    /// `rtcIntersect16` of Embree 4.
    ///
    /// # Safety
    /// As in its manual.
    pub unsafe fn intersect16(
        &self,
        valid: *const c_int,
        scene: RTCScene,
        rayhit: *mut RTCRayHit16,
        arguments: *mut RTCIntersectArguments,
    ) {
        // SAFETY: by the contract.
        unsafe { inline::azulejo_rtcIntersect16(Some(self.rtcIntersect16), valid, scene, rayhit, arguments) };
    }
}

/// Why the loaded library cannot be called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// The library is of another version than the headers.
    Version {
        /// That of the headers.
        bound: Version,
        /// That of the library.
        loaded: Version,
    },
    /// A struct has one size in Rust and another in C.
    Size {
        /// The name of the struct.
        name: &'static str,
        /// Its size in Rust, in bytes.
        rust: usize,
        /// Its size in C, in bytes.
        c: usize,
    },
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Version { bound, loaded } => {
                write!(f, "built for version {bound}, but the library that was loaded is version {loaded}")
            }
            Self::Size { name, rust, c } => write!(f, "{name} has {rust} bytes in Rust and {c} in C"),
        }
    }
}

impl std::error::Error for Mismatch {}

impl Mismatch {
    /// Structs may change with the minor version, never with the patch.
    fn between(bound: Version, loaded: Version) -> Result<(), Self> {
        if (bound.major, bound.minor) == (loaded.major, loaded.minor) {
            Ok(())
        } else {
            Err(Self::Version { bound, loaded })
        }
    }
}

impl Embree {
    /// The version of this library.
    ///
    /// # Safety
    /// `device` is a device of this library that has not been released.
    pub unsafe fn version(&self, device: RTCDevice) -> Version {
        // SAFETY: the device is valid by the contract of this function.
        let number = |property| unsafe { self.rtcGetDeviceProperty(device, property) } as u32;
        Version {
            major: number(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
            minor: number(RTC_DEVICE_PROPERTY_VERSION_MINOR),
            patch: number(RTC_DEVICE_PROPERTY_VERSION_PATCH),
        }
    }

    /// Compares this library with the one that this crate was built for: its version, and the sizes of the structs.
    ///
    /// # Errors
    /// The first [`Mismatch`]. Tracing would then read and write outside the structs.
    ///
    /// # Safety
    /// `device` is a device of this library that has not been released.
    pub unsafe fn check(&self, device: RTCDevice) -> Result<(), Mismatch> {
        // SAFETY: the device is valid by the contract of this function.
        Mismatch::between(BOUND_VERSION, unsafe { self.version(device) })?;
        // SAFETY: the function reads nothing; it returns constants of the C compiler.
        let sizes = unsafe { inline::azulejo_sizes() };
        let structs = [
            ("RTCRayHit", size_of::<RTCRayHit>(), sizes.ray_hit),
            ("RTCRayHit4", size_of::<RTCRayHit4>(), sizes.ray_hit4),
            ("RTCRayHit8", size_of::<RTCRayHit8>(), sizes.ray_hit8),
            ("RTCRayHit16", size_of::<RTCRayHit16>(), sizes.ray_hit16),
            ("RTCHit", size_of::<RTCHit>(), sizes.hit),
            ("RTCRayQueryContext", size_of::<RTCRayQueryContext>(), sizes.ray_query_context),
            ("RTCIntersectArguments", size_of::<RTCIntersectArguments>(), sizes.intersect_arguments),
        ];
        match structs.into_iter().find(|&(_, rust, c)| rust != c) {
            Some((name, rust, c)) => Err(Mismatch::Size { name, rust, c }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_is_loaded_once_for_all_threads() {
        let load = || std::ptr::from_ref(Embree::load().unwrap()).addr();
        let first = load();
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(|| assert_eq!(load(), first)))));
    }

    #[test]
    fn what_is_missing_is_named() {
        let text = Missing { reason: "no such file".into() }.to_string();
        assert!(text.contains(FILE) && text.contains("no such file") && FILE.contains("embree"), "{text}");
    }

    #[test]
    fn patches_may_differ_and_nothing_else() {
        let version = |major, minor, patch| Version { major, minor, patch };
        assert_eq!(Mismatch::between(version(4, 3, 3), version(4, 3, 0)), Ok(()));
        for loaded in [version(4, 2, 3), version(4, 4, 3), version(3, 3, 3)] {
            let mismatch = Mismatch::between(version(4, 3, 3), loaded).unwrap_err();
            let message = mismatch.to_string();
            assert!(message.contains("4.3.3") && message.contains(&loaded.to_string()), "{message}");
        }
    }
}
