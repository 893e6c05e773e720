//! What is done with every mesh, whatever it was made of: sampled by both engines, in steps, with radii that vary.

use std::cell::Cell;
use std::ffi::c_void;
use std::ptr::{NonNull, null_mut};

use azulejo_c::adaptive::*;
use azulejo_c::analysis::azulejo_mesh_uncovered_fraction;
use azulejo_c::mesh::*;
use azulejo_c::points::{azulejo_points, azulejo_points_count};
use azulejo_c::psp::*;
use azulejo_c::psp_report::azulejo_psp_report_init;
use azulejo_c::surface::*;

use crate::calls::{Arrays, Out, Patience, accepted, array, check_distances, context, create, report, value};
use crate::input::Input;

/// About how many samples a set has at most.
const SAMPLES: f64 = 100.0;

/// Corners of the mesh in `f64`.
struct Corners(Vec<[[f64; 3]; 3]>);

impl Corners {
    fn of(mesh: &azulejo_mesh) -> Self {
        let (positions, triangles) = {
            let mesh = Some(mesh);
            // SAFETY: the header says how long the arrays are; the mesh is borrowed.
            unsafe {
                (
                    array(azulejo_mesh_positions(mesh), 3 * azulejo_mesh_vertex_count(mesh)),
                    array(azulejo_mesh_indices(mesh), 3 * azulejo_mesh_triangle_count(mesh)),
                )
            }
        };
        let corner = |&vertex: &u32| std::array::from_fn(|axis| positions[3 * vertex as usize + axis].into());
        Self(triangles.chunks(3).map(|triangle| std::array::from_fn(|i| corner(&triangle[i]))).collect())
    }

    /// Halves of all circumferences together.
    fn length(&self) -> f64 {
        let edge = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
        self.0.iter().map(|[a, b, c]| (edge(*a, *b) + edge(*b, *c) + edge(*c, *a)) / 2.0).sum()
    }

    fn largest_coordinate(&self) -> f64 {
        self.0.iter().flatten().flatten().fold(0.0, |largest, x| x.abs().max(largest))
    }

    /// Samples lie on their triangles, where their barycentrics say.
    fn check(&self, set: &Arrays) {
        assert_eq!(set.positions.len(), 3 * set.triangles.len());
        for (i, &triangle) in set.triangles.iter().enumerate() {
            let [a, b, c] = self.0[triangle as usize];
            let [u, v] = [set.barycentrics[2 * i], set.barycentrics[2 * i + 1]].map(f64::from);
            assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0, "sample {i}: barycentrics {u} {v}");
            for axis in 0..3 {
                let x = (1.0 - u - v) * a[axis] + u * b[axis] + v * c[axis];
                assert_eq!(set.positions[3 * i + axis], x as f32, "sample {i}, axis {axis}");
            }
            let length: f32 = set.normals[3 * i..3 * i + 3].iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-3, "sample {i}: a normal of squared length {length}");
            assert!(set.interpolated.iter().all(|x| x.is_finite()));
        }
    }
}

/// Samples a mesh by all calls, with a radius that gives few samples.
pub fn sample(mesh: &azulejo_mesh, input: &mut Input) {
    let corners = Corners::of(mesh);
    let samples = 1.0 + f64::from(input.any::<u8>() / 2);
    let area = azulejo_mesh_area(Some(mesh));
    let radius = (area / samples).sqrt().max(corners.length() / SAMPLES);
    let radius = if input.one_in(16) { input.number() } else { radius };
    if area / (radius * radius) + corners.length() / radius > 10.0 * SAMPLES {
        return; // refused or made, but not in the time that a fuzz target has
    }
    let patience = Patience::new(u32::MAX);
    let options = azulejo_psp_options {
        struct_size: size_of::<azulejo_psp_options>() as u32,
        iterations: input.below(3),
        radius,
        seed: input.any(),
        maximal: u32::from(!input.one_in(4)),
        priority: i32::from(input.one_in(4)),
        engine: i32::from(input.one_in(2)),
        reserved: 0,
        progress: Some(Patience::tell),
        progress_user: patience.user(),
    };
    at_once(mesh, &corners, &options);
    in_steps(mesh, &corners, &options, &patience, input);
    adaptive(mesh, &corners, radius, input);
    relax(mesh, &corners, input);
}

fn check_uniform(corners: &Corners, points: &azulejo_points, radius: f64) {
    let set = Arrays::of(points);
    corners.check(&set);
    let (positions, _) = set.positions.as_chunks::<3>();
    check_distances(positions, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), |_, _| radius);
}

fn at_once(mesh: &azulejo_mesh, corners: &Corners, options: &azulejo_psp_options) {
    let mut report = report(azulejo_psp_report_init);
    // SAFETY: the structs are of the sizes that they say.
    let call = |out: Out<_>| unsafe { azulejo_psp_sample(context(), Some(mesh), options, out, &raw mut report) };
    let Some(points) = create(call) else { return };
    assert_eq!(report.samples, azulejo_points_count(Some(&points)) as u64);
    check_uniform(corners, &points, options.radius);
    if options.maximal == 1 {
        check_covered(mesh, corners, &points, options);
    }
}

/// A maximal set leaves no probe uncovered, up to six float spacings.
fn check_covered(mesh: &azulejo_mesh, corners: &Corners, points: &azulejo_points, options: &azulejo_psp_options) {
    let radius = options.radius + 6.0 * corners.largest_coordinate() * f64::from(f32::EPSILON);
    let (positions, _) = Arrays::of(points).positions.as_chunks::<3>();
    let (start, count) = (positions.as_ptr().cast(), positions.len());
    // SAFETY: the array is as long as that.
    let fraction = value(|out| unsafe {
        azulejo_mesh_uncovered_fraction(context(), Some(mesh), start, count, radius, 200, options.seed, out)
    });
    assert_eq!(fraction, Some(0.0));
}

fn in_steps(
    mesh: &azulejo_mesh,
    corners: &Corners,
    options: &azulejo_psp_options,
    patience: &Patience,
    input: &mut Input,
) {
    let options = &azulejo_psp_options { iterations: 1, maximal: 1, ..*options };
    // SAFETY: the options are of the size that they say.
    let create_set = |out: Out<_>| unsafe { azulejo_psp_create(context(), Some(mesh), options, out) };
    let Some(mut set) = create(create_set) else { return };
    for _ in 0..input.below(4) {
        let left = if input.one_in(2) { input.below(20) } else { u32::MAX };
        patience.again(left);
        let handle = Some(NonNull::from(&mut *set));
        // SAFETY: the handle is alive; nobody else uses it.
        let status = unsafe {
            if input.one_in(2) {
                azulejo_psp_fill(handle, null_mut())
            } else {
                azulejo_psp_advance(handle, 1, null_mut())
            }
        };
        accepted(status);
    }
    let points = create(|out| azulejo_psp_points(Some(&set), out)).expect("the set is not in use");
    check_uniform(corners, &points, options.radius);
    azulejo_psp_free(Some(set));
}

/// A function of the caller's: one that is as the options say, or not.
struct Guest {
    least: f64,
    slope: f64,
    kind: u32,
    calls: Cell<u32>,
}

impl Guest {
    fn at(&self, position: [f64; 3]) -> f64 {
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

unsafe extern "C-unwind" fn radius_at(user: *mut c_void, position: *const f64) -> f64 {
    // SAFETY: the options below lead here with these two.
    unsafe { (*user.cast::<Guest>()).at(*position.cast()) }
}

fn adaptive(mesh: &azulejo_mesh, corners: &Corners, radius: f64, input: &mut Input) {
    let radii: Vec<f32> =
        (0..azulejo_mesh_vertex_count(Some(mesh)))
            .map(|_| {
                if input.one_in(64) { input.coordinate() } else { radius as f32 * (1.0 + f32::from(input.any::<u8>())) }
            })
            .collect();
    if radii.iter().any(|&x| x > 0.0 && f64::from(x) < radius / 2.0) {
        return; // too many samples
    }
    let slope = f64::from(input.any::<u8>()) / 256.0;
    let guest = Guest { least: radius, slope, kind: input.below(10), calls: Cell::new(0) };
    let by_vertex = input.one_in(2);
    let options = azulejo_psp_adaptive_options {
        struct_size: size_of::<azulejo_psp_adaptive_options>() as u32,
        reserved: 0,
        vertex_radii: if by_vertex { radii.as_ptr() } else { std::ptr::null() },
        vertex_count: if by_vertex { radii.len() } else { 0 },
        radius: (!by_vertex).then_some(radius_at),
        radius_user: (&raw const guest).cast_mut().cast(),
        smallest: if by_vertex { 0.0 } else { radius },
        largest: if by_vertex { 0.0 } else { 2.0 * radius },
        slope: if by_vertex { 0.0 } else { slope },
        cosine: if input.one_in(4) { [1.0, input.number()][input.below(2) as usize] } else { -1.0 },
        seed: input.any(),
        progress: None,
        progress_user: std::ptr::null_mut(),
    };
    // SAFETY: the options are of the size that they say, and so is the array.
    let call = |out: Out<_>| unsafe { azulejo_psp_adaptive_sample(context(), Some(mesh), &options, out, null_mut()) };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    corners.check(&set);
    if options.cosine == -1.0 {
        let (positions, _) = set.positions.as_chunks::<3>();
        let mean = |i: usize, j: usize| (set.radii[i] + set.radii[j]) / 2.0;
        check_distances(positions, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), mean);
    }
}

/// Samples anywhere, some on edges and on each other, walk over the mesh.
fn relax(mesh: &azulejo_mesh, corners: &Corners, input: &mut Input) {
    let patience = Patience::new(if input.one_in(4) { input.below(20) } else { u32::MAX });
    let options = azulejo_dcr_surface_options {
        struct_size: size_of::<azulejo_dcr_surface_options>() as u32,
        max_iterations: input.below(12),
        tolerance: if input.one_in(8) { input.number() } else { -1.0 },
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
    };
    let count = input.below(40) as usize;
    let hostile = input.one_in(8);
    let triangles: Vec<u32> = (0..count)
        .map(|_| if hostile { input.any::<u8>().into() } else { input.below(corners.0.len().max(1) as u32) })
        .collect();
    let sides = |input: &mut Input| {
        let [u, v] = [0; 2].map(|_| f32::from(input.any::<u8>() / 15) / 17.0);
        if hostile {
            [input.coordinate(), v]
        } else if u + v > 1.0 {
            [1.0 - u, 1.0 - v]
        } else {
            [u, v]
        }
    };
    let barycentrics: Vec<[f32; 2]> = (0..count).map(|_| sides(input)).collect();
    let (start, uv) = (triangles.as_ptr(), barycentrics.as_ptr().cast());
    // SAFETY: the options are of the size that they say, and so are the arrays.
    let call = |out: Out<_>| unsafe {
        azulejo_dcr_surface_relax(context(), Some(mesh), &options, start, uv, count, out, null_mut())
    };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    assert_eq!(set.triangles.len(), count);
    corners.check(&set);
}
