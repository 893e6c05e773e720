//! The analysis against the table that `tests/all/analysis/reference.py` found with numpy and scipy, by plain sums.

use std::collections::HashMap;

use azulejo::analysis::bonds::bond_order;
use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::spacing::{nearest_distances_2d, nearest_histogram_2d, spacing_2d};
use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::analysis::triangles::triangle_statistics;
use azulejo::{Boundary, Context, Domain};

/// The sets of the table, each with its figures.
fn table() -> Vec<Set> {
    let mut sets: Vec<Set> = Vec::new();
    for line in include_str!("analysis/reference.txt").lines() {
        let mut words = line.split(' ');
        let [name, figure] = [words.next().unwrap(), words.next().unwrap()];
        if sets.last().is_none_or(|set| set.name != name) {
            sets.push(Set { name, figures: HashMap::new() });
        }
        sets.last_mut().unwrap().figures.insert(figure, words.map(|word| word.parse().unwrap()).collect());
    }
    sets
}

struct Set {
    name: &'static str,
    figures: HashMap<&'static str, Vec<f64>>,
}

impl Set {
    fn one(&self, figure: &str) -> f64 {
        self.figures[figure][0]
    }

    fn points(&self) -> Vec<[f32; 2]> {
        self.figures["points"].chunks_exact(2).map(|point| [point[0] as f32, point[1] as f32]).collect()
    }

    fn domain(&self, boundary: Boundary) -> Domain {
        let extent = &self.figures["extent"];
        Domain { min: [0.0; 2], max: [extent[0], extent[1]], boundary }
    }

    fn spectrum(&self) -> Periodogram {
        let domain = self.domain(Boundary::Periodic);
        periodogram(&context(), &domain, &self.points(), self.one("size") as usize, None).unwrap()
    }

    /// The figure is that of the table, but for `tolerance`, relative to the larger of it and 1.
    fn check(&self, figure: &str, found: &[f64], tolerance: f64) {
        let expected = &self.figures[figure];
        assert_eq!(found.len(), expected.len(), "{} {figure}", self.name);
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            let error = (found - expected).abs();
            assert!(
                error <= tolerance * expected.abs().max(1.0),
                "{} {figure} {i}: {found}, not {expected}",
                self.name
            );
        }
    }
}

fn context() -> Context {
    Context::new(2).unwrap()
}

#[test]
fn spectra_are_those_of_direct_sums() {
    for set in table() {
        let (spectrum, size) = (set.spectrum(), set.one("size") as usize);
        let some = (size / 2..size).step_by(7).flat_map(|row| (0..size).step_by(5).map(move |column| (row, column)));
        let power: Vec<_> = some.map(|(row, column)| f64::from(spectrum.power()[row * size + column])).collect();
        set.check("power", &power, 1e-5);
        let radial = spectrum.radial(set.one("width")).unwrap();
        let radial = radial.iter().flat_map(|annulus| [annulus.frequency, annulus.power, annulus.anisotropy]);
        set.check("radial", &radial.collect::<Vec<_>>(), 1e-5);
        set.check("oscillation", &[spectrum.oscillation(set.one("width")).unwrap()], 1e-4);
        // The table goes from frequency to frequency.
        set.check("effective_nyquist", &[spectrum.effective_nyquist(0.01).unwrap()], 0.006);
    }
}

#[test]
fn distances_are_those_of_all_pairs() {
    for set in table() {
        let (points, reach, bins) = (set.points(), set.one("reach"), set.figures["distribution"].len());
        for (boundary, figure) in [(Boundary::Periodic, "distribution"), (Boundary::Bounded, "distribution_bounded")] {
            let found = radial_distribution(&context(), &set.domain(boundary), &points, reach, bins, None).unwrap();
            set.check(figure, &found.density(), 1e-8);
        }
        let domain = set.domain(Boundary::Periodic);
        let nearest = nearest_distances_2d(&context(), &domain, &points, None).unwrap();
        let histogram = nearest_histogram_2d(&domain, &nearest, reach, bins).unwrap();
        set.check("nearest", &histogram.iter().map(|&count| count as f64).collect::<Vec<_>>(), 0.0);
        let spacing = spacing_2d(&domain, &nearest);
        set.check("smallest_distance", &[spacing.smallest], 1e-9);
        set.check("mean_distance", &[spacing.mean], 1e-9);
    }
}

#[test]
fn triangles_bonds_and_coverage_are_those_of_another_triangulation() {
    for set in table() {
        let (points, domain) = (set.points(), set.domain(Boundary::Periodic));
        let found = triangle_statistics(&context(), &domain, &points, None).unwrap();
        set.check("triangles", &[found.triangles as f64], 0.0);
        set.check("obtuse", &[found.obtuse], 1e-9);
        set.check("below_30_degrees", &[found.below_30_degrees], 1e-9);
        set.check("edge_mean", &[found.edge_mean], 1e-8);
        set.check("edge_variation", &[found.edge_variation], 1e-8);
        set.check("area_variation", &[found.area_variation], 1e-8);
        set.check("bond_order", &[bond_order(&context(), &domain, &points, None).unwrap()], 1e-8);
        set.check("covering_radius", &[covering_radius_2d(&context(), &domain, &points, None).unwrap()], 1e-8);
    }
}
