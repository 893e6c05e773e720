//! The C ABI with owners: outputs that exist on success only, refusals that say why, callbacks that run out of
//! patience.

use std::cell::Cell;
use std::ffi::{c_char, c_void};
use std::mem::MaybeUninit;
use std::slice;
use std::sync::OnceLock;

use azulejo_c::context::*;
use azulejo_c::differences::*;
use azulejo_c::kept::*;
use azulejo_c::mask::*;
use azulejo_c::mesh::*;
use azulejo_c::plane_edit::*;
use azulejo_c::points::*;
use azulejo_c::psp::*;
use azulejo_c::spectrum::*;
use azulejo_c::status::*;
use azulejo_c::thin::*;

/// A handle, which its own function frees when it is dropped.
pub struct Owned<T: Freed>(*mut T);

/// A type that the library makes handles of.
pub trait Freed {
    /// The function that frees one.
    const FREE: unsafe extern "C" fn(*mut Self);
}

macro_rules! freed {
    ($($name:ty: $free:ident),*) => {
        $(impl Freed for $name {
            const FREE: unsafe extern "C" fn(*mut Self) = $free;
        })*
    };
}
freed!(
    azulejo_context: azulejo_context_free,
    azulejo_kdrt: azulejo_kdrt_free,
    azulejo_mask: azulejo_mask_free,
    azulejo_mesh: azulejo_mesh_free,
    azulejo_plane: azulejo_plane_free,
    azulejo_psp: azulejo_psp_free,
    azulejo_points: azulejo_points_free,
    azulejo_selection: azulejo_selection_free,
    azulejo_spectrum: azulejo_spectrum_free,
    azulejo_differences: azulejo_differences_free
);

impl<T: Freed> Owned<T> {
    /// The handle for a call.
    pub fn get(&self) -> *mut T {
        self.0
    }

    /// A fact of the handle, from an accessor of the library.
    pub fn read<R>(&self, accessor: unsafe extern "C" fn(*const T) -> R) -> R {
        // SAFETY: the handle lives, and that is all that accessors ask for.
        unsafe { accessor(self.0) }
    }
}

impl<T: Freed> Drop for Owned<T> {
    fn drop(&mut self) {
        // SAFETY: the only owner.
        unsafe { T::FREE(self.0) }
    }
}

// SAFETY: handles may be used from any thread.
unsafe impl<T: Freed> Send for Owned<T> {}
// SAFETY: likewise, by several at once.
unsafe impl<T: Freed> Sync for Owned<T> {}

/// A context of one thread, so that an input always does the same.
pub fn context() -> *const azulejo_context {
    static CONTEXT: OnceLock<Owned<azulejo_context>> = OnceLock::new();
    // SAFETY: the output is there.
    let make = |out: Out<_>| unsafe { azulejo_context_create(1, out) };
    CONTEXT.get_or_init(|| create(make).expect("a context of one thread")).get()
}

/// The place to which a call writes its result.
pub type Out<T> = *mut T;

/// The handle that a call makes, unless it refuses.
pub fn create<T: Freed>(call: impl FnOnce(Out<*mut T>) -> azulejo_status) -> Option<Owned<T>> {
    value(call).map(Owned)
}

/// The value that a call writes, unless it refuses.
pub fn value<T>(call: impl FnOnce(Out<T>) -> azulejo_status) -> Option<T> {
    let mut out = MaybeUninit::uninit();
    // SAFETY: a call that succeeds has written its output.
    accepted(call(out.as_mut_ptr())).then(|| unsafe { out.assume_init() })
}

/// A report for a call to write, as its init function makes it.
pub fn report<T>(init: unsafe extern "C" fn(*mut T, usize) -> azulejo_status) -> T {
    let mut report = MaybeUninit::uninit();
    // SAFETY: the struct is of this size, and the call fills it.
    unsafe {
        assert_eq!(init(report.as_mut_ptr(), size_of::<T>()), AZULEJO_OK);
        report.assume_init()
    }
}

/// The report that a call writes, unless it refuses.
pub fn reported<T>(
    init: unsafe extern "C" fn(*mut T, usize) -> azulejo_status,
    call: impl FnOnce(*mut T) -> azulejo_status,
) -> Option<T> {
    let mut report = report(init);
    accepted(call(&raw mut report)).then_some(report)
}

/// True if a call succeeded; if it did not, checks that it has a known reason, in one line.
pub fn accepted(status: azulejo_status) -> bool {
    if status == AZULEJO_OK {
        return true;
    }
    assert!((AZULEJO_ERROR_UNSUPPORTED..AZULEJO_OK).contains(&status), "status {status}: {}", last_error());
    let message = last_error();
    assert!(!message.is_empty() && message.len() < 2000 && !message.contains('\n'), "{message:?}");
    false
}

fn last_error() -> String {
    let mut buffer = vec![0u8; 2048];
    // SAFETY: the buffer is as long as that.
    let needed = unsafe { azulejo_last_error_message(buffer.as_mut_ptr().cast::<c_char>(), buffer.len()) };
    buffer.truncate(needed.saturating_sub(1).min(buffer.len() - 1));
    String::from_utf8(buffer).expect("messages are UTF-8")
}

/// The number of times that a progress callback lets a call continue, and the last fraction that it received.
pub struct Patience {
    left: Cell<u32>,
    last: Cell<f64>,
}

impl Patience {
    /// Lets the call go on `left` times.
    pub fn new(left: u32) -> Self {
        Self { left: Cell::new(left), last: Cell::new(0.0) }
    }

    /// The value of the option progress_user.
    pub fn user(&self) -> *mut c_void {
        (&raw const *self).cast_mut().cast()
    }

    /// For the next call.
    pub fn again(&self, left: u32) {
        self.left.set(left);
    }

    /// The progress callback, which has no patience where its user is NULL. A call begins with 0.
    ///
    /// # Safety
    /// `user` is NULL or that of a patience that is alive.
    pub unsafe extern "C-unwind" fn tell(user: *mut c_void, done: f64) -> u32 {
        // SAFETY: by the contract.
        let Some(patience) = (unsafe { user.cast::<Self>().as_ref() }) else { return 1 };
        let last = patience.last.replace(done);
        assert!((last..=1.0).contains(&done) || done == 0.0, "{done} after {last}");
        let left = patience.left.get();
        patience.left.set(left.saturating_sub(1));
        if left == 0 { 7 } else { 0 }
    }
}

/// The arrays of a set of samples.
pub struct Arrays<'a> {
    pub positions: &'a [f32],
    pub triangles: &'a [u32],
    pub barycentrics: &'a [f32],
    pub normals: &'a [f32],
    pub interpolated: &'a [f32],
    pub radii: &'a [f64],
    pub ranks: &'a [f32],
}

impl<'a> Arrays<'a> {
    pub fn of(points: &'a Owned<azulejo_points>) -> Self {
        let count = points.read(azulejo_points_count);
        // SAFETY: the header says how long the arrays are, and the set is borrowed as long as they are used.
        unsafe {
            Self {
                positions: array(
                    points.read(azulejo_points_positions),
                    count * points.read(azulejo_points_dimension) as usize,
                ),
                triangles: array(points.read(azulejo_points_triangles), count),
                barycentrics: array(points.read(azulejo_points_barycentrics), 2 * count),
                normals: array(points.read(azulejo_points_normals), 3 * count),
                interpolated: array(points.read(azulejo_points_interpolated_normals), 3 * count),
                radii: array(points.read(azulejo_points_radii), count),
                ranks: array(points.read(azulejo_points_ranks), count),
            }
        }
    }
}

/// # Safety
/// `start` is NULL or leads to `length` numbers that live as long as `'a`.
pub unsafe fn array<'a, T>(start: *const T, length: usize) -> &'a [T] {
    // SAFETY: by the contract.
    if start.is_null() { &[] } else { unsafe { slice::from_raw_parts(start, length) } }
}

/// Two rows are no closer than `distance` allows for their numbers, in `f64`: all pairs, so for small sets.
pub fn check_distances<const N: usize>(
    rows: &[[f32; N]],
    offset: impl Fn([f64; N], [f64; N]) -> [f64; N],
    distance: impl Fn(usize, usize) -> f64,
) {
    let exact: Vec<[f64; N]> = rows.iter().map(|row| row.map(f64::from)).collect();
    for (i, &a) in exact.iter().enumerate() {
        for (j, &b) in exact[..i].iter().enumerate() {
            let squared: f64 = offset(a, b).iter().map(|x| x * x).sum();
            let least = distance(i, j);
            assert!(squared.sqrt() >= least, "samples {j} and {i}, {b:?} and {a:?}, are closer than {least}");
        }
    }
}
