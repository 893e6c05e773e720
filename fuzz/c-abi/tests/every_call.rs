//! Every call of the C ABI that needs no Embree and one thread only: small enough for Miri, which sees undefined
//! behaviour at the FFI boundary that nothing else sees (scripts/miri.sh).

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use azulejo_c::adaptive::*;
use azulejo_c::analysis::*;
use azulejo_c::classes::*;
use azulejo_c::context::*;
use azulejo_c::dcr::*;
use azulejo_c::domain::*;
use azulejo_c::inside::*;
use azulejo_c::instances::*;
use azulejo_c::kdrt::*;
use azulejo_c::kdrt_classes::*;
use azulejo_c::kept::*;
use azulejo_c::mask::*;
use azulejo_c::maximal::*;
use azulejo_c::merge::*;
use azulejo_c::mesh::*;
use azulejo_c::mesh_density::*;
use azulejo_c::order::*;
use azulejo_c::plane_edit::*;
use azulejo_c::points::*;
use azulejo_c::psp::*;
use azulejo_c::psp_classes::*;
use azulejo_c::psp_edit::*;
use azulejo_c::region::*;
use azulejo_c::spectrum::*;
use azulejo_c::statistics::*;
use azulejo_c::status::*;
use azulejo_c::thin::*;
use azulejo_c::version::{azulejo_has_embree, azulejo_version};
use azulejo_c::volume::*;
use azulejo_c::volume_adaptive::*;
use azulejo_c::volume_relax::*;

/// A handle, which its own function frees when it is dropped.
struct Owned<T: Freed>(*mut T);

/// A type that the library makes handles of.
trait Freed {
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
    azulejo_plane: azulejo_plane_free,
    azulejo_mesh: azulejo_mesh_free,
    azulejo_psp: azulejo_psp_free,
    azulejo_points: azulejo_points_free,
    azulejo_selection: azulejo_selection_free,
    azulejo_mask: azulejo_mask_free
);

impl<T: Freed> Owned<T> {
    /// The handle for a call.
    fn get(&self) -> *mut T {
        self.0
    }

    /// A fact of the handle, from an accessor of the library.
    fn read<R>(&self, accessor: unsafe extern "C" fn(*const T) -> R) -> R {
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

type Out<T> = *mut T;

/// The handle that a call makes, which has to succeed.
fn made<T: Freed>(call: impl FnOnce(Out<*mut T>) -> azulejo_status) -> Owned<T> {
    Owned(value(call))
}

/// The output of a call, which has to succeed.
fn value<T>(call: impl FnOnce(Out<T>) -> azulejo_status) -> T {
    let mut out = MaybeUninit::uninit();
    assert_eq!(call(out.as_mut_ptr()), AZULEJO_OK, "{}", last_error());
    // SAFETY: the call has succeeded.
    unsafe { out.assume_init() }
}

fn last_error() -> String {
    let mut buffer = [0u8; 300];
    // SAFETY: the buffer is as long as that.
    let needed = unsafe { azulejo_last_error_message(buffer.as_mut_ptr().cast(), buffer.len()) };
    String::from_utf8_lossy(&buffer[..needed.saturating_sub(1).min(299)]).into_owned()
}

/// Options with their defaults.
fn defaults<T>(init: unsafe extern "C" fn(*mut T, usize) -> azulejo_status) -> T {
    let mut options = MaybeUninit::uninit();
    // SAFETY: the struct is of this size, and the call fills it.
    unsafe {
        assert_eq!(init(options.as_mut_ptr(), size_of::<T>()), AZULEJO_OK);
        options.assume_init()
    }
}

fn context() -> Owned<azulejo_context> {
    // SAFETY: the output is there.
    made(|out| unsafe { azulejo_context_create(1, out) })
}

/// Two triangles, with something between the vertices.
fn mesh() -> Owned<azulejo_mesh> {
    let rows = [[0.0f32, 0.0, 0.0, 9.0], [1.0, 0.0, 0.0, 9.0], [1.0, 1.0, 0.0, 9.0], [0.0, 1.0, 0.5, 9.0]];
    let indices = [0u32, 1, 2, 0, 2, 3];
    // SAFETY: four vertices, two triangles.
    made(|out| unsafe { azulejo_mesh_create(rows.as_ptr().cast(), 4, 16, indices.as_ptr(), 2, out) })
}

/// Reads all arrays of a set to their ends, and frees it; returns how many samples there were.
fn read_and_free(points: Owned<azulejo_points>) -> usize {
    let set = &points;
    let count = set.read(azulejo_points_count);
    let sum = |start: *const f32, length: usize| -> f32 {
        // SAFETY: the header says that the arrays are that long.
        (0..if start.is_null() { 0 } else { length }).map(|i| unsafe { start.add(i).read() }).sum()
    };
    assert!(sum(set.read(azulejo_points_positions), count * set.read(azulejo_points_dimension) as usize).is_finite());
    for array in [set.read(azulejo_points_normals), set.read(azulejo_points_interpolated_normals)] {
        assert!(sum(array, 3 * count).is_finite());
    }
    assert!(sum(set.read(azulejo_points_barycentrics), 2 * count).is_finite());
    let (triangles, radii) = (set.read(azulejo_points_triangles), set.read(azulejo_points_radii));
    // SAFETY: as above.
    assert!((0..count).all(|i| triangles.is_null() || unsafe { triangles.add(i).read() } < 2));
    // SAFETY: as above.
    assert!((0..count).all(|i| radii.is_null() || unsafe { radii.add(i).read() } > 0.0));
    let classes = set.read(azulejo_points_classes);
    // SAFETY: as above.
    assert!((0..count).all(|i| classes.is_null() || unsafe { classes.add(i).read() } < AZULEJO_MAX_CLASSES));
    drop(points);
    count
}

/// Counts how often it is called.
unsafe extern "C-unwind" fn count(user: *mut c_void, _: f64) -> u32 {
    // SAFETY: the tests give it a number.
    unsafe { *user.cast::<u32>() += 1 };
    0
}

unsafe extern "C-unwind" fn stop(_: *mut c_void, _: f64) -> u32 {
    1
}

unsafe extern "C-unwind" fn visit(user: *mut c_void, xy: *const f32, samples: usize) -> u32 {
    // SAFETY: the test gives it a number; the library gives it so many samples.
    unsafe {
        assert!((0..2 * samples).all(|i| xy.add(i).read() >= 0.0));
        *user.cast::<u32>() += samples as u32;
    }
    0
}

unsafe extern "C-unwind" fn radius_at(_: *mut c_void, position: *const f64) -> f64 {
    // SAFETY: three coordinates.
    unsafe { 0.8 + 0.1 * position.read() + 0.0 * position.add(2).read() }
}

#[test]
fn planes() {
    let context = context();
    let mut calls = 0u32;
    let mut options = defaults(azulejo_kdrt_options_init);
    options.radius = 0.45;
    options.progress = Some(count);
    options.progress_user = (&raw mut calls).cast();
    // SAFETY: the options have the size in their `struct_size`, here and below.
    unsafe {
        assert!(read_and_free(made(|out| azulejo_kdrt_sample(context.get(), &options, out, null_mut()))) > 2);
        let corners = [[0.0, 0.0], [0.5, 1.0f64]];
        let [low, high] = [corners[0].as_ptr(), corners[1].as_ptr()];
        read_and_free(made(|out| {
            azulejo_kdrt_sample_window(context.get(), &options, low, high, out, std::ptr::null_mut())
        }));
        let plane = made(|out| azulejo_kdrt_create(context.get(), &options, out));
        read_and_free(made(|out| azulejo_kdrt_window(plane.get(), low, high, out)));
        let (mut count, mut room, mut positions) = (0, 0, [0f32; 64]);
        assert_eq!(azulejo_kdrt_window_capacity(plane.get(), high, &raw mut room), AZULEJO_OK);
        assert!(room <= 32 && azulejo_kdrt_unit(plane.get()) > 0.0);
        let mut into = |capacity, count| {
            let positions = positions.as_mut_ptr();
            azulejo_kdrt_window_into(plane.get(), low, high, positions, null_mut(), null_mut(), capacity, count)
        };
        assert_eq!(into(room, &raw mut count), AZULEJO_OK);
        assert!(count <= room);
        let refused = if count == 0 { AZULEJO_OK } else { AZULEJO_ERROR_INVALID_ARGUMENT };
        assert_eq!(into(0, &raw mut count), refused);
        drop(plane);
        let mut wide = null_mut();
        let status = azulejo_kdrt_create_wide(context.get(), &options, &raw mut wide);
        assert_eq!(status, AZULEJO_ERROR_INVALID_ARGUMENT, "one that is not tiled");
        for count in [0, 1] {
            let plane = made(|out| azulejo_plane_create(context.get(), &options, [0.25f32, 0.5].as_ptr(), count, out));
            edit_plane(plane.get());
            assert!(read_and_free(made(|out| azulejo_plane_points(plane.get(), out))) > 2);
            drop(plane);
        }
        let (mut matrix, mut classes) = ([0f64; 4], defaults(azulejo_classes_init));
        assert_eq!(azulejo_classes_radii([0.45f64, 0.3].as_ptr(), 2, 1.0, matrix.as_mut_ptr()), AZULEJO_OK);
        (classes.count, classes.radii) = (2, matrix.as_ptr());
        let alone = azulejo_kdrt_options { radius: 0.0, ..options };
        let set = made(|out| azulejo_kdrt_sample_classes(context.get(), &alone, &classes, out, std::ptr::null_mut()));
        assert_eq!(set.read(azulejo_points_classes).read(), 0);
        read_and_free(set);
        let plane = made(|out| azulejo_kdrt_create_classes(context.get(), &alone, &classes, out));
        read_and_free(made(|out| azulejo_kdrt_window(plane.get(), low, high, out)));
        drop(plane);
        let mut visited = 0u32;
        assert_eq!(
            azulejo_kdrt_stream(context.get(), &options, Some(visit), (&raw mut visited).cast(), std::ptr::null_mut()),
            AZULEJO_OK
        );
        assert!(visited > 2 && calls > 0);
        options.progress = Some(stop);
        let mut none = null_mut();
        assert_eq!(azulejo_kdrt_sample(context.get(), &options, &raw mut none, null_mut()), AZULEJO_ERROR_CANCELLED);

        let mut options = defaults(azulejo_maximal_options_init);
        options.radius = 0.5;
        read_and_free(made(|out| azulejo_maximal_sample(context.get(), &options, out, std::ptr::null_mut())));

        let mut options = defaults(azulejo_volume_options_init);
        options.radius = 0.7;
        let (xyz, clearance) = ([0.5f32; 3], 0.4f64);
        (options.given_positions, options.given_clearances) = (xyz.as_ptr(), &raw const clearance);
        options.given_count = 1;
        read_and_free(made(|out| azulejo_volume_sample(context.get(), &options, out, std::ptr::null_mut())));
        let of_classes = defaults(azulejo_volume_options_init);
        let mut apart = [0f64; 4];
        assert_eq!(azulejo_classes_radii([1.5f64, 0.9].as_ptr(), 2, 1.0, apart.as_mut_ptr()), AZULEJO_OK);
        classes.radii = apart.as_ptr();
        read_and_free(made(|out| {
            azulejo_volume_sample_classes(context.get(), &of_classes, &classes, out, std::ptr::null_mut())
        }));
        (options.radius, options.count, options.order) = (0.0, 3, AZULEJO_ORDER_PROGRESSIVE);
        read_and_free(made(|out| azulejo_volume_sample(context.get(), &options, out, std::ptr::null_mut())));

        let mut options = defaults(azulejo_volume_adaptive_options_init);
        let mut report = defaults(azulejo_volume_report_init);
        options.radius_function = Some(radius_at);
        (options.smallest, options.largest, options.slope) = (0.8, 1.0, 0.1);
        let mesh = std::ptr::null();
        let count = read_and_free(made(|out| {
            azulejo_volume_adaptive_sample(context.get(), mesh, &options, out, &raw mut report)
        }));
        assert!(count > 0 && report.samples == count as u64);
        let values = [0.8f32, 0.9];
        options.radius_function = None;
        (options.smallest, options.largest, options.slope) = (0.0, 0.0, 0.0);
        (options.grid_values, options.grid_size) = (values.as_ptr(), [1, 2, 1]);
        read_and_free(made(|out| azulejo_volume_adaptive_sample(context.get(), mesh, &options, out, null_mut())));

        let mut options = defaults(azulejo_volume_relax_options_init);
        options.max_iterations = 2;
        let mut report = defaults(azulejo_volume_relax_report_init);
        let apart = [0.2f32, 0.2, 0.2, 0.3, 0.2, 0.2];
        read_and_free(made(|out| {
            azulejo_volume_relax(context.get(), &options, apart.as_ptr(), 2, out, &raw mut report)
        }));
        assert!(report.iterations == 2 && report.rho > 0.1);

        let mut options = defaults(azulejo_kdrt_merge_options_init);
        options.radius = 0.5;
        let xy = [0.25f32, 0.5];
        let piece = azulejo_kdrt_merge_piece { positions: xy.as_ptr(), count: 1, min: [0.0; 2], max: [0.5, 1.0] };
        let fixed = [0.75f32, 0.5];
        let mut report = defaults(azulejo_kdrt_merge_report_init);
        let merge = |out: Out<_>| {
            azulejo_kdrt_merge(
                context.get(),
                &options,
                &piece,
                1,
                size_of::<azulejo_kdrt_merge_piece>(),
                fixed.as_ptr(),
                1,
                out,
                &raw mut report,
            )
        };
        assert!(read_and_free(made(merge)) >= 2);
        assert_eq!(report.kept, 1);
    }
    drop(context);
}

#[test]
fn clouds() {
    let context = context();
    let cloud: [[f32; 2]; 21] = std::array::from_fn(|i| [(i * i % 21) as f32, (i % 5) as f32]);
    let mut options = defaults(azulejo_thin_options_init);
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    for (count, dimensions) in [(21, 2), (14, 3), (0, 2)] {
        // SAFETY: 21 points of the plane, 14 of space.
        let selection = made(|out| unsafe {
            azulejo_thin(context.get(), &options, cloud.as_ptr().cast(), count, dimensions, out, std::ptr::null_mut())
        });
        assert_eq!(selection.read(azulejo_selection_count), count);
        let (indices, ranks) = (selection.read(azulejo_selection_indices), selection.read(azulejo_selection_ranks));
        for i in 0..count {
            // SAFETY: the arrays have an entry for each point.
            assert!(unsafe { (*indices.add(i) as usize) < count && *ranks.add(i) >= 0.0 });
        }
        drop(selection);
    }
    drop(context);
}

#[test]
fn masks() {
    let context = context();
    let mut options = defaults(azulejo_mask_options_init);
    (options.width, options.height, options.channels) = (5, 3, 2);
    let mut report = defaults(azulejo_mask_report_init);
    // SAFETY: the options and the report are of their types.
    let mask = made(|out| unsafe { azulejo_mask_create(context.get(), &options, out, &mut report) });
    assert_eq!((report.pixels, mask.read(azulejo_mask_channels)), (15, 2));
    let mut values = [0.0f32; 30];
    let (floats, bytes, mut levels) = ([0.5f32; 12], [255u8; 12], [7u8; 12]);
    // SAFETY: the arrays have a number for each pixel and channel, none where there are none.
    unsafe {
        assert_eq!([0, 1, 2, 3].map(|axis| azulejo_mask_size(mask.get(), axis)), [5, 3, 1, 0]);
        assert!((0..30).all(|i| *mask.read(azulejo_mask_ranks).add(i) < 15));
        assert_eq!(azulejo_mask_values(mask.get(), values.as_mut_ptr()), AZULEJO_OK);
        let out = levels.as_mut_ptr();
        assert_eq!(azulejo_mask_dither(mask.get(), floats.as_ptr(), 2, 2, 1, 3, 4, out), AZULEJO_OK);
        assert_eq!(azulejo_mask_dither_bytes(mask.get(), bytes.as_ptr(), 3, 2, 2, 1, 2, out), AZULEJO_OK);
        assert_eq!(azulejo_mask_dither(mask.get(), null(), 0, 2, 1, 1, 2, null_mut()), AZULEJO_OK);
        assert!(azulejo_mask_dither(mask.get(), null(), 1, 1, 1, 1, 2, out) < 0);
        assert!(azulejo_mask_dither(mask.get(), floats.as_ptr(), usize::MAX, 2, 1, 1, 2, out) < 0);
        assert!(azulejo_mask_dither(mask.get(), floats.as_ptr(), 2, 2, 1, 3, 4, null_mut()) < 0);
        assert!(azulejo_mask_values(mask.get(), null_mut()) < 0);
    }
    assert!(values.iter().all(|value| (0.0..1.0).contains(value)) && levels == [1; 12]);
    drop(mask);
    drop(context);
}

#[test]
fn surfaces() {
    let (context, mesh) = (context(), mesh());
    let normals = [0.0f32, 0.0, 1.0];
    // SAFETY: the arrays have the given lengths.
    let (normal, masked) = unsafe {
        (
            made(|out| azulejo_mesh_with_normals(mesh.get(), normals.as_ptr(), 1, 12, [0u32; 6].as_ptr(), 2, out)),
            made(|out| azulejo_mesh_with_mask(mesh.get(), [1u8, 0].as_ptr(), 2, out)),
        )
    };
    assert_eq!((normal.read(azulejo_mesh_has_normals), masked.read(azulejo_mesh_vertex_count)), (1, 4));
    let mut origin = [9.0; 3];
    // SAFETY: NULL is no mesh, and there is room for three numbers.
    unsafe { azulejo_mesh_origin(std::ptr::null(), origin.as_mut_ptr()) };
    assert_eq!(origin, [0.0; 3]);
    // SAFETY: four vertices, two triangles.
    unsafe {
        assert_eq!(mesh.read(azulejo_mesh_positions).add(11).read(), 0.5);
        assert_eq!(mesh.read(azulejo_mesh_indices).add(5).read(), 3);
    }
    let moved = [[0.0f32, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 2.0, 1.0], [0.0, 2.0, 1.0]];
    let (triangles, places) = ([1u32, 0], [[0.5f32, 0.25], [0.0, 1.0]]);
    // SAFETY: four vertices without gaps, and two places.
    unsafe {
        let deformed = made(|out| azulejo_mesh_deform(mesh.get(), moved.as_ptr().cast(), 4, 12, out));
        let places = places.as_ptr().cast();
        let points = made(|out| azulejo_mesh_points(deformed.get(), triangles.as_ptr(), places, 2, out));
        let positions = points.read(azulejo_points_positions).cast::<[f32; 3]>();
        assert_eq!((positions.read(), positions.add(1).read()), ([1.0, 1.5, 1.0], [2.0, 2.0, 1.0]));
        assert_eq!(read_and_free(points), 2);
        drop(deformed);
    }
    // SAFETY: the arrays have the given lengths.
    unsafe {
        let (points, mut inside) = ([0.25f32, 0.25, 0.0, 9.0, 9.0, 9.0], [7u8; 2]);
        assert_eq!(mesh.read(azulejo_mesh_is_closed), 0);
        let status = azulejo_mesh_contains(context.get(), mesh.get(), points.as_ptr(), 2, inside.as_mut_ptr());
        assert_eq!((status, inside[1]), (AZULEJO_OK, 0));
        let mut options = defaults(azulejo_volume_inside_options_init);
        let mut report = defaults(azulejo_volume_inside_report_init);
        (options.radius, options.tolerance, options.surface) = (0.9, 0.5, AZULEJO_SURFACE_FIRST);
        let handle = context.get();
        let corners = [[0.0f32, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
        let faces = [[0u32, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let flat = made(|out| azulejo_mesh_create(corners.as_ptr().cast(), 4, 12, faces.as_ptr().cast(), 1, out));
        let (none, unread) = (&mut std::ptr::null_mut(), std::ptr::null_mut());
        let refused = azulejo_volume_sample_inside(handle, flat.get(), &options, none, unread);
        assert_eq!(refused, AZULEJO_ERROR_INVALID_ARGUMENT);
        let solid = made(|out| azulejo_mesh_create(corners.as_ptr().cast(), 4, 12, faces.as_ptr().cast(), 4, out));
        assert_eq!(solid.read(azulejo_mesh_is_closed), 1);
        let count = read_and_free(made(|out| {
            azulejo_volume_sample_inside(handle, solid.get(), &options, out, &raw mut report)
        }));
        assert!(report.depth > 0.0 && report.samples >= report.surface_samples && report.surface_samples > 3);
        assert_eq!(report.samples, count as u64);
        // It asks for many distances, which takes minutes there.
        if !cfg!(miri) {
            options.thickness = 0.1;
            let shell = read_and_free(made(|out| {
                azulejo_volume_sample_inside(handle, solid.get(), &options, out, &raw mut report)
            }));
            assert!(shell > 3 && report.samples == shell as u64);
        }
        let (inside, fixed) = ([0.25f32, 0.25, 0.25, 0.5, 0.25, 0.25], [1u8, 0]);
        let mut options = defaults(azulejo_relax_inside_options_init);
        (options.fixed, options.fixed_count, options.max_iterations) = (fixed.as_ptr(), 2, 2);
        let mut report = defaults(azulejo_volume_relax_report_init);
        let count = read_and_free(made(|out| {
            azulejo_volume_relax_inside(handle, solid.get(), &options, inside.as_ptr(), 2, out, &raw mut report)
        }));
        assert!(count == 2 && report.smallest_distance > 0.25);
        (options.fixed, options.fixed_count) = (null(), 0);
        let (on_surface, sliding) = ([0.25f32, 0.25, 0.0], [1u8]);
        (options.sliding, options.sliding_count) = (sliding.as_ptr(), 1);
        let count = read_and_free(made(|out| {
            azulejo_volume_relax_inside(handle, solid.get(), &options, on_surface.as_ptr(), 1, out, null_mut())
        }));
        assert_eq!(count, 1);
    }
    let mut options = defaults(azulejo_psp_options_init);
    (options.radius, options.engine) = (0.9, AZULEJO_ENGINE_RASTERISER);
    // SAFETY: the options have the size in their `struct_size`; the handle lives.
    unsafe {
        if !cfg!(miri) {
            read_and_free(made(|out| azulejo_psp_sample(context.get(), normal.get(), &options, out, null_mut())));
            let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
            let (prototype, instance) =
                (normal.get().cast_const(), azulejo_instance { prototype: 0, reserved: 0, transform: identity });
            read_and_free(made(|out| {
                let (context, size, mut options) = (context.get(), size_of_val(&instance), options);
                options.engine = AZULEJO_ENGINE_AUTO;
                azulejo_psp_sample_instances(context, &prototype, 1, &instance, 1, size, &options, out, null_mut())
            }));
            let (mut classes, mut radii, masks) = (defaults(azulejo_classes_init), [0.0; 4], [1u32, 3]);
            assert_eq!(azulejo_classes_radii([0.9, 0.7].as_ptr(), 2, 1.0, radii.as_mut_ptr()), AZULEJO_OK);
            (classes.count, classes.radii, classes.masks, classes.mask_count) = (2, radii.as_ptr(), masks.as_ptr(), 2);
            let options = defaults(azulejo_psp_options_init);
            let sample = |out: Out<_>| {
                azulejo_psp_sample_classes(context.get(), normal.get(), &options, &classes, out, std::ptr::null_mut())
            };
            read_and_free(made(sample));
            let (values, mut density) = ([1.0f32, 2.0, 1.0, 3.0], defaults(azulejo_mesh_density_init));
            (density.vertex_values, density.vertex_count, density.radius) = (values.as_ptr(), values.len(), 1.0);
            read_and_free(made(|out| {
                let (mesh, report) = (normal.get(), null_mut());
                azulejo_psp_classes_with_density(context.get(), mesh, &options, &classes, &density, out, report)
            }));
        }
        let set = made(|out| azulejo_psp_create(context.get(), masked.get(), &options, out));
        drop(masked);
        let handle = set.get();
        // Patterns and fragments take Miri minutes.
        let iterations = if cfg!(miri) { 0 } else { 1 };
        assert_eq!(azulejo_psp_advance(handle, iterations, null_mut()), AZULEJO_OK);
        assert!(cfg!(miri) || azulejo_psp_fill(handle, null_mut()) == AZULEJO_OK);
        edit(handle);
        assert!(read_and_free(made(|out| azulejo_psp_points(set.get(), out))) > 0 || cfg!(miri));
        drop(set);
    }
    drop(normal);
    drop(mesh);
    drop(context);
}

/// Edits of a set, which has no samples yet under Miri.
///
/// # Safety
/// The handle lives.
unsafe fn edit(set: *mut azulejo_psp) {
    let mut all = defaults(azulejo_region_init);
    let (place, clearance, mut id) = ([0.5f32, 0.5, 0.0], 0.1f64, 7u64);
    // SAFETY: the handle lives, and the arrays have the given lengths.
    unsafe {
        read_and_free(made(|out: Out<_>| azulejo_psp_add_given(set, place.as_ptr(), &clearance, 1, &mut id, out)));
        assert_eq!(azulejo_psp_remove_given(set, &id, 1), AZULEJO_OK);
        assert_eq!(azulejo_psp_remove_given(set, &id, 1), AZULEJO_ERROR_INVALID_ARGUMENT);
        let erased = made(|out| azulejo_psp_erase(set, &all, out));
        let (ids, count) = (erased.read(azulejo_points_ids), erased.read(azulejo_points_count));
        assert_eq!(azulejo_psp_restore(set, erased.get()), AZULEJO_OK);
        assert_eq!(azulejo_psp_erase_ids(set, ids, count, null_mut()), AZULEJO_OK);
        assert_eq!(azulejo_psp_erase_ids(set, &id, 1, null_mut()), AZULEJO_ERROR_INVALID_ARGUMENT);
        all.radius = f64::NAN;
        assert_eq!(azulejo_psp_erase(set, &all, null_mut()), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert!(cfg!(miri) || azulejo_psp_refill(set, 3, null_mut(), null_mut()) == AZULEJO_OK);
    }
}

/// Edits of a set of the plane.
///
/// # Safety
/// The handle lives.
unsafe fn edit_plane(set: *mut azulejo_plane) {
    let mut all = defaults(azulejo_region_init);
    let (place, clearance, mut id) = ([0.9f32, 0.1], 0.1f64, 7u64);
    // SAFETY: the handle lives, and the arrays have the given lengths.
    unsafe {
        read_and_free(made(|out: Out<_>| azulejo_plane_add_given(set, place.as_ptr(), &clearance, 1, &mut id, out)));
        assert_eq!(azulejo_plane_remove_given(set, &id, 1), AZULEJO_OK);
        assert_eq!(azulejo_plane_remove_given(set, &id, 1), AZULEJO_ERROR_INVALID_ARGUMENT);
        let erased = made(|out| azulejo_plane_erase(set, &all, out));
        let (ids, count) = (erased.read(azulejo_points_ids), erased.read(azulejo_points_count));
        assert_eq!(azulejo_plane_restore(set, erased.get()), AZULEJO_OK);
        assert_eq!(azulejo_plane_erase_ids(set, ids, count, null_mut()), AZULEJO_OK);
        assert_eq!(azulejo_plane_erase_ids(set, &1000, 1, null_mut()), AZULEJO_ERROR_INVALID_ARGUMENT);
        all.radius = f64::NAN;
        assert_eq!(azulejo_plane_erase(set, &all, null_mut()), AZULEJO_ERROR_INVALID_ARGUMENT);
        let mut report = defaults(azulejo_kdrt_report_init);
        read_and_free(made(|out| azulejo_plane_refill(set, 3, out, &mut report)));
        assert!(report.samples > 2);
    }
}

/// Its options are read by Miri, its samples are not: they are estimated on 100,000 pieces.
#[test]
fn adaptive_surfaces() {
    let (context, mesh) = (context(), mesh());
    let mut options = defaults(azulejo_psp_adaptive_options_init);
    let mut out = MaybeUninit::uninit();
    // SAFETY: the options have the size in their `struct_size`, and the array has four radii.
    unsafe {
        options.cosine = f64::NAN;
        let radii = [0.8f32, 0.9, 1.0, 1.1];
        options.vertex_radii = radii.as_ptr();
        options.vertex_count = 4;
        let refused = azulejo_psp_adaptive_sample(context.get(), mesh.get(), &options, out.as_mut_ptr(), null_mut());
        assert_eq!(refused, AZULEJO_ERROR_INVALID_ARGUMENT);
        options.cosine = -1.0;
        if cfg!(miri) {
            drop(mesh);
            drop(context);
            return;
        }
        read_and_free(made(|out| azulejo_psp_adaptive_sample(context.get(), mesh.get(), &options, out, null_mut())));
        (options.vertex_radii, options.vertex_count) = (null(), 0);
        options.radius_function = Some(radius_at);
        (options.smallest, options.largest, options.slope, options.radius_function_user) = (0.8, 1.0, 0.1, null_mut());
        read_and_free(made(|out| azulejo_psp_adaptive_sample(context.get(), mesh.get(), &options, out, null_mut())));
    }
    drop(mesh);
    drop(context);
}

#[test]
fn points() {
    let context = context();
    let xy = [0.1f32, 0.2, 0.8, 0.3, 0.5, 0.9];
    let mut options = defaults(azulejo_dcr_options_init);
    options.max_iterations = 2;
    // SAFETY: all arrays have the given lengths.
    unsafe {
        for method in [AZULEJO_METHOD_MOMENTUM, AZULEJO_METHOD_THESIS] {
            options.method = method;
            let relax = |out: Out<_>| azulejo_dcr_relax(context.get(), &options, xy.as_ptr(), 3, out, null_mut());
            assert_eq!(read_and_free(made(relax)), 3);
        }
        options.method = AZULEJO_METHOD_MOMENTUM;
        let (classes, mut rho, mut coverage) = ([0u32, 1, 0], [0.0; 2], [0.0; 2]);
        let (rho, coverage) = (rho.as_mut_ptr(), coverage.as_mut_ptr());
        let (xy_of, of) = (xy.as_ptr(), classes.as_ptr());
        let relax = |out: Out<_>| {
            azulejo_dcr_relax_classes(context.get(), &options, xy_of, of, 3, 2, rho, coverage, out, null_mut())
        };
        assert_eq!(read_and_free(made(relax)), 3);
        let mut correlation = [0.0; 40];
        let status = azulejo_dcr_correlation_of_power(0.5, [0.0].as_ptr(), 1, 4.0, 40, correlation.as_mut_ptr());
        assert_eq!(status, AZULEJO_OK);
        let (g, mut residual) = (correlation.as_ptr(), -1.0);
        let relax = |out: Out<_>| {
            azulejo_dcr_relax_to_correlation(
                context.get(),
                &options,
                xy.as_ptr(),
                3,
                4.0,
                g,
                40,
                &raw mut residual,
                out,
                null_mut(),
            )
        };
        assert_eq!(read_and_free(made(relax)), 3);
        assert!(residual >= 0.0);
        let mut set = defaults(azulejo_plane_set_init);
        (set.positions, set.count, set.boundary) = (xy.as_ptr(), 3, AZULEJO_BOUNDARY_BOUNDED);
        for figure in [azulejo_plane_smallest_distance, azulejo_plane_covering_radius] {
            assert!(value(|out| figure(context.get(), &set, out)) > 0.0);
        }
        let mut report = defaults(azulejo_plane_report_init);
        report.struct_size = std::mem::offset_of!(azulejo_plane_report, smallest_distance) as u32;
        assert_eq!(azulejo_plane_measure(context.get(), &set, &mut report), AZULEJO_OK);
        assert_eq!((report.count, report.smallest_distance), (3, 0.0));
        let mut set = defaults(azulejo_space_set_init);
        // On a torus, with all images of two points, Miri would take minutes.
        (set.positions, set.count, set.boundary) = (xy.as_ptr(), 2, AZULEJO_BOUNDARY_BOUNDED);
        let mut report = defaults(azulejo_space_report_init);
        report.struct_size = std::mem::offset_of!(azulejo_space_report, rho) as u32;
        assert_eq!(azulejo_space_measure(context.get(), &set, 2.0, &mut report), AZULEJO_OK);
        assert_eq!((report.count, report.conflicts, report.rho), (2, 1, 0.0));
        let mut coverage = defaults(azulejo_coverage_report_init);
        assert_eq!(azulejo_space_coverage(context.get(), &set, 2.0, &mut coverage), AZULEJO_OK);
        assert!(coverage.gaps == 0 && coverage.covering_radius > 0.5);
        // A gap that is small, for the same reason.
        let radius = 0.99 * coverage.covering_radius;
        assert_eq!(azulejo_space_coverage(context.get(), &set, radius, &mut coverage), AZULEJO_OK);
        assert!(coverage.gaps > 0);
        let mut annulus = azulejo_annulus { frequency: 0.0, power: 0.0, anisotropy: 0.0, count: 0 };
        let size = size_of::<azulejo_annulus>();
        let radial = |out: Out<_>| azulejo_space_spectrum(context.get(), &set, 1.5, 1, 1.5, &mut annulus, 1, size, out);
        assert_eq!(value(radial), 1);
        assert!(annulus.count >= 2);
        let (mut power, mut density) = ([-1.0; 2], [-1.0; 2]);
        assert_eq!(azulejo_space_axis_power(context.get(), &set, 2, 2, power.as_mut_ptr()), AZULEJO_OK);
        assert_eq!(azulejo_space_radial_distribution(context.get(), &set, 0.3, 2, density.as_mut_ptr()), AZULEJO_OK);
        assert!(power.iter().chain(&density).all(|&figure| figure >= 0.0));
        assert!(value(|out| azulejo_space_smallest_distance(context.get(), xy.as_ptr(), 2, out)) > 0.0);
        let mesh = mesh();
        let uncovered =
            |out: Out<_>| azulejo_mesh_uncovered_fraction(context.get(), mesh.get(), xy.as_ptr(), 2, 9.0, 3, 1, out);
        assert_eq!(value(uncovered), 0.0);
        drop(mesh);
    }
    drop(context);
}

#[test]
fn refusals() {
    let mut out = MaybeUninit::uninit();
    // SAFETY: nothing is read where a pointer is NULL or a size is wrong.
    unsafe {
        assert_eq!(azulejo_kdrt_sample(null(), null(), out.as_mut_ptr(), null_mut()), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert!(last_error().contains("context"));
        let mut mesh = MaybeUninit::uninit();
        let refused = azulejo_mesh_create(null(), 3, 12, null(), 1, mesh.as_mut_ptr());
        assert_eq!(refused, AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(azulejo_mesh_load(null(), mesh.as_mut_ptr()), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(azulejo_psp_fill(null_mut(), null_mut()), AZULEJO_ERROR_INVALID_ARGUMENT);
        // A struct that ends where it says, in memory that ends there, too.
        let mut short = [0u32; 4];
        short[0] = 16;
        let context = context();
        assert!(azulejo_kdrt_sample(context.get(), short.as_ptr().cast(), out.as_mut_ptr(), null_mut()) < 0);
        drop(context);
    }
    // SAFETY: NULL is none.
    unsafe {
        azulejo_points_free(null_mut());
        azulejo_mesh_free(null_mut());
    }
    assert!(azulejo_version() > 0 && azulejo_has_embree() == 1);
}
