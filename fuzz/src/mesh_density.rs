//! Densities on a mesh: by its vertices, by a function, by an image.

use std::cell::Cell;
use std::ffi::c_void;
use std::ptr::{null, null_mut};

use azulejo_c::adaptive::azulejo_psp_adaptive_options;
use azulejo_c::mesh::*;
use azulejo_c::mesh_density::*;

use crate::calls::{Arrays, Out, Owned, check_distances, context, create};
use crate::coverage::{Ball, Field, uncovered};
use crate::input::Input;
use crate::surface::Corners;

/// Gives densities up to 1, some of them wrong.
struct Guest {
    slope: f64,
    /// Nothing is below this: it takes too long to be refused where a function with a slope is 0 far around.
    least: Cell<f64>,
    kind: u32,
    calls: Cell<u32>,
}

impl Guest {
    fn at(&self, [x, y, _]: [f64; 3]) -> f64 {
        let calls = self.calls.replace(self.calls.get().wrapping_add(1));
        match self.kind {
            0 => (x * 4.0 * self.slope).abs().max(self.least.get()),
            1 if calls.is_multiple_of(7) => [f64::NAN, -1.0, 2.0, f64::INFINITY][calls as usize / 7 % 4],
            2 => f64::from(x > y).max(self.least.get()),
            _ => (x * self.slope).clamp(self.least.get(), 1.0),
        }
    }
}

unsafe extern "C-unwind" fn density_at(user: *mut c_void, position: *const f64) -> f64 {
    // SAFETY: the struct below leads here with these two.
    unsafe { (*user.cast::<Guest>()).at(*position.cast()) }
}

/// Samples a mesh with a density of at most 1, for which there are few samples of this radius.
pub(crate) fn sample(mesh: &Owned<azulejo_mesh>, corners: &Corners, radius: f64, input: &mut Input) {
    // Radii are limited where densities fall far; where they do not, it is known what every place has.
    let falls_far = !input.one_in(4);
    let value = |input: &mut Input| match input.below(64) {
        0 if falls_far => input.coordinate().min(1.0),
        1..20 if falls_far => 0.0,
        _ if falls_far => f32::from(input.any::<u8>()) / 255.0,
        _ => 0.25 + f32::from(input.any::<u8>()) / 340.0,
    };
    let (vertices, triangles) = (mesh.read(azulejo_mesh_vertex_count), mesh.read(azulejo_mesh_triangle_count));
    let values: Vec<f32> = (0..vertices).map(|_| value(input)).collect();
    let (width, height) = (input.below(5) as usize, input.below(5) as usize);
    let pixels: Vec<f32> = (0..width * height).map(|_| value(input)).collect();
    let by_corners = input.one_in(2);
    let count = if by_corners { 3 * triangles } else { vertices };
    let place =
        |input: &mut Input| if input.one_in(64) { input.coordinate() } else { f32::from(input.any::<u8>()) / 64.0 };
    let texture: Vec<[f32; 2]> = (0..count).map(|_| [place(input), place(input)]).collect();
    let guest = Guest {
        slope: f64::from(input.any::<u8>()) / 256.0,
        kind: input.below(6),
        least: Cell::new(0.0),
        calls: Cell::new(0),
    };
    let function: azulejo_mesh_density_fn = Some(density_at);
    let mut density = azulejo_mesh_density {
        struct_size: size_of::<azulejo_mesh_density>() as u32,
        at_vertices: 0,
        vertex_values: null(),
        vertex_count: 0,
        function: None,
        function_user: (&raw const guest).cast_mut().cast(),
        largest: 0.0,
        slope: 0.0,
        image: null(),
        width: 0,
        height: 0,
        texture: null(),
        texture_count: 0,
        by_corners: 0,
        reserved: 0,
        radius,
        count: 0.0,
    };
    match input.below(4) {
        0 => (density.vertex_values, density.vertex_count) = (values.as_ptr(), vertices),
        1 => (density.function, density.at_vertices) = (function, 1),
        2 => {
            (density.function, density.largest, density.slope) = (function, 1.0, guest.slope);
            guest.least.set(0.05);
        }
        _ => {
            (density.image, density.width, density.height) = (pixels.as_ptr(), width, height);
            (density.texture, density.texture_count) = (texture.as_ptr().cast(), count);
            density.by_corners = by_corners.into();
        }
    }
    if input.one_in(8) {
        (density.radius, density.count) = (0.0, f64::from(input.below(100)));
    }
    // SAFETY: the fields of the options are pointers, numbers and `None`, for all of which zeros are good.
    let mut options: azulejo_psp_adaptive_options = unsafe { std::mem::zeroed() };
    // SAFETY: the struct has the size that is said.
    let _ = unsafe { azulejo_c::adaptive::azulejo_psp_adaptive_options_init(&raw mut options, size_of_val(&options)) };
    options.seed = input.any();
    // SAFETY: the structs have the sizes in their `struct_size`, and the arrays as long.
    let call = |out: Out<_>| unsafe {
        azulejo_psp_adaptive_with_density(context(), mesh.get(), &options, &density, out, null_mut())
    };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    corners.check(&set);
    let (positions, _) = set.positions.as_chunks::<3>();
    let mean = |i: usize, j: usize| (set.radii[i] + set.radii[j]) / 2.0;
    check_distances(positions, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), mean);
    if !falls_far && density.vertex_count > 0 && density.radius > 0.0 && density.radius < corners.diagonal() {
        // The radius at a density is that at 1 over its root.
        let at_vertices: Vec<_> = values.iter().map(|&value| f64::from(value) / density.radius.powi(2)).collect();
        let field = Field::AtVertices { values: &at_vertices, radius: |value| 1.0 / value.sqrt() };
        assert_eq!(uncovered(mesh, corners, &field, &Ball::of_samples(&set), |_| true), None);
    }
}
