//! The version of the library, and what it was built with.

use azulejo_core::trace::HAS_EMBREE;

/// Changes when programs must be changed.
pub const AZULEJO_VERSION_MAJOR: u32 = 0;
/// Changes when something is added; before 1.0 also when programs must be changed.
pub const AZULEJO_VERSION_MINOR: u32 = 3;
/// Changes with corrections.
pub const AZULEJO_VERSION_PATCH: u32 = 0;
/// The version of this header: major * 10000 + minor * 100 + patch.
pub const AZULEJO_VERSION: u32 = 300;

/// The version of the library that the program runs with, to be compared with AZULEJO_VERSION.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_version() -> u32 {
    AZULEJO_VERSION
}

/// 1 if the library was built with Embree, which is loaded by the first call that uses it; else 0.
/// Without it AZULEJO_ENGINE_EMBREE and azulejo_mesh_create_from_embree are refused with
/// AZULEJO_ERROR_UNSUPPORTED; if the machine has none, with AZULEJO_ERROR_EMBREE.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_has_embree() -> u32 {
    u32::from(HAS_EMBREE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_constants_are_the_version_of_the_crate() {
        let number = AZULEJO_VERSION_MAJOR * 10000 + AZULEJO_VERSION_MINOR * 100 + AZULEJO_VERSION_PATCH;
        assert_eq!(number, AZULEJO_VERSION);
        let constants = format!("{AZULEJO_VERSION_MAJOR}.{AZULEJO_VERSION_MINOR}.{AZULEJO_VERSION_PATCH}");
        assert_eq!(constants, env!("CARGO_PKG_VERSION"));
    }
}
