//! A host with a rayon of its own: our calls on the host's threads, beside its pool and never on its global one. In a process
//! of its own, since there is one global pool for each.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use azulejo::Context;
use azulejo::kdrt;
use azulejo::mesh::Mesh;
use azulejo::psp;
use rayon::prelude::*;

fn plane(context: &Context, seed: u64) -> Vec<[f32; 2]> {
    let options = kdrt::Options::new(0.02).leaf_size(6.0).seed(seed);
    kdrt::sample(context, &options, Some(&|_| std::ops::ControlFlow::Continue(()))).unwrap().positions
}

fn surface(context: &Context, seed: u64) -> Vec<[f32; 3]> {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mesh = Arc::new(Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap());
    let options = psp::ProjectionOptions::new(0.1).seed(seed);
    psp::project(context, &mesh, &options, 1, true, None).unwrap().0.positions
}

#[test]
fn a_host_calls_from_its_own_pool_and_keeps_its_global_one() {
    let alone = Context::new(1).unwrap();
    let expected: Vec<_> = (0..40).map(|seed| (plane(&alone, seed), surface(&alone, seed))).collect();

    let host = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    for threads in [1, 2] {
        let context = Context::new(threads).unwrap();
        let busy = AtomicUsize::new(0);
        // Tasks of the host that wait for ours, on all of its threads at once, one inside the other.
        let found: Vec<_> = host.install(|| {
            let sample = |seed| {
                let (plane, surface) = rayon::join(|| plane(&context, seed), || surface(&context, seed));
                busy.fetch_add(1, Ordering::Relaxed);
                (plane, surface)
            };
            (0..40).into_par_iter().map(sample).collect()
        });
        assert!(found == expected && busy.into_inner() == 40);
    }

    // Nobody has made it until now.
    rayon::ThreadPoolBuilder::new().num_threads(2).build_global().unwrap();
}
