//! The measurements of the C ABI, on points of all kinds: figures, histograms, spectra, coverage, differences.

#![no_main]

use azulejo_c::analysis::*;
use azulejo_c::differences::*;
use azulejo_c::domain::{azulejo_plane_set, azulejo_space_set};
use azulejo_c::mesh::*;
use azulejo_c::spectrum::*;
use azulejo_c::statistics::*;
use azulejo_fuzz::calls::{Out, Owned, accepted, array, context, create, reported, value};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let set = Set::new(&mut input);
    if input.one_in(2) {
        set.figures(input.number());
        set.histograms(&mut input);
        set.spectra(&mut input);
    } else {
        surface(&mut input);
    }
    space(&mut input);
});

/// A set of a cuboid, mostly one that is.
fn space(input: &mut Input) {
    let domain_min = [input.coordinate(), input.coordinate(), input.coordinate()].map(f64::from);
    let domain_max: [f64; 3] = std::array::from_fn(|axis| domain_min[axis] + input.number());
    let (boundary, radius) = (u32::from(input.one_in(2)), input.number());
    let mut points = input.rows::<3>(40);
    if !input.one_in(4) {
        points.retain(|point| (0..3).all(|axis| (domain_min[axis]..domain_max[axis]).contains(&point[axis].into())));
    }
    let (struct_size, positions) = (size_of::<azulejo_space_set>() as u32, points.as_ptr().cast());
    let set = azulejo_space_set { struct_size, boundary, positions, count: points.len(), domain_min, domain_max };
    // SAFETY: the array has the given length.
    let measure = |out| unsafe { azulejo_space_measure(context(), &set, radius, out) };
    if let Some(report) = reported(azulejo_space_report_init, measure) {
        assert_eq!(report.count, set.count as u64);
        assert_eq!(report.conflicts > 0, report.smallest_distance < radius);
        assert!(report.covering_radius >= 0.0 && report.rho >= 0.0);
    }
    // SAFETY: as above.
    let covers = |out| unsafe { azulejo_space_coverage(context(), &set, radius, out) };
    if let Some(coverage) = reported(azulejo_coverage_report_init, covers) {
        assert!(coverage.covering_radius <= radius || coverage.gaps > 0, "{} > {radius}", coverage.covering_radius);
    }
    space_spectra(&set, input);
}

/// The power at a few frequencies, and the density of pairs.
fn space_spectra(set: &azulejo_space_set, input: &mut Input) {
    let (reach, stride) = (f64::from(input.below(200)) / 100.0, input.below(4));
    let width = if input.one_in(8) { input.number() } else { reach / 8.0 };
    let capacity = input.below(12) as usize;
    let mut annuli = vec![azulejo_annulus { frequency: -1.0, power: -1.0, anisotropy: -1.0, count: 0 }; capacity];
    let start = if capacity == 0 { std::ptr::null_mut() } else { annuli.as_mut_ptr() };
    let size = size_of::<azulejo_annulus>();
    // SAFETY: the arrays have these lengths.
    let spectrum = |out: Out<_>| unsafe {
        azulejo_space_spectrum(context(), set, reach, stride, width, start, capacity, size, out)
    };
    if let Some(count) = value(spectrum) {
        let annuli = &annuli[..count.min(capacity)];
        assert!(annuli.iter().all(|annulus| annulus.count >= 2 && annulus.power >= 0.0 && annulus.frequency > 0.0));
    }
    let (axis, count) = (input.below(4), input.below(9) as usize);
    let (mut power, mut density) = (vec![f64::NAN; count], vec![f64::NAN; count]);
    // SAFETY: the arrays have this length.
    unsafe {
        if accepted(azulejo_space_axis_power(context(), set, axis, count, power.as_mut_ptr())) {
            assert!(power.iter().all(|&power| power >= 0.0 && power.is_finite()), "{power:?}");
        }
        let reach = input.number();
        if accepted(azulejo_space_radial_distribution(context(), set, reach, count, density.as_mut_ptr())) {
            assert!(density.iter().all(|&density| density >= 0.0), "{density:?}");
        }
    }
}

/// A set of the plane, mostly one that is.
struct Set {
    points: Vec<[f32; 2]>,
    min: [f64; 2],
    max: [f64; 2],
    boundary: u32,
}

impl Set {
    fn new(input: &mut Input) -> Self {
        let min = [input.coordinate(), input.coordinate()].map(f64::from);
        let max = std::array::from_fn(|axis| min[axis] + input.number());
        let boundary = if input.one_in(32) { input.any() } else { u32::from(input.one_in(2)) };
        let mut points = input.rows::<2>(60);
        if !input.one_in(4) {
            points.retain(|point| (0..2).all(|axis| (min[axis]..max[axis]).contains(&point[axis].into())));
        }
        Self { points, min, max, boundary }
    }

    /// As the calls want it.
    fn of_c(&self) -> azulejo_plane_set {
        azulejo_plane_set {
            struct_size: size_of::<azulejo_plane_set>() as u32,
            boundary: self.boundary,
            positions: self.points.as_ptr().cast(),
            count: self.points.len(),
            domain_min: self.min,
            domain_max: self.max,
        }
    }

    fn figures(&self, radius: f64) {
        let set = self.of_c();
        // SAFETY: the array has the given length.
        let measure = |out| unsafe { azulejo_plane_measure(context(), &set, out) };
        if let Some(report) = reported(azulejo_plane_report_init, measure) {
            assert_eq!(report.count, set.count as u64);
            assert!(report.smallest_distance >= 0.0 && report.covering_radius >= 0.0 && report.rho >= 0.0);
            assert!((0.0..=1.0).contains(&report.obtuse) && (0.0..=1.000001).contains(&report.bond_order));
        }
        // SAFETY: as above.
        let covers = |out| unsafe { azulejo_plane_coverage(context(), &set, radius, out) };
        if let Some(coverage) = reported(azulejo_coverage_report_init, covers) {
            assert!(coverage.covering_radius >= 0.0, "{}", coverage.covering_radius);
            assert!(coverage.covering_radius <= radius || coverage.gaps > 0, "{} > {radius}", coverage.covering_radius);
        }
    }

    fn histograms(&self, input: &mut Input) {
        let set = self.of_c();
        let reach = input.number();
        let bins = if input.one_in(8) { input.any::<u32>() as usize } else { input.below(100) as usize };
        // Where there are too many bins nothing is written.
        let (mut nearest, mut density) = (vec![u64::MAX; bins.min(65536)], vec![-1.0f64; bins.min(65536)]);
        // SAFETY: the arrays have the given lengths, or are longer than the calls accept.
        unsafe {
            let out = nearest.as_mut_ptr();
            if accepted(azulejo_plane_nearest_histogram(context(), &set, reach, bins, out)) {
                assert!(nearest.iter().sum::<u64>() <= set.count as u64);
            }
            let out = density.as_mut_ptr();
            if accepted(azulejo_plane_radial_distribution(context(), &set, reach, bins, out)) {
                assert!(density.iter().all(|&density| density >= 0.0), "{density:?}");
            }
        }
    }

    fn spectra(&self, input: &mut Input) {
        let set = self.of_c();
        let size = if input.one_in(16) { 4097 + input.below(5000) } else { input.below(64) };
        let stride = if input.one_in(4) { input.below(5000) } else { 1 };
        // SAFETY: the array has the given length.
        let make = |out: Out<_>| unsafe { azulejo_spectrum_create(context(), &set, size, stride, out) };
        let Some(one) = create(make) else { return };
        let both: [*mut azulejo_spectrum; 2] = [one.get(); 2];
        // SAFETY: two spectra that live.
        let mean = create(|out| unsafe { azulejo_spectrum_mean((&raw const both).cast(), 2, out) });
        let mean = mean.expect("two spectra of one size have a mean");
        let length = mean.read(azulejo_spectrum_size) as usize;
        assert_eq!(length, size as usize);
        // SAFETY: the header says how long it is.
        let power = unsafe { array(mean.read(azulejo_spectrum_power), length * length) };
        assert!(power.iter().all(|&power| power >= 0.0 && power.is_finite()));
        let (width, low, high) = (input.number() / 16.0, input.number(), input.number());
        let capacity = input.below(20) as usize;
        let mut annuli = vec![azulejo_annulus { frequency: -1.0, power: -1.0, anisotropy: -1.0, count: 0 }; capacity];
        let start = if capacity == 0 { std::ptr::null_mut() } else { annuli.as_mut_ptr() };
        // SAFETY: the array has this capacity.
        let radial = |out: Out<_>| unsafe {
            azulejo_spectrum_radial(mean.get(), width, start, capacity, size_of::<azulejo_annulus>(), out)
        };
        if let Some(count) = value(radial) {
            assert!(annuli.iter().take(count).all(|annulus| annulus.count >= 2 && annulus.power >= 0.0));
        }
        // SAFETY: the spectrum lives.
        let measure = |out| unsafe { azulejo_spectrum_measure(mean.get(), width, low, high, out) };
        let report = reported(azulejo_spectrum_report_init, measure);
        assert!(report.is_none_or(|report| report.contrast >= 0.0 && report.peak >= 0.0));
    }
}

fn surface(input: &mut Input) {
    let (positions, count) = (input.rows::<3>(20), input.below(20) as usize);
    let vertex = |input: &mut Input| u32::from(input.any::<u8>()) % positions.len().max(1) as u32;
    let indices: Vec<u32> = (0..3 * count).map(|_| vertex(input)).collect();
    let (start, vertices) = (positions.as_ptr().cast(), positions.len());
    // SAFETY: the arrays have the given lengths.
    let made = create(|out| unsafe { azulejo_mesh_create(start, vertices, 12, indices.as_ptr(), count, out) });
    let Some(mesh) = made else { return };
    let samples = input.rows::<3>(60);
    let corner = |&vertex: &u32| positions[vertex as usize].map(f64::from);
    let edge = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
    let corners = indices.as_chunks::<3>().0.iter().map(|triangle| triangle.each_ref().map(corner));
    let length = corners.map(|[a, b, c]| edge(a, b) + edge(b, c)).sum();
    covered(&mesh, length, &samples, input);
    differ(&mesh, &samples, input);
}

fn covered(mesh: &Owned<azulejo_mesh>, length: f64, samples: &[[f32; 3]], input: &mut Input) {
    let area = mesh.read(azulejo_mesh_area);
    let radius = if input.one_in(4) { input.number() } else { (area / f64::from(1 + input.below(100))).sqrt() };
    let pieces = area / (radius * radius) + length / radius;
    if (1e3..1e16).contains(&pieces) {
        return; // refused or found, but not in the time that a fuzz target has
    }
    let (start, count) = (samples.as_ptr().cast(), samples.len());
    // SAFETY: the array has the given length.
    let covers = |out| unsafe { azulejo_mesh_coverage(context(), mesh.get(), start, count, radius, out) };
    if let Some(coverage) = reported(azulejo_coverage_report_init, covers) {
        assert!(coverage.covering_radius >= 0.0, "{}", coverage.covering_radius);
        assert!(coverage.covering_radius <= radius || coverage.gaps > 0, "{} > {radius}", coverage.covering_radius);
    }
}

fn differ(mesh: &Owned<azulejo_mesh>, samples: &[[f32; 3]], input: &mut Input) {
    let normals: Vec<[f32; 3]> = samples.iter().map(|_| std::array::from_fn(|_| input.coordinate())).collect();
    let direction: [f64; 3] = std::array::from_fn(|_| input.coordinate().into());
    let (start, normals, count, seed) = (samples.as_ptr().cast(), normals.as_ptr().cast(), samples.len(), input.any());
    // SAFETY: the arrays have the given lengths.
    let make = |out: Out<_>| unsafe {
        azulejo_differences_create(context(), mesh.get(), start, normals, count, direction.as_ptr(), seed, out)
    };
    let Some(one) = create(make) else { return };
    let both: [*mut azulejo_differences; 2] = [one.get(); 2];
    // SAFETY: two that live.
    let mean = create(|out| unsafe { azulejo_differences_mean((&raw const both).cast(), 2, out) });
    let mean = mean.expect("differences have a mean");
    let cells = AZULEJO_DIFFERENCES_SIZE.pow(2) as usize;
    // SAFETY: the header says how long they are.
    let [density, radial] = unsafe {
        [
            array(mean.read(azulejo_differences_density), cells),
            array(mean.read(azulejo_differences_radial), AZULEJO_DIFFERENCES_SHELLS as usize),
        ]
    };
    assert!(density.iter().chain(radial).all(|&density| density >= 0.0));
    let frequencies: Vec<f64> = (0..input.below(9)).map(|_| input.number()).collect();
    let mut power = vec![f64::NAN; frequencies.len()];
    let (from, count, out) = (frequencies.as_ptr(), frequencies.len(), power.as_mut_ptr());
    // SAFETY: both arrays have the given lengths.
    if accepted(unsafe { azulejo_differences_power(mean.get(), from, count, out) }) {
        assert!(power.iter().all(|power| power.is_finite()), "{power:?}");
    }
}
