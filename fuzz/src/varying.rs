//! Samples with radii that vary, by vertex or by a function.

use std::cell::Cell;
use std::ffi::c_void;
use std::ptr::null_mut;

use azulejo_c::adaptive::*;
use azulejo_c::mesh::*;
use azulejo_c::order::AZULEJO_ORDER_ANY;

use crate::calls::{Arrays, Out, Owned, check_distances, context, create};
use crate::coverage::{Ball, Field, uncovered};
use crate::input::Input;
use crate::surface::{Corners, Given};

/// A function of the caller's: one that is as the options say, or not.
pub struct Guest {
    least: f64,
    slope: f64,
    kind: u32,
    calls: Cell<u32>,
}

impl Guest {
    /// A function of some kind, from `least` to twice that.
    pub fn new(least: f64, slope: f64, input: &mut Input) -> Self {
        Self { least, slope, kind: input.below(10), calls: Cell::new(0) }
    }

    /// The slope that is told.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// The value of the option radius_function_user.
    pub fn user(&self) -> *mut c_void {
        (&raw const *self).cast_mut().cast()
    }

    /// True if it changes no faster than its slope.
    pub fn is_as_told(&self) -> bool {
        self.kind > 4
    }

    pub fn at(&self, position: [f64; 3]) -> f64 {
        let ramp = |slope: f64| self.least + (position[0].abs() * slope).min(self.least);
        let noise =
            position.iter().fold(0u64, |bits, x| (bits ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)) >> 32;
        let calls = self.calls.replace(self.calls.get().wrapping_add(1));
        match self.kind {
            0 => ramp(4.0),
            1 => self.least * (1.0 + noise as f64 / 2f64.powi(32)),
            2 => self.least * if calls.is_multiple_of(3) { 1.0 } else { 1.5 },
            3 => self.least * if calls < 2000 { 2.0 } else { 1.0 },
            4 if noise.is_multiple_of(64) => [f64::NAN, 0.0, -1.0, f64::INFINITY][noise as usize / 64 % 4],
            _ => ramp(self.slope).min(2.0 * self.least),
        }
    }
}

/// The radius function.
///
/// # Safety
/// `user` is that of a living [`Guest`], and `position` leads to three coordinates.
pub unsafe extern "C-unwind" fn radius_at(user: *mut c_void, position: *const f64) -> f64 {
    // SAFETY: by the contract.
    unsafe { (*user.cast::<Guest>()).at(*position.cast()) }
}

pub(crate) fn adaptive(mesh: &Owned<azulejo_mesh>, corners: &Corners, radius: f64, given: &Given, input: &mut Input) {
    let radii: Vec<f32> =
        (0..mesh.read(azulejo_mesh_vertex_count))
            .map(|_| {
                if input.one_in(64) { input.coordinate() } else { radius as f32 * (1.0 + f32::from(input.any::<u8>())) }
            })
            .collect();
    if radii.iter().any(|&x| x > 0.0 && f64::from(x) < radius / 2.0) {
        return; // too many samples
    }
    let slope = f64::from(input.any::<u8>()) / 256.0;
    let guest = Guest::new(radius, slope, input);
    let by_vertex = input.one_in(2);
    let options = azulejo_psp_adaptive_options {
        struct_size: size_of::<azulejo_psp_adaptive_options>() as u32,
        vertex_radii: if by_vertex { radii.as_ptr() } else { std::ptr::null() },
        vertex_count: if by_vertex { radii.len() } else { 0 },
        radius_function: (!by_vertex).then_some(radius_at),
        radius_function_user: guest.user(),
        smallest: if by_vertex { 0.0 } else { radius },
        largest: if by_vertex { 0.0 } else { 2.0 * radius },
        slope: if by_vertex { 0.0 } else { slope },
        cosine: if input.one_in(4) { [1.0, input.number()][input.below(2) as usize] } else { -1.0 },
        seed: input.any(),
        progress: None,
        progress_user: std::ptr::null_mut(),
        given_positions: given.positions.as_ptr().cast(),
        given_clearances: given.clearances.as_ref().map_or(std::ptr::null(), |clearances| clearances.as_ptr()),
        given_count: given.positions.len(),
        // Refused are other orders, and a quotient of no order.
        order: if input.one_in(4) { input.below(3) } else { AZULEJO_ORDER_ANY },
        quotient: if input.one_in(4) { [1.5, 1.3, input.number()][input.below(3) as usize] } else { 0.0 },
    };
    // SAFETY: the options have the size in their `struct_size`, and so is the array.
    let call = |out: Out<_>| unsafe { azulejo_psp_adaptive_sample(context(), mesh.get(), &options, out, null_mut()) };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    corners.check(&set);
    given.check(&points, f64::NAN);
    if options.cosine == -1.0 {
        let (positions, _) = set.positions.as_chunks::<3>();
        let mean = |i: usize, j: usize| (set.radii[i] + set.radii[j]) / 2.0;
        check_distances(positions, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), mean);
        let limit = 4.0 * corners.diagonal();
        let values: Vec<_> = radii.iter().map(|&radius| f64::from(radius).min(limit)).collect();
        let at = |place| guest.at(place).min(limit);
        let field = match by_vertex {
            true => Field::AtVertices { values: &values, radius: |radius| radius },
            false => Field::Function { at: &at, slope },
        };
        if by_vertex || guest.is_as_told() {
            let balls = [Ball::of_samples(&set), Ball::of_given(given, f64::NAN)].concat();
            assert_eq!(uncovered(mesh, corners, &field, &balls, |_| true), None);
        }
    }
}
