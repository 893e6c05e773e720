//! The analysis of the core, on points of all kinds.

#![no_main]

use azulejo_core::analysis::{bonds, coverage, differential, facing, spacing, spectrum, triangles};
use azulejo_core::mesh::Mesh;
use azulejo_core::{Boundary, Context, Domain};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let context = Context::new(1).expect("one thread");
    let min = [input.coordinate(), input.coordinate()].map(f64::from);
    let boundary = if input.one_in(2) { Boundary::Bounded } else { Boundary::Periodic };
    let domain = Domain { min, max: [min[0] + input.number(), min[1] + input.number()], boundary };
    plane(&context, &domain, &mut input);
    surface(&context, &mut input);
});

fn plane(context: &Context, domain: &Domain, input: &mut Input) {
    let mut points = input.rows::<2>(60);
    if !input.one_in(4) {
        points.retain(|point| (0..2).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&point[axis].into())));
    }
    let size = if input.one_in(16) { 10_000 } else { input.below(64) as usize };
    if let Ok(power) = spectrum::periodogram(context, domain, &points, size, None) {
        assert!(power.power().iter().all(|&power| power >= 0.0 && power.is_finite()));
    }
    if let Ok(statistics) = triangles::triangle_statistics(context, domain, &points, None) {
        assert!((0.0..=1.0).contains(&statistics.obtuse), "{statistics:?}");
    }
    if let Ok(order) = bonds::bond_order(context, domain, &points, None) {
        assert!((0.0..=1.000001).contains(&order), "{order}");
    }
    if let Ok(distances) = spacing::nearest_distances_2d(context, domain, &points, None) {
        assert_eq!(distances.len(), points.len());
        _ = coverage::covering_radius_2d(context, domain, &points, None)
            .expect("what has distances has a covering radius");
    }
    if let Ok(differences) = differential::plane_differences(context, domain, &points, None) {
        assert!(differences.density().iter().all(|&density| density >= 0.0));
    }
}

fn surface(context: &Context, input: &mut Input) {
    let (positions, indices) = (input.rows::<3>(20), 3 * input.below(20));
    let vertex = |input: &mut Input| u32::from(input.any::<u8>()) % positions.len().max(1) as u32;
    let indices: Vec<u32> = (0..indices).map(|_| vertex(input)).collect();
    let Ok(mesh) = Mesh::new(positions, indices.as_chunks::<3>().0.to_vec()) else { return };
    let points = input.rows::<3>(60);
    let normals: Vec<[f32; 3]> = points.iter().map(|_| std::array::from_fn(|_| input.coordinate())).collect();
    let direction = std::array::from_fn(|_| input.coordinate().into());
    _ = spacing::smallest_distance_3d(context, &points, None);
    if let Ok(share) = coverage::surface_uncovered_fraction(context, &mesh, &points, input.number(), 50, 1, None) {
        assert!((0.0..=1.0).contains(&share));
    }
    if let Ok(differences) =
        differential::surface_differences(context, &mesh, &points, &normals, direction, input.any(), None)
    {
        assert!(differences.density().iter().all(|&density| density >= 0.0));
    }
    let seen: Vec<u32> = points.iter().map(|_| input.any::<u8>().into()).collect();
    _ = facing::density_by_facing(&mesh, &seen, &[direction], input.below(20) as usize);
}
