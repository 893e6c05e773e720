//! Relaxation in cuboids: what it reaches, and hard sets.

use azulejo::dcr::Stopped;
use azulejo::dcr::volume::{Options, Report, relax};
use azulejo::{Boundary, Context, Domain, Error};

use crate::common::BOUNDARIES;

/// Random numbers in 0..1: fractions of multiples of SplitMix64's increment, mixed.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn points(&mut self, count: usize, max: [f64; 3]) -> Vec<[f32; 3]> {
        (0..count).map(|_| max.map(|length| (0.99999 * self.unit() * length) as f32)).collect()
    }
}

fn cuboid(max: [f64; 3], boundary: Boundary) -> Domain<3> {
    Domain { min: [0.0; 3], max, boundary }
}

fn relaxed(domain: Domain<3>, steps: u32, points: &[[f32; 3]]) -> (Vec<[f32; 3]>, Report) {
    relax(&Context::new(1).unwrap(), &Options::new(domain).max_iterations(steps), points, None).unwrap()
}

/// The distance of a place of the unit cube from the nearest point.
fn distance(points: &[[f32; 3]], domain: &Domain<3>, place: [f64; 3]) -> f64 {
    let squared = |point: &[f32; 3]| domain.offset(place, point.map(f64::from)).iter().map(|x| x * x).sum::<f64>();
    points.iter().map(squared).fold(f64::INFINITY, f64::min).sqrt()
}

/// The covering radius of a set of the unit cube, from below: the farthest of random places, after those have climbed.
fn covering_radius(points: &[[f32; 3]], domain: &Domain<3>, spacing: f64) -> f64 {
    let mut random = Random(5);
    let mut found: Vec<_> = (0..4 * points.len())
        .map(|_| {
            let place = [random.unit(), random.unit(), random.unit()];
            (distance(points, domain, place), place)
        })
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let climbed = found.iter().take(20).map(|&(mut from, mut place)| {
        let mut stride = 0.2 * spacing;
        while stride > 1e-3 * spacing {
            let to = place.map(|x| match domain.boundary {
                Boundary::Periodic => (x + stride * (2.0 * random.unit() - 1.0)).rem_euclid(1.0),
                Boundary::Bounded => (x + stride * (2.0 * random.unit() - 1.0)).clamp(0.0, 1.0),
            });
            let distance = distance(points, domain, to);
            if distance > from {
                (from, place) = (distance, to);
            } else {
                stride *= 0.93;
            }
        }
        from
    });
    climbed.fold(0.0, f64::max)
}

/// docs/design/relaxation.md: from random points, .94 and .79 after 100 steps.
#[test]
fn random_points_are_spread() {
    for seed in 0..2 {
        let (count, domain) = (1000, Domain::unit(Boundary::Periodic));
        let points = Random(seed).points(count, [1.0; 3]);
        let (spread, report) = relaxed(domain, 100, &points);
        let spacing = (2f64.sqrt() / count as f64).cbrt();
        assert!(report.rho > 0.935, "{report:?}");
        let cover = covering_radius(&spread, &domain, spacing) / spacing;
        assert!((0.7..0.82).contains(&cover), "{cover}");
        assert!((report.rho * spacing / report.smallest_distance - 1.0).abs() < 1e-12);
    }
}

#[test]
fn more_steps_spread_more() {
    let points = Random(3).points(1000, [1.0; 3]);
    let report = relaxed(Domain::unit(Boundary::Periodic), 500, &points).1;
    assert!(report.rho > 0.947, "{report:?}");
}

/// Against all pairs, in the floats that are returned, which are in the domain.
#[test]
fn the_smallest_distance_is_that_of_the_points() {
    for boundary in BOUNDARIES {
        for (max, count) in [([1.0; 3], 300), ([4.0, 1e-3, 2.0], 70), ([1e-4, 1e-3, 2.0], 30), ([1.0, 0.3, 1.0], 9)] {
            let domain = cuboid(max, boundary);
            let points = Random(8).points(count, max);
            for steps in [0, 1, 30] {
                let (relaxed, report) = relaxed(domain, steps, &points);
                let mut least = f64::INFINITY;
                for (i, a) in relaxed.iter().enumerate() {
                    assert!((0..3).all(|axis| (0.0..max[axis]).contains(&f64::from(a[axis]))), "{a:?}");
                    for b in &relaxed[..i] {
                        let offset = domain.offset(a.map(f64::from), b.map(f64::from));
                        least = least.min(offset.iter().map(|x| x * x).sum::<f64>().sqrt());
                    }
                }
                assert_eq!(report.smallest_distance, least, "{max:?} {boundary:?} {steps}");
                assert!(steps > 0 || relaxed == points);
            }
        }
    }
}

#[test]
fn threads_do_not_matter() {
    for boundary in BOUNDARIES {
        let (domain, points) = (Domain::unit(boundary), Random(1).points(9000, [1.0; 3]));
        let one = relaxed(domain, 12, &points);
        for threads in [2, 3] {
            let context = Context::new(threads).unwrap();
            assert_eq!(relax(&context, &Options::new(domain).max_iterations(12), &points, None).unwrap(), one);
        }
    }
}

#[test]
fn few_points() {
    for boundary in BOUNDARIES {
        let domain = Domain::unit(boundary);
        for count in [0, 1] {
            let points = Random(1).points(count, [1.0; 3]);
            let (same, report) = relaxed(domain, 100, &points);
            assert!(same == points && report.iterations == 0 && report.stopped == Stopped::Converged);
            assert!(report.smallest_distance == f64::INFINITY && report.rho == f64::INFINITY);
        }
        for seed in 0..20 {
            let pair = relaxed(domain, 100, &Random(seed).points(2, [1.0; 3])).1;
            let eight = relaxed(domain, 100, &Random(seed).points(8, [1.0; 3])).1;
            assert!(pair.rho > 0.9 && eight.rho > 0.8, "{boundary:?} {seed}: {} {}", pair.rho, eight.rho);
        }
    }
}

/// All at one place, on a line, in a corner, and pairs.
#[test]
fn heaps_are_spread() {
    for boundary in BOUNDARIES {
        let domain = Domain::unit(boundary);
        let random = Random(2).points(500, [1.0; 3]);
        let mut pairs = random.clone();
        pairs.extend(&random);
        let corner = Random(3).points(800, [0.01, 0.02, 0.01]);
        let line = Random(4).points(800, [0.999, 1e-9, 1e-9]);
        for points in [vec![[0.25; 3]; 700], vec![[0.5; 3]; 40], pairs, corner, line] {
            let report = relaxed(domain, 100, &points).1;
            assert!(report.rho > 0.86, "{boundary:?}, {}: {}", points.len(), report.rho);
        }
    }
}

/// Thin cuboids are sets of a plane and of a line, wherever the domain is.
#[test]
fn thin_cuboids() {
    for boundary in BOUNDARIES {
        for thickness in [1e-12, 1e-3] {
            let sheet = cuboid([1.0, thickness, 1.0], boundary);
            let report = relaxed(sheet, 200, &Random(6).points(200, sheet.max)).1;
            // The distance in hexagonal arrangement is .076; random packings of disks have .82 of the area.
            assert!(report.smallest_distance > 0.06, "{boundary:?} {thickness}: {report:?}");
            let bar = cuboid([1.0, thickness, thickness], boundary);
            let report = relaxed(bar, 200, &Random(6).points(20, bar.max)).1;
            assert!(report.smallest_distance > 0.03, "{boundary:?} {thickness}: {report:?}");
        }
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let refusal = |domain: Domain<3>, points: &[[f32; 3]]| {
        relax(&Context::new(1).unwrap(), &Options::new(domain), points, None).unwrap_err().to_string()
    };
    let unit = Domain::unit(Boundary::Periodic);
    for (domain, points, said) in [
        (unit, vec![[0.5; 3], [0.5, 1.0, 0.5]], "positions: point 1 is (0.5, 1, 0.5), outside the domain"),
        (unit, vec![[0.5, 0.5, f32::NAN]], "positions: point 0 is (0.5, 0.5, NaN), outside the domain"),
        (unit, vec![[-0.1, 0.5, 0.5]], "positions: point 0 is (-0.1, 0.5, 0.5), outside the domain"),
        (Domain { max: [1.0, 0.0, 1.0], ..unit }, vec![], "domain_max: [1] is 0, not above domain_min 0"),
        (Domain { min: [f64::NAN, 0.0, 0.0], ..unit }, vec![], "domain_min: [0] is NaN, not a finite float"),
    ] {
        let error = refusal(domain, &points);
        assert!(error.contains(said), "{error}");
    }
    for tolerance in [-1.0, f64::NAN] {
        let options = Options::new(unit).tolerance(tolerance);
        let error = relax(&Context::new(1).unwrap(), &options, &[], None).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { argument: "tolerance", .. }), "{error}");
    }
}
