//! The variations of the thesis's algorithm: how tensions are divided, from where edges are visited, the step size,
//! and what ends it.

use azulejo::dcr::{
    Convergence, Distribution, Method, Neighbourhood, Options, Report, Stopped, Thesis, Visits, relax, relax_observed,
};
use azulejo::{Boundary, Context, Domain};

use crate::common::sets::{darts, nearest_distances, random_points, unit_square};

const NEIGHBOURHOODS: [Neighbourhood; 2] = [Neighbourhood::Delaunay, Neighbourhood::Nearest];

fn options(neighbourhood: Neighbourhood, boundary: Boundary, thesis: Thesis) -> Options {
    Options::thesis(unit_square(boundary), neighbourhood).method(Method::Thesis(thesis))
}

/// The points after every step, from the start on.
fn states(options: &Options, start: &[[f32; 2]]) -> (Vec<Vec<[f32; 2]>>, Report) {
    let mut states = vec![start.to_vec()];
    let mut observe = |points: &[[f32; 2]]| states.push(points.to_vec());
    let (relaxed, report) =
        relax_observed(&Context::new(1).unwrap(), options, start, None, Some(&mut observe)).unwrap();
    assert_eq!(states.last(), Some(&relaxed));
    assert_eq!(states.len() as u32, report.iterations + 1);
    (states, report)
}

/// The way that each point made, on the torus or in the square.
fn displacements(domain: &Domain, from: &[[f32; 2]], to: &[[f32; 2]]) -> Vec<[f64; 2]> {
    let displacement = |(from, to): (&[f32; 2], &[f32; 2])| domain.offset(from.map(f64::from), to.map(f64::from));
    from.iter().zip(to).map(displacement).collect()
}

fn largest_difference(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
}

#[test]
fn distributions_differ_where_edges_are_visited_once_and_are_mixtures_of_two() {
    for neighbourhood in NEIGHBOURHOODS {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let start = random_points(400, 5);
            let first_step = |distribution, visits| {
                let thesis = Thesis::default().distribution(distribution).visits(visits);
                let once = options(neighbourhood, boundary, thesis).max_iterations(1);
                displacements(&once.domain, &start, &states(&once, &start).0[1])
            };
            let by = |distribution| first_step(distribution, Visits::OneEnd);
            let [zero, dominant] = [by(Distribution::Zero), by(Distribution::Dominant)];
            let mixture = |own: f64| -> Vec<_> {
                let mix = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|i| own * a[i] + (1.0 - own) * b[i]);
                zero.iter().zip(&dominant).map(mix).collect()
            };
            let scale = largest_difference(&zero, &dominant);
            assert!(scale > 1e-3, "{neighbourhood:?} {boundary:?}: {scale}");
            // Before the first step all points are equally active.
            for (own, mixed) in
                [(0.5, Distribution::Average), (0.5, Distribution::Activeness), (0.8, Distribution::EightyTwenty)]
            {
                let difference = largest_difference(&by(mixed), &mixture(own));
                assert!(difference < 1e-6, "{neighbourhood:?} {boundary:?} {mixed:?}: {difference}");
            }
            if neighbourhood == Neighbourhood::Delaunay {
                let both: Vec<_> = mixture(0.5).into_iter().map(|offset| offset.map(|x| 2.0 * x)).collect();
                let average = first_step(Distribution::Average, Visits::BothEnds);
                // The image of a point beyond the boundary is visited by halves, from either side.
                assert!(largest_difference(&average, &both) < 1e-6, "{boundary:?}");
            }
        }
    }
}

#[test]
fn single_visits_do_not_depend_on_threads_or_on_the_order_of_points_but_on_the_seed() {
    let start = random_points(3000, 6);
    let backwards: Vec<_> = start.iter().rev().copied().collect();
    for neighbourhood in NEIGHBOURHOODS {
        let thesis = Thesis::default().visits(Visits::OneEnd).distribution(Distribution::Zero);
        let few = options(neighbourhood, Boundary::Periodic, thesis).max_iterations(5);
        let run = |options: &Options, threads, points: &[[f32; 2]]| {
            relax(&Context::new(threads).unwrap(), options, points, None).unwrap().0
        };
        let expected = run(&few, 1, &start);
        assert_eq!(run(&few, 4, &start), expected);
        let mut turned = run(&few, 2, &backwards);
        turned.reverse();
        assert!(largest_difference(&displacements(&few.domain, &turned, &expected), &vec![[0.0; 2]; 3000]) < 1e-6);
        assert_ne!(run(&few.seed(1), 1, &start), expected);
    }
}

#[test]
fn steps_decay_by_their_factor() {
    let start = random_points(500, 7);
    for neighbourhood in NEIGHBOURHOODS {
        let path = |decay| {
            let thesis = Thesis::default().decay(decay);
            let options = options(neighbourhood, Boundary::Periodic, thesis).max_iterations(60).tolerance(0.0);
            (states(&options, &start).0, options.domain)
        };
        let ((constant, domain), (decaying, _)) = (path(1.0), path(0.25));
        assert_eq!(constant[1], decaying[1]);
        let second = |states: &[Vec<[f32; 2]>]| displacements(&domain, &states[1], &states[2]);
        let quarter: Vec<_> = second(&constant).into_iter().map(|offset| offset.map(|x| 0.25 * x)).collect();
        assert!(largest_difference(&second(&decaying), &quarter) < 1e-6);
        assert_eq!(decaying[40], decaying[60]);
    }
}

#[test]
fn a_slow_decay_leads_as_far_as_a_constant_step_and_converges() {
    let start = random_points(1000, 8);
    for neighbourhood in NEIGHBOURHOODS {
        let run = |decay, step| {
            let thesis = Thesis::default().decay(decay).step(step);
            let options = options(neighbourhood, Boundary::Periodic, thesis);
            relax(&Context::new(1).unwrap(), &options, &start, None).unwrap().1
        };
        let (constant, decaying) = (run(1.0, 0.05), run(0.998, 0.1));
        assert_eq!((constant.stopped, decaying.stopped), (Stopped::Converged, Stopped::Converged));
        assert!(decaying.iterations < constant.iterations, "{decaying:?} {constant:?}");
        assert!(decaying.rho > constant.rho - 0.1 && decaying.motion <= 0.02, "{decaying:?} {constant:?}");
    }
}

/// The thesis's test, from its words: the step after which it is met.
fn variance_rests(domain: &Domain, states: &[Vec<[f32; 2]>]) -> Option<usize> {
    let spacing = domain.hexagonal_distance(states[0].len());
    let variance = |points: &Vec<[f32; 2]>| {
        let distances = nearest_distances(domain, points);
        let mean = distances.iter().sum::<f64>() / distances.len() as f64;
        distances.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / distances.len() as f64
    };
    let variances: Vec<_> = states.iter().map(variance).collect();
    let mut row = 0;
    (2..states.len()).find(|&k| {
        let change = (variances[k] / variances[k - 1] - 1.0).abs();
        let displacements = displacements(domain, &states[k - 1], &states[k]);
        let stable = displacements.iter().filter(|offset| offset[0].hypot(offset[1]) < 0.01 * spacing).count();
        row = if change < 1e-3 && stable as f64 > 0.99 * displacements.len() as f64 { row + 1 } else { 0 };
        row == 10
    })
}

/// Ten steps in a row, of which each leaves the variance, and all points but a few where they are.
#[test]
fn the_oracle_of_the_thesis_s_test_notices_points_that_move_and_a_variance_that_changes() {
    let (domain, start) = (unit_square(Boundary::Periodic), random_points(400, 11));
    let step = domain.hexagonal_distance(400) as f32;
    let rests = |of: &dyn Fn(usize) -> Vec<[f32; 2]>| variance_rests(&domain, &(0..40).map(of).collect::<Vec<_>>());
    let around = |x: f32| x - x.floor();
    assert_eq!(rests(&|_| start.clone()), Some(11));
    // All points drift: their distances stay as they are.
    let drift = |share: f32| {
        let start = &start;
        move |state: usize| start.iter().map(|p| [around(p[0] + state as f32 * share * step), p[1]]).collect::<Vec<_>>()
    };
    assert_eq!(rests(&drift(0.009)), Some(11));
    assert_eq!(rests(&drift(0.011)), None);
    // One pair comes together in the ninth step: the variance changes, and all points but one stay.
    let lattice: Vec<_> = (0..400).map(|i| [(i % 20) as f32 / 20.0, (i / 20) as f32 / 20.0]).collect();
    let jolt = |state: usize| {
        let mut points = lattice.clone();
        points[0][0] = 0.003;
        points[100][0] += if state < 9 { 0.004 } else { 0.012 };
        points
    };
    assert_eq!(rests(&jolt), Some(19));
}

#[test]
fn the_thesis_s_test_ends_the_steps_when_the_variance_rests() {
    for (start, boundary) in [(random_points(1000, 9), Boundary::Periodic), (darts(1000, 9), Boundary::Bounded)] {
        // Longer steps keep the variance of small sets moving.
        let thesis = Thesis::default().step(0.02).convergence(Convergence::Variance);
        let options = options(Neighbourhood::Delaunay, boundary, thesis);
        let (states, report) = states(&options, &start);
        assert_eq!(report.stopped, Stopped::Converged);
        assert_eq!(variance_rests(&options.domain, &states), Some(report.iterations as usize));
    }
}

#[test]
fn the_thesis_s_test_fires_the_earlier_the_smaller_the_steps() {
    let start = random_points(1000, 10);
    let distance = |step, convergence| {
        let thesis = Thesis::default().step(step).convergence(convergence);
        let options = options(Neighbourhood::Delaunay, Boundary::Periodic, thesis).max_iterations(3000);
        let report = relax(&Context::new(1).unwrap(), &options, &start, None).unwrap().1;
        assert_eq!(report.stopped, Stopped::Converged);
        f64::from(report.iterations) * step
    };
    let ratio = |convergence| distance(0.00625, convergence) / distance(0.05, convergence);
    assert!(ratio(Convergence::Variance) < 0.5);
    assert!(ratio(Convergence::Motion) > 0.7);
}
