//! All calls on a mesh, whatever its triangles: both engines, in steps, with radii that vary.

use std::ptr::null_mut;

use azulejo_c::classes::azulejo_classes;
use azulejo_c::mesh::*;
use azulejo_c::order::{AZULEJO_ORDER_ANY, AZULEJO_ORDER_PROGRESSIVE};
use azulejo_c::points::{azulejo_points, azulejo_points_classes, azulejo_points_count};
use azulejo_c::psp::*;
use azulejo_c::psp_classes::*;
use azulejo_c::psp_report::azulejo_psp_report_init;

use crate::calls::{Arrays, Out, Owned, Patience, accepted, array, check_distances, context, create, report};
use crate::coverage::{Ball, Field, uncovered};
use crate::input::Input;
use crate::surface_relaxation::relax;
use crate::varying::adaptive;

/// About how many samples a set has at most.
const SAMPLES: f64 = 100.0;

/// Corners of the mesh in `f64`.
pub(crate) struct Corners(pub Vec<[[f64; 3]; 3]>);

impl Corners {
    pub(crate) fn of(mesh: &Owned<azulejo_mesh>) -> Self {
        let (positions, triangles) = {
            // SAFETY: the header says how long the arrays are; the mesh is borrowed.
            unsafe {
                (
                    array(mesh.read(azulejo_mesh_positions), 3 * mesh.read(azulejo_mesh_vertex_count)),
                    array(mesh.read(azulejo_mesh_indices), 3 * mesh.read(azulejo_mesh_triangle_count)),
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

    pub(crate) fn largest_coordinate(&self) -> f64 {
        self.0.iter().flatten().flatten().fold(0.0, |largest, x| x.abs().max(largest))
    }

    /// That of the box around all of them.
    pub(crate) fn diagonal(&self) -> f64 {
        let side = |axis: usize| {
            let along = || self.0.iter().flatten().map(|corner| corner[axis]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        (side(0).powi(2) + side(1).powi(2) + side(2).powi(2)).sqrt()
    }

    /// The point of barycentrics of a triangle.
    pub fn place(&self, triangle: u32, barycentrics: [f32; 2]) -> [f32; 3] {
        let [a, b, c] = self.0[triangle as usize];
        let [u, v] = barycentrics.map(f64::from);
        std::array::from_fn(|axis| ((1.0 - u - v) * a[axis] + u * b[axis] + v * c[axis]) as f32)
    }

    /// Samples lie on their triangles, where their barycentrics say.
    pub(crate) fn check(&self, set: &Arrays) {
        assert_eq!(set.positions.len(), 3 * set.triangles.len());
        for (i, &triangle) in set.triangles.iter().enumerate() {
            let at = [set.barycentrics[2 * i], set.barycentrics[2 * i + 1]];
            let [u, v] = at.map(f64::from);
            assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0, "sample {i}: barycentrics {u} {v}");
            assert_eq!(set.positions[3 * i..3 * i + 3], self.place(triangle, at), "sample {i}");
            let length: f32 = set.normals[3 * i..3 * i + 3].iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-3, "sample {i}: a normal of squared length {length}");
            assert!(set.interpolated.iter().all(|x| x.is_finite()));
        }
    }
}

/// The options of the calls on a mesh.
struct Request {
    corners: Corners,
    radius: f64,
    patience: Box<Patience>,
    given: Given,
    options: azulejo_psp_options,
}

impl Request {
    /// A radius that gives few samples, around some that are given. None if there would be too many for the time that a
    /// fuzz target has.
    fn any(mesh: &Owned<azulejo_mesh>, input: &mut Input) -> Option<Self> {
        let corners = Corners::of(mesh);
        let samples = 1.0 + f64::from(input.any::<u8>() / 2);
        let area = mesh.read(azulejo_mesh_area);
        let radius = (area / samples).sqrt().max(corners.length() / SAMPLES);
        let radius = if input.one_in(16) { input.number() } else { radius };
        if area / (radius * radius) + corners.length() / radius > 10.0 * SAMPLES {
            return None;
        }
        let patience = Box::new(Patience::new(u32::MAX));
        let given = Given::any(&corners, radius, input);
        let options = azulejo_psp_options {
            struct_size: size_of::<azulejo_psp_options>() as u32,
            iterations: input.below(3),
            radius,
            seed: input.any(),
            maximal: u32::from(!input.one_in(4)),
            priority: u32::from(input.one_in(4)),
            engine: input.below(3),
            order: AZULEJO_ORDER_ANY,
            progress: Some(Patience::tell),
            progress_user: patience.user(),
            count: 0,
            quotient: 0.0,
            given_positions: given.positions.as_ptr().cast(),
            given_clearances: given.clearances.as_ref().map_or(std::ptr::null(), |clearances| clearances.as_ptr()),
            given_count: given.positions.len(),
            cosine: if input.one_in(8) { input.number() } else { -1.0 },
            projectors: u32::from(input.one_in(2)),
            reserved: 0,
        };
        Some(Self { corners, radius, patience, given, options })
    }
}

/// Samples a mesh at once, in steps, and with radii that vary, and relaxes what comes out.
pub fn sample(mesh: &Owned<azulejo_mesh>, input: &mut Input) {
    let Some(Request { corners, radius, patience, given, options }) = Request::any(mesh, input) else { return };
    at_once(mesh, &corners, &options, &given);
    in_steps(mesh, &corners, &options, &given, &patience, input);
    adaptive(mesh, &corners, radius, &given, input);
    relax(mesh, &corners, input);
}

/// Samples a mesh by density, in progressive order, or with several classes.
pub fn sample_kinds(mesh: &Owned<azulejo_mesh>, input: &mut Input) {
    let Some(Request { corners, radius, given, options, .. }) = &Request::any(mesh, input) else { return };
    match input.below(3) {
        0 => crate::mesh_density::sample(mesh, corners, *radius, input),
        1 => ordered(mesh, corners, options, given, input),
        _ => of_classes(mesh, corners, options, input),
    }
}

/// Samples that are given.
pub(crate) struct Given {
    pub positions: Vec<[f32; 3]>,
    /// NULL to the call, where there are none.
    pub clearances: Option<Vec<f64>>,
}

impl Given {
    /// At corners of the mesh, near them, anywhere; with clearances about the radius, or anything.
    fn any(corners: &Corners, radius: f64, input: &mut Input) -> Self {
        let count = if input.one_in(2) { 0 } else { input.below(20) };
        let hostile = input.one_in(16);
        let position = |input: &mut Input| -> [f32; 3] {
            if hostile || corners.0.is_empty() {
                return std::array::from_fn(|_| input.coordinate());
            }
            let corner = corners.0[input.below(corners.0.len() as u32) as usize][0];
            let near = |x: f64, input: &mut Input| x + radius * f64::from(input.any::<i8>()) / 64.0;
            corner.map(|x| if input.one_in(2) { x } else { near(x, input) } as f32)
        };
        let positions: Vec<_> = (0..count).map(|_| position(input)).collect();
        let clearance = |input: &mut Input| match input.below(8) {
            0 if hostile => input.number(),
            kind => radius * 10f64.powi(2 - kind as i32),
        };
        let clearances = (!input.one_in(4)).then(|| (0..count).map(|_| clearance(input)).collect());
        Self { positions, clearances }
    }

    /// Each sample keeps the clearance of each.
    pub(crate) fn check(&self, points: &Owned<azulejo_points>, radius: f64) {
        let (positions, _) = Arrays::of(points).positions.as_chunks::<3>();
        for (i, given) in self.positions.iter().enumerate() {
            let clearance = self.clearances.as_ref().map_or(radius, |clearances| clearances[i]);
            for (sample, position) in positions.iter().enumerate() {
                let squared: f64 =
                    (0..3).map(|axis| (f64::from(position[axis]) - f64::from(given[axis])).powi(2)).sum();
                assert!(squared.sqrt() >= clearance, "sample {sample} is too close to given {i}");
            }
        }
    }
}

fn check_uniform(corners: &Corners, points: &Owned<azulejo_points>, radius: f64) {
    let set = Arrays::of(points);
    corners.check(&set);
    let (positions, _) = set.positions.as_chunks::<3>();
    check_distances(positions, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), |_, _| radius);
}

fn at_once(mesh: &Owned<azulejo_mesh>, corners: &Corners, options: &azulejo_psp_options, given: &Given) {
    let mut report = report(azulejo_psp_report_init);
    // SAFETY: the structs have the sizes in their `struct_size`.
    let call = |out: Out<_>| unsafe { azulejo_psp_sample(context(), mesh.get(), options, out, &raw mut report) };
    let Some(points) = create(call) else { return };
    assert_eq!(report.samples, points.read(azulejo_points_count) as u64);
    given.check(&points, options.radius);
    if options.cosine == -1.0 {
        check_uniform(corners, &points, options.radius);
    }
    if options.maximal == 1 {
        check_covered(mesh, corners, &points, report.covering_radius, given, options.radius);
    }
}

/// No place of the mesh is farther from the samples than a distance, unless what is given covers it.
fn check_covered(
    mesh: &Owned<azulejo_mesh>,
    corners: &Corners,
    points: &Owned<azulejo_points>,
    covering_radius: f64,
    given: &Given,
    radius: f64,
) {
    let samples = Ball::of_positions(Arrays::of(points).positions.as_chunks::<3>().0, |_| covering_radius);
    let balls = [samples, Ball::of_given(given, radius)].concat();
    assert_eq!(uncovered(mesh, corners, &Field::None, &balls, |_| true), None, "within {covering_radius}");
}

/// Sets of exact counts, and in progressive order.
fn ordered(
    mesh: &Owned<azulejo_mesh>,
    corners: &Corners,
    options: &azulejo_psp_options,
    given: &Given,
    input: &mut Input,
) {
    let count = if input.one_in(2) { input.below(60) as usize } else { 0 };
    let is_progressive = count == 0 || input.one_in(2);
    let options = &azulejo_psp_options {
        iterations: AZULEJO_ITERATIONS_DEFAULT,
        maximal: 1,
        radius: if count > 0 { 0.0 } else { options.radius },
        order: if is_progressive { AZULEJO_ORDER_PROGRESSIVE } else { AZULEJO_ORDER_ANY },
        count,
        ..*options
    };
    let mut report = report(azulejo_psp_report_init);
    // SAFETY: the structs have the sizes in their `struct_size`.
    let call = |out: Out<_>| unsafe { azulejo_psp_sample(context(), mesh.get(), options, out, &raw mut report) };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    corners.check(&set);
    assert!(count == 0 || set.triangles.len() == count);
    assert!(report.covering_radius >= report.radius, "{} {}", report.covering_radius, report.radius);
    check_covered(mesh, corners, &points, report.covering_radius, given, report.radius);
    if options.cosine == -1.0 {
        let (positions, _) = set.positions.as_chunks::<3>();
        check_distances(positions, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), |_, _| report.radius);
    }
}

/// Sets of several classes, with any matrix and masks.
fn of_classes(mesh: &Owned<azulejo_mesh>, corners: &Corners, options: &azulejo_psp_options, input: &mut Input) {
    let count = 1 + input.below(4) as usize;
    let mut radii = vec![0.0; count * count];
    for i in 0..count {
        for j in 0..=i {
            let share = [1.0, 0.7, 2.0, 0.0, 0.3][input.below(5) as usize];
            let radius = options.radius * if i == j { f64::max(share, 0.6) } else { share };
            (radii[i * count + j], radii[j * count + i]) = (radius, radius);
        }
    }
    let masks: Vec<u32> = match input.one_in(2) {
        true => (0..corners.0.len()).map(|_| input.any()).collect(),
        false => Vec::new(),
    };
    let classes = azulejo_classes {
        struct_size: size_of::<azulejo_classes>() as u32,
        count: count as u32,
        radii: radii.as_ptr(),
        masks: if masks.is_empty() { std::ptr::null() } else { masks.as_ptr() },
        mask_count: masks.len(),
    };
    let options = &azulejo_psp_options {
        iterations: AZULEJO_ITERATIONS_DEFAULT,
        maximal: 1,
        radius: 0.0,
        priority: AZULEJO_PRIORITY_SQUARENESS,
        engine: AZULEJO_ENGINE_AUTO,
        projectors: AZULEJO_PROJECTORS_LOCAL,
        given_positions: std::ptr::null(),
        given_clearances: std::ptr::null(),
        given_count: 0,
        ..*options
    };
    // SAFETY: the structs have the sizes in their `struct_size`, and the arrays as long.
    let call = |out: Out<_>| unsafe {
        azulejo_psp_sample_classes(context(), mesh.get(), options, &classes, out, std::ptr::null_mut())
    };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    corners.check(&set);
    let start = points.read(azulejo_points_classes);
    // SAFETY: there is one for each sample.
    let class: Vec<usize> = (0..set.triangles.len()).map(|i| unsafe { start.add(i).read() } as usize).collect();
    let may_stand = |i: usize| masks.get(set.triangles[i] as usize).is_none_or(|mask| mask >> class[i] & 1 == 1);
    assert!(class.is_sorted() && (0..class.len()).all(may_stand));
    if options.cosine == -1.0 {
        let (positions, _) = set.positions.as_chunks::<3>();
        let difference = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|axis| a[axis] - b[axis]);
        check_distances(positions, difference, |i, j| radii[class[i] * count + class[j]]);
    }
    for own in 0..count {
        let (positions, _) = set.positions.as_chunks::<3>();
        let balls = Ball::of_positions(positions, |i| radii[class[i] * count + own]);
        let is_asked = |triangle: usize| masks.get(triangle).is_none_or(|mask| mask >> own & 1 == 1);
        let gap = uncovered(mesh, corners, &Field::None, &balls, is_asked);
        assert_eq!(gap, None, "another sample of class {own} fits");
    }
}

fn in_steps(
    mesh: &Owned<azulejo_mesh>,
    corners: &Corners,
    options: &azulejo_psp_options,
    given: &Given,
    patience: &Patience,
    input: &mut Input,
) {
    let options = &azulejo_psp_options { iterations: 1, maximal: 1, cosine: -1.0, ..*options };
    // SAFETY: the options have the size in their `struct_size`.
    let create_set = |out: Out<_>| unsafe { azulejo_psp_create(context(), mesh.get(), options, out) };
    let Some(set) = create(create_set) else { return };
    let mut is_filled = false;
    for _ in 0..input.below(4) {
        let left = if input.one_in(2) { input.below(20) } else { u32::MAX };
        patience.again(left);
        let handle = set.get();
        let fills = input.one_in(2);
        // SAFETY: the handle is alive; nobody else uses it.
        let status = unsafe {
            if fills { azulejo_psp_fill(handle, null_mut()) } else { azulejo_psp_advance(handle, 1, null_mut()) }
        };
        is_filled |= accepted(status) && fills;
    }
    // SAFETY: the handle lives.
    let points = create(|out: Out<_>| unsafe { azulejo_psp_points(set.get(), out) }).expect("the set is not in use");
    check_uniform(corners, &points, options.radius);
    if is_filled {
        check_covered(mesh, corners, &points, options.radius, given, options.radius);
    }
}
