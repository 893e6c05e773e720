//! Classes of samples, and how far apart they are.

use std::ptr;
use std::time::Instant;

use azulejo_core::Classes;

use crate::boundary::{self, check_pointer, check_unused, rows};
use crate::growing::{self, Growing, growing};
use crate::status::{Failure, azulejo_status};

/// No set has more classes.
pub const AZULEJO_MAX_CLASSES: u32 = 16;
const _: () = assert!(AZULEJO_MAX_CLASSES as usize == Classes::MOST);

/// Classes of samples that stand in each other's way: the matrix of their distances. Samples of
/// classes i and j are at least r_ij apart, and no class can take another sample: for each class i
/// every place is within r_ij of some sample of some class j, up to the rounding of maximal sets.
///
/// Classes of larger own radii r_ii come first, smaller ones fill what these leave; classes of
/// equal radii are filled together. So shares jump where two radii become equal.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_classes {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The number of classes, 1 to AZULEJO_MAX_CLASSES. Required.
    pub count: u32,
    /// count * count radii, row by row; symmetric, 0 or more, above 0 on the diagonal; required.
    /// Two classes whose radius is 0 ignore each other. azulejo_classes_radii makes such a matrix.
    pub radii: *const f64,
    /// On meshes, where each class may stand: for each triangle a number with a bit for each class,
    /// the lowest for class 0. Where its bit is 0 a class has no samples and needs no cover. If the
    /// mesh has a mask, both must allow a sample. NULL, the default: everywhere.
    pub masks: *const u32,
    /// That of the mesh's triangles, or 0, the default, for none.
    pub mask_count: usize,
}

growing!(azulejo_classes requires radii {
    count: 0,
    radii: ptr::null(),
    masks: ptr::null(),
    mask_count: 0,
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_classes_init(classes: *mut azulejo_classes, struct_size: usize) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("classes", classes, struct_size) }
}

impl azulejo_classes {
    /// The classes of the struct.
    ///
    /// # Safety
    /// Unless the checks fail, `radii` leads to `count * count` numbers.
    pub(crate) unsafe fn request(&self) -> Result<Classes, Failure> {
        let count = checked_count(self.count)?;
        // SAFETY: handed on from the caller; the count is small.
        let radii = unsafe { rows::<f64, 1>("radii", self.radii, "count", count * count) }?;
        Ok(Classes::new(count, radii.as_flattened())?)
    }

    /// The classes of a plane or a cuboid, which has no triangles for masks.
    ///
    /// # Safety
    /// As [`azulejo_classes::request`].
    pub(crate) unsafe fn without_masks(&self, place: &str) -> Result<Classes, Failure> {
        check_unused("mask_count", self.mask_count, 0, place)?;
        check_unused("masks", self.masks, ptr::null(), place)?;
        // SAFETY: handed on from the caller.
        unsafe { self.request() }
    }

    /// The masks of a mesh's triangles, if there are any.
    ///
    /// # Safety
    /// Unless the check fails, `masks` is NULL or leads to `mask_count` numbers, which are not changed during `'a`.
    pub(crate) unsafe fn masks<'a>(&self) -> Result<Option<&'a [u32]>, Failure> {
        if self.masks.is_null() && self.mask_count == 0 {
            return Ok(None);
        }
        // SAFETY: handed on from the caller.
        let masks = unsafe { rows::<u32, 1>("masks", self.masks, "mask_count", self.mask_count) }?;
        Ok(Some(masks.as_flattened()))
    }
}

/// The report of calls that make samples of several classes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_classes_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The number of classes.
    pub classes: u32,
    /// The number of samples.
    pub samples: u64,
    /// The number of samples of each class, 0 for those that there are not.
    pub counts: [u64; AZULEJO_MAX_CLASSES as usize],
    /// Wall time in seconds.
    pub seconds: f64,
}

growing!(azulejo_classes_report requires samples {
    classes: 0,
    samples: 0,
    counts: [0; AZULEJO_MAX_CLASSES as usize],
    seconds: 0.0,
});

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_classes_report_init(
    report: *mut azulejo_classes_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

impl azulejo_classes_report {
    /// The report of a set, by the class of each sample.
    pub(crate) fn of(classes: usize, of_samples: &[u32], start: Instant) -> Self {
        let mut report = Self {
            classes: classes as u32,
            samples: of_samples.len() as u64,
            seconds: start.elapsed().as_secs_f64(),
            ..Self::DEFAULT
        };
        of_samples.iter().for_each(|&class| report.counts[class as usize] += 1);
        report
    }
}

fn checked_count(count: u32) -> Result<usize, Failure> {
    if (1..=AZULEJO_MAX_CLASSES).contains(&count) {
        return Ok(count as usize);
    }
    Err(Failure::invalid("count", format!("{count} classes; there are 1 to {AZULEJO_MAX_CLASSES}")))
}

/// Makes a matrix of radii from those of each class alone: two classes keep the distance that a set
/// of all samples of both, and of all classes of larger radii, would have (Wei, 2010).
///
/// own: for each class the distance of its samples, above 0.
///
/// count: the number of classes, 1 to AZULEJO_MAX_CLASSES.
///
/// factor: multiplies the radii of two different classes, 0 or more; 1 for Wei's. With smaller ones
/// each class has nearer to the density that it has alone.
///
/// out: count * count numbers, row by row.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_classes_radii(
    own: *const f64,
    count: u32,
    factor: f64,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        let count = checked_count(count)?;
        // SAFETY: handed on from the caller.
        let own = unsafe { rows::<f64, 1>("own", own, "count", count) }?;
        check_pointer("out", out)?;
        let classes = Classes::of_radii(own.as_flattened(), factor)?;
        // SAFETY: the caller's array has count * count entries.
        unsafe { out.copy_from_nonoverlapping(classes.radii().as_ptr(), count * count) };
        Ok(())
    })
}
