//! Options structs of every size and content, in memory that ends where they say that they end.

#![no_main]

use std::alloc::{Layout, alloc_zeroed, dealloc, handle_alloc_error};
use std::ffi::c_void;
use std::ptr::null_mut;

use azulejo_c::adaptive::*;
use azulejo_c::dcr::*;
use azulejo_c::kdrt::*;
use azulejo_c::maximal::*;
use azulejo_c::merge::*;
use azulejo_c::mesh::{azulejo_mesh, azulejo_mesh_create};
use azulejo_c::psp::*;
use azulejo_c::status::{AZULEJO_OK, azulejo_status};
use azulejo_c::volume::*;
use azulejo_fuzz::calls::{Arrays, Owned, Patience, accepted, array, context, create};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    // Every call ends with its first report of progress, but streams: sizes do not matter here, and a set may be as
    // large as it likes.
    let patience = Patience::new(0);
    match input.below(7) {
        0 => kdrt(&mut input, &patience),
        1 => maximal(&mut input, &patience),
        2 => merge(&mut input, &patience),
        3 => psp(&mut input, &patience),
        4 => adaptive(&mut input, &patience),
        5 => volume(&mut input, &patience),
        _ => dcr(&mut input, &patience),
    }
});

/// Memory of a size that is no multiple of anything, so that a sanitizer sees a read beyond it.
struct Struct {
    start: *mut u8,
    layout: Layout,
}

impl Struct {
    fn new(size: usize) -> Self {
        let layout = Layout::from_size_align(size, 8).expect("a small size");
        // SAFETY: the size is not 0.
        let start = unsafe { alloc_zeroed(layout) };
        if start.is_null() { handle_alloc_error(layout) } else { Self { start, layout } }
    }

    fn bytes(&mut self) -> &mut [u8] {
        // SAFETY: the memory is this struct's, of this size.
        unsafe { std::slice::from_raw_parts_mut(self.start, self.layout.size()) }
    }

    /// Puts a field where it is, if it is there as a whole.
    fn put<T>(&mut self, offset: usize, field: T) -> bool {
        let fits = offset + size_of::<T>() <= self.layout.size();
        if fits {
            // SAFETY: inside the memory.
            unsafe { self.start.add(offset).cast::<T>().write_unaligned(field) };
        }
        fits
    }
}

impl Drop for Struct {
    fn drop(&mut self) {
        // SAFETY: made by `new`.
        unsafe { dealloc(self.start, self.layout) };
    }
}

/// A struct of a size around that of `T`, first with the defaults, then with the input's bytes in some places.
fn hostile<T>(input: &mut Input, init: unsafe extern "C" fn(*mut T, usize) -> azulejo_status) -> Struct {
    let size =
        if input.one_in(16) { input.below(5000) } else { input.below(2 * size_of::<T>() as u32) }.max(4) as usize;
    let mut memory = Struct::new(size);
    // SAFETY: the memory is of this size.
    if unsafe { init(memory.start.cast(), size) } != AZULEJO_OK {
        memory.put(0, size as u32);
    }
    for _ in 0..input.below(8) {
        let at = 8 + input.below(size as u32) as usize;
        match input.below(3) {
            0 => memory.bytes().iter_mut().skip(at - 4).take(1).for_each(|byte| *byte = input.any()),
            1 => _ = memory.put(at & !7, input.number()),
            _ => _ = memory.put(at & !3, input.any::<u32>() % 4),
        }
    }
    memory
}

/// Puts the callback in its place; without one a call would work for long.
macro_rules! watched {
    ($memory:ident, $type:ident, $patience:ident) => {
        $memory
            .put(std::mem::offset_of!($type, progress), Some(Patience::tell as unsafe extern "C-unwind" fn(_, _) -> _))
            && $memory.put(std::mem::offset_of!($type, progress_user), $patience.user())
    };
}

/// Puts up to two given samples in their place. Pointers and counts are the caller's word, which has to be true.
macro_rules! put_given {
    ($memory:ident, $type:ident, $positions:ident, $clearances:ident, $input:ident) => {
        let clearances = if $input.one_in(2) { $clearances.as_ptr() } else { std::ptr::null() };
        $memory.put(std::mem::offset_of!($type, given_positions), $positions.as_ptr());
        $memory.put(std::mem::offset_of!($type, given_clearances), clearances);
        $memory.put(std::mem::offset_of!($type, given_count), $input.below(3) as usize);
    };
}

/// Calls with a struct that has no place for a callback are made with what is refused anyway, or is quick.
fn quick(memory: &mut Struct, radius: usize) {
    memory.put(radius, 0.3f64);
    memory.put(16, [0.0f64, 0.0, 1.0, 1.0]);
}

fn kdrt(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_kdrt_options_init);
    if !watched!(memory, azulejo_kdrt_options, patience) {
        quick(&mut memory, std::mem::offset_of!(azulejo_kdrt_options, radius));
    }
    let given = [0.2f32, 0.1, 0.7, 0.1];
    let clearances = [0.1f64, 0.3];
    put_given!(memory, azulejo_kdrt_options, given, clearances, input);
    let options = memory.start.cast();
    let corners = [[0.25, 0.25], [0.5f64, 0.5]];
    // SAFETY: the options have the size in their `struct_size`.
    unsafe {
        create(|out| azulejo_kdrt_sample(context(), options, out, null_mut()));
        patience.again(0);
        create(|out| {
            azulejo_kdrt_sample_window(
                context(),
                options,
                corners[0].as_ptr(),
                corners[1].as_ptr(),
                out,
                std::ptr::null_mut(),
            )
        });
        patience.again(0);
        accepted(azulejo_kdrt_stream(context(), options, None, null_mut(), std::ptr::null_mut()));
        let mut visitor = Visitor::default();
        patience.again(if input.one_in(2) { PATIENCE } else { 0 });
        if accepted(azulejo_kdrt_stream(
            context(),
            options,
            Some(visit),
            (&raw mut visitor).cast(),
            std::ptr::null_mut(),
        )) {
            patience.again(u32::MAX);
            let set = create(|out| azulejo_kdrt_sample(context(), options, out, null_mut()));
            let set = set.expect("what is streamed can be sampled");
            assert_eq!(Arrays::of(&set).positions, visitor.xy, "the parts are not the set");
        }
    }
}

/// Reports of progress that a stream is let go on for: its visitor ends it before, unless it is small.
const PATIENCE: u32 = 1000;
/// The coordinates that a visitor takes.
const MOST: usize = 4000;

/// The receiver of the parts of a set.
#[derive(Default)]
struct Visitor {
    xy: Vec<f32>,
}

unsafe extern "C-unwind" fn visit(user: *mut c_void, positions: *const f32, count: usize) -> u32 {
    assert!(count > 0, "a part without samples");
    // SAFETY: the call above leads here with its visitor, and the header says how long the array is.
    let (visitor, part) = unsafe { (&mut *user.cast::<Visitor>(), array(positions, 2 * count)) };
    visitor.xy.extend(part);
    u32::from(visitor.xy.len() > MOST)
}

fn maximal(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_maximal_options_init);
    if !watched!(memory, azulejo_maximal_options, patience) {
        quick(&mut memory, std::mem::offset_of!(azulejo_maximal_options, radius));
    }
    // SAFETY: the options have the size in their `struct_size`.
    create(|out| unsafe { azulejo_maximal_sample(context(), memory.start.cast(), out, std::ptr::null_mut()) });
}

fn volume(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_volume_options_init);
    if !watched!(memory, azulejo_volume_options, patience) {
        quick(&mut memory, std::mem::offset_of!(azulejo_volume_options, radius));
    }
    let (given, clearances) = ([0.2f32, 0.1, 0.0, 0.7, 0.1, 0.2], [0.1f64, 0.3]);
    put_given!(memory, azulejo_volume_options, given, clearances, input);
    // SAFETY: the options have the size in their `struct_size`.
    create(|out| unsafe { azulejo_volume_sample(context(), memory.start.cast(), out, std::ptr::null_mut()) });
}

fn merge(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_kdrt_merge_options_init);
    if !watched!(memory, azulejo_kdrt_merge_options, patience) {
        quick(&mut memory, std::mem::offset_of!(azulejo_kdrt_merge_options, radius));
    }
    let xy = [0.5f32, 0.5];
    let piece = azulejo_kdrt_merge_piece { positions: xy.as_ptr(), count: 1, min: [0.0; 2], max: [1.0; 2] };
    let null = std::ptr::null();
    // SAFETY: the options have the size in their `struct_size`, the piece has one sample.
    create(|out| unsafe {
        azulejo_kdrt_merge(
            context(),
            memory.start.cast(),
            &piece,
            1,
            size_of::<azulejo_kdrt_merge_piece>(),
            null,
            0,
            out,
            null_mut(),
        )
    });
}

fn triangle() -> Owned<azulejo_mesh> {
    let (corners, indices) = ([0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], [0u32, 1, 2]);
    // SAFETY: three vertices, one triangle.
    create(|out| unsafe { azulejo_mesh_create(corners.as_ptr(), 3, 12, indices.as_ptr(), 1, out) }).expect("a triangle")
}

fn psp(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_psp_options_init);
    if !watched!(memory, azulejo_psp_options, patience) {
        memory.put(std::mem::offset_of!(azulejo_psp_options, radius), 0.3f64);
        memory.put(std::mem::offset_of!(azulejo_psp_options, iterations), 2u32);
    }
    let given = [0.2f32, 0.1, 0.0, 0.7, 0.1, 0.2];
    let clearances = [0.1f64, 0.3];
    put_given!(memory, azulejo_psp_options, given, clearances, input);
    let (mesh, options) = (triangle(), memory.start.cast());
    // SAFETY: the options have the size in their `struct_size`.
    unsafe {
        create(|out| azulejo_psp_create(context(), mesh.get(), options, out));
        create(|out| azulejo_psp_sample(context(), mesh.get(), options, out, null_mut()));
    }
}

fn adaptive(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_psp_adaptive_options_init);
    let radii = [0.2f32, 0.3, 0.4];
    let count = if input.one_in(8) { input.below(3) as usize } else { 3 };
    let by_vertex = input.one_in(2);
    // The pointers and the count are the caller's word, which has to be true.
    memory.put(
        std::mem::offset_of!(azulejo_psp_adaptive_options, vertex_radii),
        if by_vertex { radii.as_ptr() } else { std::ptr::null() },
    );
    memory.put(std::mem::offset_of!(azulejo_psp_adaptive_options, vertex_count), count);
    memory.put(
        std::mem::offset_of!(azulejo_psp_adaptive_options, radius_function),
        (!by_vertex).then_some(constant as unsafe extern "C-unwind" fn(_, _) -> _),
    );
    if !watched!(memory, azulejo_psp_adaptive_options, patience) {
        memory.put(std::mem::offset_of!(azulejo_psp_adaptive_options, slope), 0.0f64);
    }
    let given = [0.2f32, 0.1, 0.0, 0.7, 0.1, 0.2];
    let clearances = [0.1f64, 0.3];
    put_given!(memory, azulejo_psp_adaptive_options, given, clearances, input);
    let mesh = triangle();
    // SAFETY: the options have the size in their `struct_size`.
    create(|out| unsafe { azulejo_psp_adaptive_sample(context(), mesh.get(), memory.start.cast(), out, null_mut()) });
}

unsafe extern "C-unwind" fn constant(_: *mut std::ffi::c_void, _: *const f64) -> f64 {
    0.25
}

fn dcr(input: &mut Input, patience: &Patience) {
    let mut memory = hostile(input, azulejo_dcr_options_init);
    if !watched!(memory, azulejo_dcr_options, patience) {
        memory.put(std::mem::offset_of!(azulejo_dcr_options, max_iterations), 5u32);
    }
    let xy = [0.1f32, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.1];
    // SAFETY: the options have the size in their `struct_size`, and there are four points.
    create(|out| unsafe { azulejo_dcr_relax(context(), memory.start.cast(), xy.as_ptr(), 4, out, null_mut()) });
}
