//! `kdrt::merge` against naive oracles.

use azulejo::kdrt::{self, MergeOptions, MergeReport, Piece, merge};
use azulejo::{Boundary, Context, Domain, Error};
use proptest::prelude::*;

use crate::common;
use crate::common::merge_oracle;
use crate::common::pieces::{HOLES, PINWHEEL, Part, darts, outline, part, parts, tiles};
use crate::common::random::Random;
use crate::common::{BOUNDARIES, domain, float_spacing, hard_domains};

fn as_pieces(parts: &[Part]) -> Vec<Piece<'_>> {
    let pieces = parts.iter();
    pieces.map(|Part { samples, rectangle }| Piece { samples, min: rectangle.min, max: rectangle.max }).collect()
}

fn merged(options: &MergeOptions, parts: &[Part], fixed: &[[f32; 2]]) -> Result<(Vec<[f32; 2]>, MergeReport), Error> {
    // Not the pool's size decides; see also the test of threads.
    let context = Context::new(1 + options.seed as usize % 2)?;
    merge(&context, options, &as_pieces(parts), fixed, None).map(|(points, report)| (points.positions, report))
}

/// Merges and checks everything that is promised whatever is given. Gives the result and how many samples of each piece
/// went.
fn check(options: &MergeOptions, parts: &[Part], fixed: &[[f32; 2]]) -> (Vec<[f32; 2]>, Vec<usize>) {
    let (samples, report) = merged(options, parts, fixed).unwrap();
    let counts = [report.kept, report.eliminated, report.inserted];
    match merge_oracle::fault(options, parts, fixed, &samples, counts) {
        Ok(went) => (samples, went),
        Err(fault) => panic!("{fault}: {options:?}"),
    }
}

/// The pieces are maximal: only the seams may change, and nothing else need be tested.
fn check_seams(options: &MergeOptions, parts: &[Part], fixed: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let (samples, _) = check(options, parts, fixed);
    assert_eq!(merge_oracle::fault_of_seams(options, parts, fixed, &samples), None, "{options:?}");
    let (seams_alone, _) = merged(&options.maximal_pieces(true), parts, fixed).unwrap();
    assert!(seams_alone == samples, "{options:?}");
    samples
}

/// Each promise is broken by hand in a result that keeps all of them.
#[test]
fn the_oracles_notice_every_broken_promise() {
    let domain = domain([0.0; 2], [1.0, 0.8], Boundary::Periodic);
    let (options, parts) = (MergeOptions::new(0.03).domain(domain).seed(2), parts(&domain, 0.03, &PINWHEEL, 2));
    let fixed = darts(&domain, 0.03, 12, 3);
    let (samples, report) = merged(&options, &parts, &fixed).unwrap();
    let counts = [report.kept, report.eliminated, report.inserted];
    let said = |samples: &[[f32; 2]], counts| merge_oracle::fault(&options, &parts, &fixed, samples, counts);
    let fails = |samples: &[[f32; 2]], counts, with: &str| {
        let fault = said(samples, counts).unwrap_err();
        assert!(fault.contains(with), "{fault}, not {with}");
    };
    assert!(said(&samples, counts).is_ok() && report.inserted > 5 && report.eliminated > 5 && report.kept > 100);
    let changed = |index: usize, sample: [f32; 2]| {
        let mut samples = samples.clone();
        samples[index] = sample;
        samples
    };
    let last = samples.len() - 1;
    fails(&changed(last, [1.0, 0.3]), counts, "outside");
    fails(&changed(last, samples[0].map(|x| x + 0.01)), counts, "conflict");
    for missing in 0..samples.len() {
        let mut samples = samples.clone();
        samples.remove(missing);
        fails(&samples, counts, "uncovered");
    }
    // A fixed point that moves by one float, two that change places, and kept samples in another order.
    fails(&changed(0, [samples[0][0].next_up(), samples[0][1]]), counts, "fixed");
    let swapped = |i: usize, j: usize| {
        let mut samples = samples.clone();
        samples.swap(i, j);
        samples
    };
    fails(&swapped(0, 1), counts, "fixed");
    fails(&swapped(fixed.len(), fixed.len() + 1), counts, "kept");
    let [kept, eliminated, inserted] = counts;
    for counts in [[kept, eliminated + 1, inserted], [kept, eliminated, inserted + 1], [kept + 1, eliminated, inserted]]
    {
        fails(&samples, counts, "counts");
    }
    // One that was kept moves by a float, and is said to be new.
    let moved = |index: usize| {
        let mut samples = samples.clone();
        let sample = samples.remove(index);
        samples.push([sample[0].next_up(), sample[1]]);
        samples
    };
    fails(&moved(fixed.len()), [kept - 1, eliminated + 1, inserted + 1], "without need");

    let of_seams = |samples: &[[f32; 2]]| merge_oracle::fault_of_seams(&options, &parts, &fixed, samples);
    assert_eq!(of_seams(&samples), None);
    let is_inner = |sample: &[f32; 2]| {
        let Domain { min, max, .. } = parts[4].rectangle;
        let is_far = fixed.iter().all(|&fixed| common::distance(&domain, *sample, fixed) > 0.03);
        is_far && (0..2).all(|axis| (min[axis] + 0.06..max[axis] - 0.06).contains(&f64::from(sample[axis])))
    };
    let inner = samples.iter().position(is_inner).unwrap();
    let fault = of_seams(&moved(inner)).unwrap();
    assert!(fault.contains("of the interior went"), "{fault}");
    let fault = of_seams(&[&samples[..], &[[samples[inner][0].next_up(), samples[inner][1]]]].concat()).unwrap();
    assert!(fault.contains("new in the interior"), "{fault}");
}

/// Pieces so wide that most blocks are deep in one of them; those of windows are not covered at their edges.
#[test]
fn the_seams_of_wide_maximal_pieces_are_all_that_is_tested() {
    let radius = 1.0 / 90.0;
    for (seed, boundary) in (0..).zip(BOUNDARIES) {
        let domain = domain([0.3, -2.0], [1.4, -1.0], boundary);
        let options = MergeOptions::new(radius).domain(domain).seed(seed);
        for shares in [tiles(1, 1), tiles(2, 2), PINWHEEL.to_vec(), HOLES.to_vec()] {
            let mut parts = parts(&domain, radius, &shares, seed);
            for fixed in [vec![], darts(&domain, radius, 5, seed)] {
                check_seams(&options, &parts, &fixed);
            }
            for (index, part) in parts.iter_mut().enumerate() {
                let (context, rectangle) = (Context::new(1).unwrap(), part.rectangle);
                let plane = kdrt::Options::new(radius).domain(domain).leaf_size(6.0).seed(seed + index as u64);
                part.samples =
                    kdrt::sample_window(&context, &plane, rectangle.min, rectangle.max, None).unwrap().positions;
            }
            check_seams(&options, &parts, &[]);
            // What is claimed falsely shows: a hole deep in a piece stays.
            let Part { samples, rectangle: Domain { min, max, .. } } = &mut parts[0];
            let middle = [0, 1].map(|axis: usize| (0.5 * (min[axis] + max[axis])) as f32);
            samples.retain(|sample| common::distance(&domain, *sample, middle) > 0.03);
            let [tested, trusted] = [false, true].map(|is| merged(&options.maximal_pieces(is), &parts, &[]).unwrap().0);
            let near = |samples: &[[f32; 2]]| {
                samples.iter().filter(|p| common::distance(&domain, **p, middle) <= 0.03).count()
            };
            assert!(near(&tested) > 8 && near(&trusted) == 0);
        }
    }
}

#[test]
fn pieces_of_hard_domains_become_one_set() {
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for (seed, (radii, shares)) in
                [(7.0, tiles(2, 1)), (25.0, tiles(2, 2)), (40.0, PINWHEEL.to_vec()), (40.0, tiles(4, 4))]
                    .into_iter()
                    .enumerate()
            {
                let (radius, seed) = (domain.area().sqrt() / radii, seed as u64);
                let parts = parts(&domain, radius, &shares, seed);
                check_seams(&MergeOptions::new(radius).domain(domain).seed(seed), &parts, &[]);
            }
        }
    }
}

#[test]
fn the_coarsest_floats_that_carry_a_radius_are_enough() {
    for boundary in BOUNDARIES {
        // 64 float spacings below 2; the left half of the second domain is finer.
        for min in [1.0, 0.5] {
            let domain = domain([min; 2], [min + 0.0003; 2], boundary);
            let radius = 64.0 * float_spacing(&domain);
            for seed in 0..4 {
                let parts = parts(&domain, radius, &PINWHEEL, seed);
                check_seams(&MergeOptions::new(radius).domain(domain).seed(seed), &parts, &[]);
            }
        }
    }
}

#[test]
fn many_seeds_keep_the_promise() {
    for boundary in BOUNDARIES {
        let domain = domain([0.0; 2], [1.0, 0.8], boundary);
        for seed in 0..30 {
            let parts = parts(&domain, 0.03, &PINWHEEL, seed);
            check_seams(&MergeOptions::new(0.03).domain(domain).seed(seed), &parts, &[]);
        }
    }
}

/// Windows of two planes, large enough for several windows of fill blocks, and the same plane cut in two.
#[test]
fn windows_of_planes_are_zipped() {
    let context = Context::new(2).unwrap();
    for boundary in BOUNDARIES {
        let domain = domain([-1.0, 0.0], [1.0, 0.7], boundary);
        let window = |seed, min, max| {
            let options = kdrt::Options::new(0.006).domain(domain).seed(seed);
            let samples = kdrt::sample_window(&context, &options, min, max, None).unwrap().positions;
            Part { samples, rectangle: Domain { min, max, boundary: Boundary::Bounded } }
        };
        let options = MergeOptions::new(0.006).domain(domain).seed(5);
        let halves = |seed| [window(1, [-1.0, 0.0], [0.1, 0.7]), window(seed, [0.1, 0.0], [1.0, 0.7])];
        // A window of a plane is not maximal at its boundary, but with the rest of its plane it is.
        let same = halves(1);
        let (samples, _) = merged(&options, &same, &[]).unwrap();
        assert!(samples.iter().eq(same.iter().flat_map(|half| &half.samples)));
        let (samples, went) = check(&options, &halves(2), &[]);
        assert!(went.iter().sum::<usize>() > 0);
        let given: usize = halves(2).iter().map(|half| half.samples.len()).sum();
        assert!(samples.len().abs_diff(given) * 100 < given);
    }
}

#[test]
fn strips_narrower_than_the_radius_are_merged() {
    for boundary in BOUNDARIES {
        for (count, radius) in [(40, 0.06), (90, 0.04), (7, 0.5), (60, 0.1)] {
            let domain = domain([0.3, -0.2], [1.3, 0.8], boundary);
            for (seed, shares) in [tiles(count, 1), tiles(1, count), tiles(count, 3)].into_iter().enumerate() {
                let seed = seed as u64;
                check(
                    &MergeOptions::new(radius).domain(domain).seed(seed),
                    &parts(&domain, radius, &shares, seed),
                    &[],
                );
            }
        }
    }
}

#[test]
fn what_no_piece_covers_is_filled() {
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for (radii, seed) in [(0.3, 0), (3.0, 1), (9.0, 2), (30.0, 3)] {
                let radius = domain.area().sqrt() / radii;
                let options = MergeOptions::new(radius).domain(domain).seed(seed);
                check_seams(&options, &parts(&domain, radius, &HOLES, seed), &[]);
                check(&options, &[], &[]);
            }
        }
    }
}

/// Every second sample and more is taken out, at random or all of a region.
#[test]
fn pieces_that_are_not_maximal_are_filled() {
    for boundary in BOUNDARIES {
        let domain = domain([0.0; 2], [1.0; 2], boundary);
        for seed in 0..10 {
            let mut parts = parts(&domain, 0.04, &tiles(2, 2), seed);
            let mut random = Random::new(seed);
            parts[0].samples.retain(|_| random.unit() < 0.4);
            parts[1].samples.retain(|sample| sample[1] < 0.1);
            parts[2].samples.clear();
            let (samples, _) = check(&MergeOptions::new(0.04).domain(domain).seed(seed), &parts, &[]);
            assert!(samples.len() as f64 * 0.04 * 0.04 > 0.65);
        }
    }
}

#[test]
fn fixed_points_stay() {
    for boundary in BOUNDARIES {
        let domain = domain([-0.1, 0.2], [0.9, 1.2], boundary);
        let radius = 0.03;
        let polygon = [[0.1, 0.3], [0.8, 0.4], [0.7, 0.8], [0.45, 0.75], [0.4, 1.1], [0.05, 1.05]];
        let frame = [[-0.09, 0.21], [0.89, 0.21], [0.89, 1.19], [-0.09, 1.19]];
        let whole = part(domain.min, domain.max, radius, 9).samples;
        let whole_torus = kdrt::Options::new(radius).domain(domain).leaf_size(6.0).seed(9);
        let whole_torus = kdrt::sample(&Context::new(1).unwrap(), &whole_torus, None).unwrap().positions;
        let sets = [
            outline(&polygon, radius),
            if boundary == Boundary::Bounded { outline(&frame, radius) } else { Vec::new() },
            vec![[0.25, 0.5]],
            vec![domain.min.map(|x| (x as f32).next_up())],
            darts(&domain, radius, 60, 1),
            darts(&domain, radius, 5000, 2),
            if boundary == Boundary::Bounded { whole } else { whole_torus.clone() },
        ];
        for (seed, fixed) in sets.iter().enumerate() {
            assert!(seed == 1 || !fixed.is_empty());
            let seed = seed as u64;
            let options = MergeOptions::new(radius).domain(domain).seed(seed);
            for shares in [&PINWHEEL[..], &HOLES[..], &[]] {
                check_seams(&options, &parts(&domain, radius, shares, seed), fixed);
            }
        }
        // Nothing fits between the points of a maximal set.
        let (samples, report) =
            merged(&MergeOptions::new(radius).domain(domain), &parts(&domain, radius, &PINWHEEL, 0), &sets[6]).unwrap();
        assert!(samples == sets[6] && report.kept == 0 && report.inserted == 0 && report.eliminated > 700);
    }
}

/// A square grid with the radius as its width, to the bit: as close as points may be.
#[test]
fn points_exactly_a_radius_apart_do_not_conflict() {
    let domain = domain([0.0; 2], [1.0; 2], Boundary::Periodic);
    let fixed: Vec<[f32; 2]> = (0..256).map(|i| [(i % 16) as f32 / 16.0, (i / 16) as f32 / 16.0]).collect();
    let (samples, _) = check(&MergeOptions::new(1.0 / 16.0).domain(domain), &[], &fixed);
    assert_eq!(samples, fixed);
    let error = merged(&MergeOptions::new((1.0f64 / 16.0).next_up()).domain(domain), &[], &fixed).unwrap_err();
    assert!(error.to_string().starts_with("fixed: points 0 and"), "{error}");
}

/// Subnormal and other floats between the points of the domain's lattice come back as they are.
#[test]
fn floats_finer_than_the_lattice_come_back_bit_by_bit() {
    for boundary in BOUNDARIES {
        let domain = domain([-1e5, -3.0], [1e5, 1e5], boundary);
        let fixed = [[1e-40, -0.0], [-3e4 - 0.001, 7.7e-12], [-99_999.99, -2.9999998], [12_345.678, 99_999.99]];
        check(&MergeOptions::new(1500.0).domain(domain).seed(3), &[], &fixed);
        check(&MergeOptions::new(1.0e4).domain(domain).seed(3), &parts(&domain, 1.0e4, &PINWHEEL, 1), &fixed);
    }
}

/// The spacing of floats is a 64th of the radius along x, and next to nothing along y, where few of the fixed points are
/// on the domain's lattice.
#[test]
fn new_samples_keep_the_radius_from_floats_finer_than_the_lattice() {
    let unit = f64::from(f32::EPSILON) / 2.0;
    for boundary in BOUNDARIES {
        for seed in 0..10 {
            let domain = domain([1.0 - 1000.4 * unit, -700.7 * unit], [1.0, 800.3 * unit], boundary);
            let radius = 64.0 * unit;
            assert_eq!(float_spacing(&domain), unit);
            let fixed = darts(&domain, radius, 60, seed);
            assert!(fixed.len() > 30);
            check_seams(&MergeOptions::new(radius).domain(domain).seed(seed), &[], &fixed);
            check_seams(
                &MergeOptions::new(radius).domain(domain).seed(seed),
                &parts(&domain, radius, &PINWHEEL, seed),
                &fixed,
            );
        }
    }
}

#[test]
fn both_of_two_pieces_can_win() {
    let domain = Domain::unit(Boundary::Bounded);
    let parts = parts(&domain, 0.03, &tiles(2, 1), 0);
    let mut won = [0; 2];
    for seed in 0..40 {
        let (_, went) = check(&MergeOptions::new(0.03).domain(domain).seed(seed), &parts, &[]);
        assert!(went.contains(&0) && went != [0, 0]);
        won[went.iter().position(|&count| count == 0).unwrap()] += 1;
    }
    assert!(won.iter().all(|&count| count > 8), "{won:?}");
}

#[test]
fn seeds_and_not_threads_decide() {
    for boundary in BOUNDARIES {
        let domain = Domain::unit(boundary);
        let options = MergeOptions::new(0.003).domain(domain).seed(1);
        let mut parts = parts(&domain, 0.003, &HOLES, 0);
        parts[0].samples.retain(|sample| sample[0] > 0.2);
        let fixed = darts(&domain, 0.003, 300, 0);
        let merged = |threads, options: MergeOptions| {
            merge(&Context::new(threads).unwrap(), &options, &as_pieces(&parts), &fixed, None).unwrap()
        };
        let one = merged(1, options);
        assert!(one == merged(4, options) && one == merged(3, options));
        assert!(one != merged(1, options.seed(2)));
    }
}

/// A set with a boundary becomes one without: its own opposite sides meet over the seam.
#[test]
fn pieces_meet_themselves_over_the_seam() {
    for (extent, seed) in [([1.0, 1.0], 0), ([0.7, 1.0], 1), ([1.0, 0.05], 2), ([0.11, 0.1], 3)] {
        let domain = domain([0.0; 2], extent, Boundary::Periodic);
        let options = MergeOptions::new(0.03).domain(domain).seed(seed);
        let whole = [part([0.0; 2], extent, 0.03, seed)];
        check_seams(&options, &whole, &[]);
        assert!(check(&options, &whole, &[]).1[0] > 0);
        check_seams(&options, &parts(&domain, 0.03, &tiles(1, 3), seed), &[]);
        let bounded = options.domain(common::domain([0.0; 2], extent, Boundary::Bounded));
        assert_eq!(merged(&bounded, &whole, &[]).unwrap().0, whole[0].samples);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_rectangle_cut_anywhere(
        corner in prop::array::uniform2(-10.0..10.0f64),
        height in -3.0..3.0f64,
        aspect in -3.0..3.0f64,
        radii in 0.0..3.6f64,
        cuts in prop::array::uniform3(0.001..0.999f64),
        thin in 0.0..1.0f32,
        points in 0..40usize,
        periodic: bool,
        seed: u64,
    ) {
        let (height, aspect) = (height.exp(), aspect.exp());
        let boundary = BOUNDARIES[usize::from(!periodic)];
        let domain = domain(corner, [corner[0] + height * aspect, corner[1] + height], boundary);
        let radius = domain.area().sqrt() / radii.exp();
        let [x, low, high] = cuts;
        let shares = [
            [[0.0, 0.0], [x, low]],
            [[0.0, low], [x, 1.0]],
            [[x, 0.0], [1.0, high]],
            [[x, high], [1.0, 1.0]],
        ];
        let mut parts = parts(&domain, radius, &shares, seed % 1000);
        let mut random = Random::new(seed);
        parts[0].samples.retain(|_| random.unit() < thin);
        let fixed = darts(&domain, radius, points, seed);
        check(&MergeOptions::new(radius).domain(domain).seed(seed), &parts, &fixed);
    }
}
