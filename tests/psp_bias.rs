//! How even the sets of PSP are, however a surface is turned towards the projectors.

#[path = "common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::sync::Arc;

use azulejo::Context;
use azulejo::analysis::facing::density_by_facing;
use azulejo::mesh::Mesh;
use azulejo::psp::{Options, Priority, Psp};

/// Degrees of a bin.
const BIN: usize = 6;

/// N·r²/A by the angle to the nearest projector, 0 to 54 degrees, after one iteration and after filling, of a few seeds.
fn densities(priority: Priority) -> [Vec<f64>; 2] {
    let (positions, triangles) = meshes::fine_torus(400, 160);
    let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
    let (context, radius, seeds) = (Context::new(2).unwrap(), 0.016, 6);
    let mut sums = [(); 2].map(|()| vec![[0.0; 2]; 54 / BIN]);
    for seed in 0..seeds {
        let mut psp = Psp::new(&mesh, &Options::new(radius).seed(seed).priority(priority)).unwrap();
        assert_eq!(psp.directions(), None);
        for (step, sums) in sums.iter_mut().enumerate() {
            let advance = if step == 0 { psp.advance(&context, 1, None) } else { psp.fill(&context, None) };
            advance.unwrap();
            let directions = psp.directions().unwrap();
            let facings = density_by_facing(&mesh, &psp.samples().triangles, &directions, 90 / BIN).unwrap();
            assert!(facings[10..].iter().all(|facing| facing.area == 0.0), "a direction is missing");
            for (sum, facing) in sums.iter_mut().zip(facings) {
                *sum = [sum[0] + facing.samples as f64, sum[1] + facing.area];
            }
        }
    }
    sums.map(|bins| bins.into_iter().map(|[samples, area]| samples * radius * radius / area).collect())
}

/// The density of an unbiased maximal set.
const MAXIMAL: f64 = 0.69656;

/// What one iteration finds depends on the angle; what is filled makes up for all of it but a few percent.
#[test]
fn filling_evens_out_what_the_projectors_miss() {
    for (priority, left) in [(Priority::Squareness, 0.045), (Priority::Projector, 0.03)] {
        let [found, filled] = densities(priority);
        assert!(found[found.len() - 1] < 0.8 * found[0], "{priority:?} {found:?}");
        // Where a projector looks squarely its pattern is as it was, but for what candidates of others displace.
        assert_eq!(found[0] > 0.98 * MAXIMAL, priority == Priority::Squareness, "{priority:?} {found:?}");
        for density in filled {
            assert!((density / MAXIMAL - 1.0).abs() < left, "{priority:?} {density}");
        }
    }
}
