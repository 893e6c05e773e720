//! Sets of meshes whose density is given, held against the definitions by plain checkers.

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Density, Options, Radius, Scale, Texture};
use azulejo::{Context, Error, MAXIMAL_DENSITY, Points};

use crate::common::adaptive_oracle as oracle;
use crate::common::adaptive_oracle::Field;
use crate::common::meshes;
use crate::common::random::Random;

fn options(density: Density, scale: Scale) -> Options {
    Options::new(Radius::Density { density, scale })
}

fn sample_only(mesh: &Mesh, options: &Options) -> Points<3> {
    let made = [1, 3].map(|threads| adaptive::sample(&Context::new(threads).unwrap(), mesh, options, None).unwrap().0);
    let [set, again] = made;
    assert_eq!(set, again, "depends on the number of threads");
    set
}

/// A set that has been checked against all pairs of samples.
fn sample(mesh: &Mesh, options: &Options) -> Points<3> {
    let set = sample_only(mesh, options);
    assert_eq!(oracle::conflict(&set, &set.radii, options.cosine), None);
    set
}

/// A rectangle 4 wide and 1 high, in as many strips.
fn strips(count: u32) -> Mesh {
    let x = |column: u32| 4.0 * column as f32 / count as f32;
    let positions = (0..=count).flat_map(|column| [[x(column), 0.0, 0.0], [x(column), 1.0, 0.0]]).collect();
    let triangles = (0..count).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]]).collect();
    Mesh::new(positions, triangles).unwrap()
}

fn at_vertices(mesh: &Mesh, density: impl Fn([f64; 3]) -> f64) -> Vec<f32> {
    mesh.positions().iter().map(|position| density(position.map(f64::from)) as f32).collect()
}

/// The number of samples of some sets in bands along x, over the number that the density asks for; a margin above and below is
/// left out, where samples stand closer.
fn bands(sets: &[Points<3>], count: usize, margin: f64, density: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut counts = vec![0.0; count];
    for [x, y, _] in sets.iter().flat_map(|set| &set.positions).map(|position| position.map(f64::from)) {
        if (margin..1.0 - margin).contains(&y) {
            counts[((x / 4.0 * count as f64) as usize).min(count - 1)] += 1.0;
        }
    }
    let width = 4.0 / count as f64;
    let integral = |band: usize| -> f64 {
        let x = |step: usize| (band as f64 + (step as f64 + 0.5) / 64.0) * width;
        (0..64).map(|step| density(x(step)) * width / 64.0).sum()
    };
    let expected = |band| sets.len() as f64 * integral(band) * (1.0 - 2.0 * margin);
    counts.iter().enumerate().map(|(band, count)| count / expected(band)).collect()
}

/// A ramp of 1:50, on two triangles and on many, by vertices, by a function, by a function at vertices, and by an image.
#[test]
fn ramps_of_one_to_fifty_are_met_in_every_band_however_they_are_given() {
    let full = 40_000.0;
    let ramp = |x: f64| (1.0 + 49.0 * x / 4.0) / 50.0;
    let of_place = |[x, ..]: [f64; 3]| ramp(x);
    let pixels: Vec<f32> = (0..2 * 400).map(|i| ramp((f64::from(i % 400) + 0.5) / 100.0) as f32).collect();
    for mesh in [strips(1), strips(300)] {
        let values = at_vertices(&mesh, of_place);
        // The image ends at the middle of its last pixels, and is repeated beyond.
        let u = |x: f32| (x / 4.0 * 399.0 + 0.5) / 400.0;
        let places: Vec<[f32; 2]> = mesh.positions().iter().map(|position| [u(position[0]), position[1]]).collect();
        let corners: Vec<_> = mesh.triangles().iter().map(|corners| corners.map(|i| places[i as usize])).collect();
        let image = |texture| Density::Image { values: &pixels, width: 400, height: 2, texture };
        let ways = [
            Density::PerVertex(&values),
            Density::AtVertices(&of_place),
            Density::Function { at: &of_place, largest: 1.0, slope: 0.25 },
            image(Texture::PerVertex(&places)),
            image(Texture::PerCorner(&corners)),
        ];
        for density in ways {
            let scale = Scale::Radius((MAXIMAL_DENSITY / full).sqrt());
            let sets: Vec<_> = (0..3).map(|seed| sample_only(&mesh, &options(density, scale).seed(seed))).collect();
            let shares = bands(&sets, 12, 0.07, |x| full * ramp(x));
            assert!(shares[1..11].iter().all(|share| (share - 1.0).abs() < 0.03), "{shares:?}");
        }
    }
}

/// Against the field of the oracle: every radius that is returned is that of its place, and no place is uncovered.
#[test]
fn radii_are_those_of_the_density_and_every_place_is_covered() {
    let sphere = {
        let (positions, triangles) = meshes::sphere();
        Mesh::new(positions, triangles).unwrap()
    };
    let density = |[x, y, z]: [f64; 3]| 0.2 + 2.0 * (x + 0.5 * y * z).abs();
    let unit = 0.15;
    // Radii change no faster than this: from the least density on.
    let slope = 0.5 * unit * 0.2f64.powf(-1.5) * 2.5;
    let radius = |place| unit / density(place).sqrt();
    let field = Field::Function(&radius, slope);
    for seed in 0..3 {
        let by_function = Density::Function { at: &density, largest: 4.0, slope: 3.0 };
        let set = sample(&sphere, &options(by_function, Scale::Radius(unit)).seed(seed));
        let wrong = (0..set.radii.len()).find(|&i| {
            let expected = radius(set.positions[i].map(f64::from));
            (set.radii[i] / expected - 1.0).abs() > 1e-5
        });
        assert_eq!(wrong, None);
        assert_eq!(oracle::gap(&sphere, &field, &set, &set.radii, -1.0, 1e-4), None);
    }
}

/// Where the density is 0 there is nothing, and beside it is all that there would be: a mask gives the same numbers.
#[test]
fn zeros_take_nothing_from_what_is_beside_them() {
    let mesh = strips(400);
    let full = 20_000.0;
    let unit = (MAXIMAL_DENSITY / full).sqrt();
    for floor in [0.0, 1e-6, 1e-4] {
        // Stripes of 0 and 1, with edges across one strip of triangles.
        let stripe = |[x, ..]: [f64; 3]| if ((x * 2.5) as u32).is_multiple_of(2) { 1.0 } else { floor };
        let values = at_vertices(&mesh, stripe);
        let set = sample(&mesh, &options(Density::PerVertex(&values), Scale::Radius(unit)));
        let masked = mesh.clone();
        let kept = |corners: &[u32; 3]| corners.iter().all(|&vertex| values[vertex as usize] == 1.0);
        let mask: Vec<bool> = mesh.triangles().iter().map(kept).collect();
        let masked = masked.with_mask(mask.clone()).unwrap();
        let ones = vec![1.0; values.len()];
        let alone = sample(&masked, &options(Density::PerVertex(&ones), Scale::Radius(unit)));
        let inside = set.triangles.iter().filter(|&&triangle| mask[triangle as usize]).count();
        let share = inside as f64 / alone.len() as f64;
        assert!((0.97..1.01).contains(&share), "{floor}: {inside} of {}", alone.len());
        let is_empty = |corners: &[u32; 3]| corners.iter().all(|&vertex| values[vertex as usize] == 0.0);
        let in_nothing = |&&triangle: &&u32| is_empty(&mesh.triangles()[triangle as usize]);
        assert_eq!(set.triangles.iter().filter(in_nothing).count(), 0);
    }
}

/// Between pixels radii change many times over, and pieces of the surface are wider than pixels.
#[test]
fn images_of_noise_and_of_edges_are_sampled() {
    let square = strips(1);
    let places: Vec<[f32; 2]> = square.positions().iter().map(|[x, y, _]| [x / 4.0, *y]).collect();
    let mut refused = 0;
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let (spread, dark) = (2.0 * random.unit(), random.unit());
        let pixel = |random: &mut Random| match random.unit() {
            x if x < dark => 0.0,
            _ => 10f32.powf(-spread * random.unit()),
        };
        let pixels: Vec<f32> = (0..60 * 40).map(|_| pixel(&mut random)).collect();
        let density = Density::Image { values: &pixels, width: 60, height: 40, texture: Texture::PerVertex(&places) };
        for count in [1000.0, 5000.0] {
            let options = options(density, Scale::Count(count)).seed(seed);
            match adaptive::sample(&Context::new(1).unwrap(), &square, &options, None) {
                Ok((set, _)) => assert!(set.radii.iter().all(|radius| *radius > 0.0 && radius.is_finite())),
                // Where pixels are far smaller than radii.
                Err(Error::TooLarge { argument: "density", .. }) => refused += 1,
                Err(error) => panic!("{error}"),
            }
        }
    }
    println!("{refused}");
    assert!(refused <= 4, "{refused} of 12");
}

#[test]
fn a_count_is_met_also_with_zeros() {
    let sphere = {
        let (positions, triangles) = meshes::sphere();
        Mesh::new(positions, triangles).unwrap()
    };
    let cap = |[_, _, z]: [f64; 3]| (z - 0.2).max(0.0);
    for count in [500.0, 5_000.0, 20_000.0] {
        let set = sample(&sphere, &options(Density::AtVertices(&cap), Scale::Count(count)));
        let share = set.len() as f64 / count;
        assert!((0.95..1.06).contains(&share), "{} of {count}", set.len());
        assert!(set.positions.iter().all(|position| position[2] > 0.1));
    }
}

#[test]
fn what_is_no_density_is_refused() {
    let mesh = strips(2);
    fn refused_on(mesh: &Mesh, density: Density, scale: Scale) -> (&'static str, String) {
        match adaptive::sample(&Context::new(1).unwrap(), mesh, &options(density, scale), None) {
            Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
            other => panic!("{other:?}"),
        }
    }
    let refused = |density: Density, scale| refused_on(&mesh, density, scale);
    let unit = Scale::Radius(0.1);
    assert_eq!(refused(Density::PerVertex(&[1.0; 5]), unit).0, "vertex_count");
    for bad in [-1.0, f32::NAN, f32::INFINITY] {
        let values = [1.0, 1.0, bad, 1.0, 1.0, 1.0];
        let (argument, reason) = refused(Density::PerVertex(&values), unit);
        assert!(argument == "density" && reason.contains("vertex 2"), "{reason}");
    }
    assert_eq!(refused(Density::PerVertex(&[0.0; 6]), unit).0, "density");
    assert_eq!(refused(Density::AtVertices(&|_| f64::NAN), unit).0, "density");
    let ramp = |[x, ..]: [f64; 3]| 1.0 + x;
    let function = |largest, slope| Density::Function { at: &ramp, largest, slope };
    assert_eq!(refused(function(0.0, 1.0), unit).0, "largest");
    assert_eq!(refused(function(5.0, -1.0), unit).0, "slope");
    assert_eq!(refused(function(3.0, 1.0), unit).0, "density", "above the largest");
    assert_eq!(refused(function(5.0, 0.1), unit).0, "density", "steeper than said");
    let image = |width, height, texture| Density::Image { values: &[1.0; 6], width, height, texture };
    assert_eq!(refused(image(0, 2, Texture::PerVertex(&[[0.0; 2]; 6])), unit).0, "width");
    assert_eq!(refused(image(2, 2, Texture::PerVertex(&[[0.0; 2]; 6])), unit).0, "density");
    assert_eq!(refused(image(3, 2, Texture::PerVertex(&[[0.0; 2]; 5])), unit).0, "texture");
    assert_eq!(refused(image(3, 2, Texture::PerVertex(&[[f32::NAN; 2]; 6])), unit).0, "texture");
    assert_eq!(refused(image(3, 2, Texture::PerCorner(&[[[0.0; 2]; 3]; 3])), unit).0, "texture");
    let ones = Density::PerVertex(&[1.0; 6]);
    assert_eq!(refused(ones, Scale::Radius(0.0)).0, "radius");
    assert_eq!(refused(ones, Scale::Count(f64::NAN)).0, "count");
    assert_eq!(refused(ones, Scale::Count(1e20)).0, "count", "floats do not carry it");
}
