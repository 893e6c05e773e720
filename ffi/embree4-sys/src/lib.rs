//! Bindings to the installed Embree: version 4, or 3.13 behind a shim with the same API.
//!
//! The functions and structs are those of Embree 4's manual, under their own names, and as few as azulejo uses. They
//! are read from the *installed* headers, since Embree's structs grow between minor versions (`RTCHit` has 32 bytes in
//! 4.2 and 48 in 4.3) and the library writes all of its own. [`check`] compares the library that was loaded with the
//! headers that were bound; call it with each new device, before anything is traced.
//!
//! # Building
//! `EMBREE_DIR` names a folder that holds Embree in `include/` and `lib/`; without it the system's is taken. Programs
//! that link an Embree outside the system's folders find it at run time by their own means (`LD_LIBRARY_PATH`, rpath).
//! Build scripts of crates that depend on this one get `DEP_EMBREE_LIBRARY` (`embree3` or `embree4`: what a static
//! library must be linked with) and, with `EMBREE_DIR`, `DEP_EMBREE_LIBRARY_DIR`.

use std::fmt;
use std::mem::size_of;

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

pub use bindings::*;
pub use bindings::{
    azulejo_rtcInitIntersectArguments as rtcInitIntersectArguments,
    azulejo_rtcInitRayQueryContext as rtcInitRayQueryContext, azulejo_rtcIntersect1 as rtcIntersect1,
    azulejo_rtcIntersect4 as rtcIntersect4, azulejo_rtcIntersect8 as rtcIntersect8,
    azulejo_rtcIntersect16 as rtcIntersect16,
};

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

/// The version of the library that was loaded.
///
/// # Safety
/// `device` is a device that has not been released.
pub unsafe fn loaded_version(device: RTCDevice) -> Version {
    // SAFETY: the device is valid by the contract of this function.
    let number = |property| unsafe { rtcGetDeviceProperty(device, property) } as u32;
    Version {
        major: number(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
        minor: number(RTC_DEVICE_PROPERTY_VERSION_MINOR),
        patch: number(RTC_DEVICE_PROPERTY_VERSION_PATCH),
    }
}

/// Compares the loaded library with the one that this crate was built for: its version, and the sizes of the structs.
///
/// # Errors
/// The first [`Mismatch`]. Tracing would then read and write outside the structs.
///
/// # Safety
/// `device` is a device that has not been released.
pub unsafe fn check(device: RTCDevice) -> Result<(), Mismatch> {
    // SAFETY: the device is valid by the contract of this function.
    Mismatch::between(BOUND_VERSION, unsafe { loaded_version(device) })?;
    // SAFETY: the function reads nothing; it returns constants of the C compiler.
    let sizes = unsafe { azulejo_sizes() };
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

#[cfg(test)]
mod tests {
    use super::*;

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
