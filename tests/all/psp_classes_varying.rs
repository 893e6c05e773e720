//! Several classes on a mesh whose radii vary by one field, held against their definition by plain checkers: all pairs,
//! and for each class the whole surface.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{Density, Radius, Scale, Texture};
use azulejo::psp::{self, ClassOptions};
use azulejo::{Classes, Context, Error, Given, MAXIMAL_DENSITY, Order, Points};

use crate::common::adaptive_oracle::{self as oracle, Ball, Field};
use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::triangle::{distance, exact};

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// A number for each vertex, by its position.
fn of_vertices(mesh: &Mesh, at: impl Fn([f64; 3]) -> f64) -> Vec<f32> {
    mesh.positions().iter().map(|position| at(position.map(f64::from)) as f32).collect()
}

/// The request.
#[derive(Clone, Copy)]
struct Case<'a> {
    mesh: &'a Arc<Mesh>,
    classes: &'a Classes,
    field: &'a Field<'a>,
    options: ClassOptions<'a>,
    masks: Option<&'a [u32]>,
}

impl<'a> Case<'a> {
    fn new(mesh: &'a Arc<Mesh>, classes: &'a Classes, field: &'a Field<'a>, radius: Radius<'a>) -> Self {
        Self { mesh, classes, field, options: ClassOptions::default().seed(3).unit(Some(radius)), masks: None }
    }

    fn sample_on(&self, threads: usize) -> Result<Points<3>, Error> {
        let context = Context::new(threads).unwrap();
        psp::sample_classes(&context, self.mesh, &self.options, self.classes, self.masks, None).map(|made| made.0)
    }

    /// The set, which is the same on one thread and on three, and keeps every promise.
    fn checked(&self) -> Points<3> {
        let set = self.sample_on(1).unwrap();
        assert_eq!(set, self.sample_on(3).unwrap(), "depends on the number of threads");
        assert_eq!([set.normals.len(), set.classes.len(), set.radii.len()], [set.len(); 3]);
        assert!(set.classes.is_sorted());
        if !matches!(self.field, Field::DensityPerVertex(_)) {
            assert_eq!(oracle::wrong_radius(self.mesh, self.field, &set, &set.radii), None);
        }
        assert_eq!(self.conflict(&set), None, "{:?}", self.classes);
        for class in 0..self.classes.count() {
            let gap = self.gap(&set, class, |i| self.classes.radius(set.classes[i] as usize, class));
            assert_eq!(gap, None, "class {class}: {:?}", self.classes);
        }
        if self.options.order == Order::Progressive {
            self.check_order(&set);
        }
        set
    }

    fn sees(&self, a: [f32; 3], b: [f32; 3]) -> bool {
        let ([a1, a2, a3], [b1, b2, b3]) = (exact(a), exact(b));
        self.options.cosine <= -1.0 || a == b || a1 * b1 + a2 * b2 + a3 * b3 >= self.options.cosine
    }

    /// Two samples that are too near to each other.
    fn conflict(&self, set: &Points<3>) -> Option<(usize, usize)> {
        let radius = |i: usize, j: usize| self.classes.radius(set.classes[i] as usize, set.classes[j] as usize);
        self.nearer(set, |i, j| radius(i, j) * ((set.radii[i] + set.radii[j]) / 2.0))
    }

    fn nearer(&self, set: &Points<3>, least: impl Fn(usize, usize) -> f64) -> Option<(usize, usize)> {
        let points: Vec<_> = set.positions.iter().map(|&position| exact(position)).collect();
        let near = |&(i, j): &(usize, usize)| {
            distance(points[i], points[j]) < least(i, j) && self.sees(set.normals[i], set.normals[j])
        };
        (0..set.len()).flat_map(|i| (0..i).map(move |j| (i, j))).find(near)
    }

    /// A place that a class could take, if samples cover it within these multiples of the mean of two radii.
    fn gap(&self, set: &Points<3>, class: usize, multiple: impl Fn(usize) -> f64) -> Option<[f64; 3]> {
        let (given, count) = (self.options.given, self.classes.count());
        let clearances: Vec<Ball> = given
            .positions
            .iter()
            .enumerate()
            .map(|(number, &position)| (exact(position), given.clearances.unwrap()[number * count + class]))
            .collect();
        let most = (0..set.len()).map(&multiple).fold(0.0, f64::max);
        let tolerance = oracle::tolerance(self.mesh, self.field, most);
        let allows = |triangle: u32| self.masks.is_none_or(|masks| masks[triangle as usize] >> class & 1 == 1);
        let cosine = self.options.cosine;
        oracle::gap_between(self.mesh, self.field, set, &set.radii, cosine, tolerance, &clearances, allows, multiple)
    }

    /// The ranks of each class fall, and all samples of a group up to a rank keep the promises of that rank.
    fn check_order(&self, set: &Points<3>) {
        let (class, rank) = (|i: usize| set.classes[i] as usize, |i: usize| f64::from(set.ranks[i]));
        let own = |i: usize| self.classes.own(class(i));
        for i in 0..set.len() {
            assert!(i == 0 || class(i - 1) != class(i) || rank(i - 1) >= rank(i), "ranks rise");
            assert!(rank(i) >= f64::from(own(i) as f32).next_down(), "a rank below the radius");
        }
        // An infinite rank says no more than that of the whole mesh.
        let (low, high) = self.mesh.bounds();
        let largest = distance(exact(low), exact(high)) / set.radii.iter().copied().fold(f64::INFINITY, f64::min);
        let conflict = self.nearer(set, |i, j| {
            let multiple = rank(i).min(rank(j)).min(largest) / own(i);
            let mean = (set.radii[i] + set.radii[j]) / 2.0;
            if own(i) == own(j) && rank(i).min(rank(j)).is_finite() {
                self.classes.radius(class(i), class(j)) * multiple * mean
            } else {
                0.0
            }
        });
        assert_eq!(conflict, None);
        for class_j in 0..self.classes.count() {
            let own_j = self.classes.own(class_j);
            let mut ranks: Vec<f64> = (0..set.len()).filter(|&i| own(i) == own_j).map(rank).collect();
            ranks.sort_by(|a, b| b.total_cmp(a));
            for count in [2, 5, 12, 40, 99, 100, 250].into_iter().filter(|&count| count <= ranks.len()) {
                let (last, quotient) = (ranks[count - 1], self.options.quotient);
                let loose = if count < 100 { 2f64.max(quotient * quotient) } else { quotient };
                let gap = self.gap(set, class_j, |i| {
                    let radius = self.classes.radius(class(i), class_j);
                    match own(i) {
                        larger if larger > own_j => radius,
                        equal if equal == own_j && rank(i) >= last => radius * loose * last / own_j,
                        _ => 0.0,
                    }
                });
                assert_eq!(gap, None, "the first {count} of class {class_j}");
            }
        }
    }
}

fn counts(set: &Points<3>, classes: usize) -> Vec<usize> {
    (0..classes).map(|i| set.classes.iter().filter(|&&class| class as usize == i).count()).collect()
}

/// Matrices of all kinds, with the smallest own radius 1: those of Wei, cross radii above own ones and below, equal own
/// radii and none equal.
fn matrices() -> Vec<Classes> {
    let wei = |own: &[f64], factor| Classes::of_radii(own, factor).unwrap();
    vec![
        wei(&[1.0], 1.0),
        wei(&[1.0, 1.0], 1.0),
        wei(&[1.0, 1.0, 1.0], 0.0),
        wei(&[4.0, 1.0, 2.0], 1.0),
        wei(&[1.0, 1.5, 1.0, 1.5, 1.1], 0.7),
        Classes::new(2, &[2.0, 2.0, 2.0, 1.0]).unwrap(),
        Classes::new(2, &[1.0, 9.0, 9.0, 1.0]).unwrap(),
        Classes::new(4, &[1.0, 0.3, 0.0, 0.9, 0.3, 1.0, 2.2, 0.3, 0.0, 2.2, 1.0, 0.5, 0.9, 0.3, 0.5, 1.0]).unwrap(),
    ]
}

/// Meshes, and a radius of which their classes have multiples.
fn awkward() -> Vec<(Soup, f64)> {
    let huge_and_tiny = meshes::join([meshes::plane(), meshes::placed(meshes::fine_torus(30, 20), 0.05, 0.3)]);
    vec![
        (meshes::plane(), 0.08),
        (meshes::fine_torus(40, 20), 0.3),
        (meshes::random_soup(5, 6), 0.12),
        (meshes::needles(1e-4), 0.04),
        (meshes::slivers(), 0.08),
        (meshes::sheets(0.02), 0.1),
        (huge_and_tiny, 0.1),
        (meshes::duplicated(meshes::book(4)), 0.15),
    ]
}

#[test]
fn every_matrix_on_awkward_meshes_keeps_all_distances_and_leaves_no_gap() {
    for (soup, radius) in awkward() {
        let mesh = mesh(soup);
        let radii = of_vertices(&mesh, |[x, y, z]| radius * (1.0 + 0.8 * (5.0 * (x + 2.0 * y + 3.0 * z)).sin()));
        let field = Field::PerVertex(&radii);
        for classes in matrices() {
            assert!(!Case::new(&mesh, &classes, &field, Radius::PerVertex(&radii)).checked().is_empty());
        }
    }
}

#[test]
fn every_seed_gives_another_good_set() {
    let mesh = mesh(meshes::torus());
    let radii = of_vertices(&mesh, |[x, ..]| if x < 0.0 { 0.1 } else { 0.4 });
    let (field, classes) = (Field::PerVertex(&radii), Classes::of_radii(&[2.0, 1.0, 1.0], 1.0).unwrap());
    let mut before = None;
    for seed in 0..20 {
        let case = Case::new(&mesh, &classes, &field, Radius::PerVertex(&radii));
        let set = Case { options: case.options.seed(seed), ..case }.checked();
        assert_ne!(Some(&set), before.as_ref());
        before = Some(set);
    }
}

/// By a function, and by a density: at the vertices, and at the right number of samples.
#[test]
fn functions_and_densities_are_followed() {
    let mesh = mesh(meshes::fine_torus(60, 30));
    let at = |[x, y, z]: [f64; 3]| 0.1 + 0.1 * (3.0 * x + 2.0 * y - z).sin().abs();
    let densities = of_vertices(&mesh, |[x, ..]| 20.0 * (x + 1.5).max(0.0).powi(2));
    let (by_function, by_density) = (Field::Function(&at, 0.38), Field::DensityPerVertex(&densities));
    let radius = Radius::Function { at: &at, smallest: 0.1, largest: 0.2, slope: 0.38 };
    let density = Density::PerVertex(&densities);
    for own in [&[1.0][..], &[2.0, 1.0], &[1.0, 1.0, 1.0]] {
        let classes = Classes::of_radii(own, 1.0).unwrap();
        Case::new(&mesh, &classes, &by_function, radius).checked();
        let scaled = Radius::Density { density, scale: Scale::Radius(1.0) };
        Case::new(&mesh, &classes, &by_density, scaled).checked();
    }
    let one = Classes::of_radii(&[1.0], 1.0).unwrap();
    let counted = Radius::Density { density, scale: Scale::Count(3000.0) };
    let count = Case::new(&mesh, &one, &by_density, counted).sample_on(2).unwrap().len();
    assert!((2700..3300).contains(&count), "{count}");
}

/// A radius of 1 everywhere gives classes what plain ones have.
#[test]
fn a_constant_unit_gives_the_shares_of_plain_classes() {
    let mesh = mesh(meshes::torus());
    let radii = vec![0.03; mesh.positions().len()];
    for own in [&[1.0][..], &[1.0, 1.0], &[4.0, 1.0, 2.0, 1.0]] {
        let classes = Classes::of_radii(own, 1.0).unwrap();
        let plain: Vec<f64> = classes.radii().iter().map(|radius| radius * f64::from(radii[0])).collect();
        let plain = Classes::new(own.len(), &plain).unwrap();
        for order in [Order::Any, Order::Progressive] {
            let context = Context::new(2).unwrap();
            let options = ClassOptions::default().order(order);
            let of = |options: ClassOptions, classes: &Classes| {
                counts(&psp::sample_classes(&context, &mesh, &options, classes, None, None).unwrap().0, own.len())
            };
            let varying = of(options.unit(Some(Radius::PerVertex(&radii))), &classes);
            for (varying, plain) in varying.into_iter().zip(of(options, &plain)) {
                let limit = 0.01 + 2.0 / (plain as f64).sqrt();
                assert!((varying as f64 / plain as f64 - 1.0).abs() < limit, "{order:?}: {varying} {plain}");
            }
        }
    }
}

#[test]
fn masks_given_samples_and_cosines_hold_where_radii_vary() {
    let (mut positions, mut triangles) = meshes::fine_torus(24, 12);
    let count = positions.len() as u32;
    positions.extend_from_within(..);
    positions[count as usize..].iter_mut().for_each(|position| position[2] += 0.01);
    triangles.extend_from_within(..);
    let half = triangles.len() / 2;
    triangles[half..].iter_mut().for_each(|[a, b, c]| (*a, *b, *c) = (*a + count, *c + count, *b + count));
    let mesh = mesh((positions, triangles));
    let masks: Vec<u32> =
        (0..mesh.triangles().len() as u32).map(|i| [0b111, 0b001, 0b010, 0b1_0000, 0][i as usize / 37 % 5]).collect();
    let radii = of_vertices(&mesh, |[x, ..]| 0.25 + 0.1 * x);
    let (field, classes) = (Field::PerVertex(&radii), Classes::of_radii(&[1.0, 1.0, 1.5], 1.0).unwrap());
    let given: Vec<[f32; 3]> = (0..20).map(|i| mesh.point(i * 17, [0.3, 0.4]).map(|x| x + 0.01)).collect();
    let clearances: Vec<f64> = (0..given.len() * 3).map(|i| [0.0, 0.01, 0.2, 0.35, 0.7][i * 7 % 5]).collect();
    let case = Case::new(&mesh, &classes, &field, Radius::PerVertex(&radii));
    let masked = Case { masks: Some(&masks), ..case }.checked();
    assert!((0..masked.len()).all(|i| masks[masked.triangles[i] as usize] >> masked.classes[i] & 1 == 1));
    let options = case.options.given(Given::with_clearances(&given, &clearances));
    let around = Case { options, ..case }.checked();
    for (i, &position) in around.positions.iter().enumerate() {
        for (number, &other) in given.iter().enumerate() {
            let clearance = clearances[number * 3 + around.classes[i] as usize];
            assert!(distance(exact(position), exact(other)) >= clearance);
        }
    }
    let sides = Case { options: case.options.cosine(0.0), ..case }.checked();
    assert!(2 * sides.len() > 3 * case.checked().len());
    let said = Case { options: case.options.given(Given::at(&given)), ..case }.sample_on(1).unwrap_err().to_string();
    assert!(said.starts_with("given_clearances: "), "{said}");
}

/// In progressive order each class is thinned by its ranks.
#[test]
fn every_class_is_thinned_by_its_ranks() {
    for (soup, radius) in [awkward().swap_remove(0), awkward().swap_remove(1), awkward().swap_remove(2)] {
        let mesh = mesh(soup);
        let radii = of_vertices(&mesh, |[x, y, z]| radius * (1.0 + 0.5 * (x + 2.0 * y + 3.0 * z).sin()));
        let field = Field::PerVertex(&radii);
        for own in [&[1.0][..], &[1.0, 1.0], &[2.0, 1.0]] {
            let classes = Classes::of_radii(own, 1.0).unwrap();
            let case = Case::new(&mesh, &classes, &field, Radius::PerVertex(&radii));
            Case { options: case.options.order(Order::Progressive), ..case }.checked();
        }
    }
}

/// A forest on a slope: two classes have their shares of the density in every band of it.
#[test]
fn a_ramp_of_density_is_met_in_every_band() {
    const BANDS: usize = 8;
    let columns = 128;
    let positions = (0..=columns).flat_map(|i| [0.0, 1.0].map(|y| [4.0 * i as f32 / columns as f32, y, 0.0])).collect();
    let triangles = (0..columns).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]]).collect();
    let mesh = mesh((positions, triangles));
    // The samples of one class of radius 1 on an area of 1.
    let density = |x: f64| 20_000.0 * (0.05 + 0.95 * x / 4.0);
    let densities = of_vertices(&mesh, |[x, ..]| density(x));
    let scale = Scale::Radius(MAXIMAL_DENSITY.sqrt());
    let radius = Radius::Density { density: Density::PerVertex(&densities), scale };
    let classes = Classes::of_radii(&[1.0, 1.0], 1.0).unwrap();
    let set = Case::new(&mesh, &classes, &Field::DensityPerVertex(&densities), radius).sample_on(2).unwrap();
    let (mut bands, margin) = ([[0.0; BANDS]; 2], 0.06);
    for (&[x, y, _], &class) in set.positions.iter().zip(&set.classes) {
        if (margin..1.0 - margin).contains(&y) {
            bands[class as usize][(x / 4.0 * BANDS as f32) as usize] += 1.0;
        }
    }
    for band in 1..BANDS - 1 {
        let width = 4.0 / BANDS as f64;
        let expected = 0.77 * density((band as f64 + 0.5) * width) * width * f64::from(1.0 - 2.0 * margin);
        for of_class in &bands {
            assert!((of_class[band] / expected - 1.0).abs() < 0.04, "band {band}: {} of {expected}", of_class[band]);
        }
    }
}

/// A rectangle of the plane is a mesh of two triangles, and an image its density: random places are covered for each
/// class, and all pairs keep their distances.
#[test]
fn a_rectangle_of_the_plane_follows_an_image() {
    let mesh = mesh(meshes::plane());
    let (values, width) = ([1.0f32, 4.0, 2.0, 9.0, 1.0, 3.0, 0.5, 2.0, 5.0], 3);
    let pixel = |[x, y]: [usize; 2]| f64::from(values[y * width + x]);
    // From the centre of the first pixel to that of the last.
    let texture = [[1.0 / 6.0, 1.0 / 6.0], [5.0 / 6.0, 1.0 / 6.0], [5.0 / 6.0, 5.0 / 6.0], [1.0 / 6.0, 5.0 / 6.0]];
    let (low, high) = mesh.bounds();
    let at = |position: [f32; 3]| {
        let place = [0, 1].map(|axis| 2.0 * f64::from((position[axis] - low[axis]) / (high[axis] - low[axis])));
        let (cell, [s, t]) = (place.map(|x| x.min(1.0).floor() as usize), place);
        let [s, t] = [s - cell[0] as f64, t - cell[1] as f64];
        let row = |y: usize| (1.0 - s) * pixel([cell[0], y]) + s * pixel([cell[0] + 1, y]);
        (1.0 - t) * row(cell[1]) + t * row(cell[1] + 1)
    };
    let places: Vec<[f32; 2]> = mesh
        .positions()
        .iter()
        .map(|position| {
            let corner = [0, 1].map(|axis| usize::from(position[axis] > (low[axis] + high[axis]) / 2.0));
            texture[[[0, 1], [3, 2]][corner[1]][corner[0]]]
        })
        .collect();
    let density = Density::Image { values: &values, width, height: 3, texture: Texture::PerVertex(&places) };
    let (radius, none) = (0.1, Field::PerVertex(&[]));
    let unit = Radius::Density { density, scale: Scale::Radius(radius) };
    for own in [&[1.0, 1.0][..], &[3.0, 1.0, 2.0]] {
        let classes = Classes::of_radii(own, 1.0).unwrap();
        let case = Case::new(&mesh, &classes, &none, unit);
        let set = case.sample_on(1).unwrap();
        assert_eq!(set, case.sample_on(3).unwrap());
        assert_eq!(case.conflict(&set), None);
        let mut random = Random::new(5);
        for _ in 0..3000 {
            let place = [0, 1, 2].map(|axis| low[axis] + random.unit() * (high[axis] - low[axis]));
            let local = radius / at(place).sqrt();
            for class in 0..classes.count() {
                let covers = |i: usize| {
                    let within = classes.radius(class, set.classes[i] as usize) * ((local + set.radii[i]) / 2.0);
                    distance(exact(place), exact(set.positions[i])) <= within + 1e-6
                };
                assert!((0..set.len()).any(covers), "{place:?} takes class {class}");
            }
        }
    }
}

#[test]
fn units_that_are_no_radii_are_refused() {
    let mesh = mesh(meshes::plane());
    let (classes, none) = (Classes::of_radii(&[0.5, 1.0], 1.0).unwrap(), Field::PerVertex(&[]));
    let said = |radius| Case::new(&mesh, &classes, &none, radius).sample_on(1).unwrap_err().to_string();
    assert!(said(Radius::PerVertex(&[0.1; 3])).starts_with("vertex_count: "));
    assert!(said(Radius::PerVertex(&[0.1, 0.1, 0.0, 0.1])).starts_with("vertex_radii: vertex 2"));
    assert!(said(Radius::PerVertex(&[1e-6; 4])).starts_with("vertex_radii: "));
    let of = |at, slope| Radius::Function { at, smallest: 0.05, largest: 0.1, slope };
    assert!(said(of(&|_| 1.0, 0.0)).starts_with("radius_function: 1.0 at "));
    assert!(said(of(&|[x, ..]| 0.05 + 0.05 * x, 0.001)).starts_with("radius_function: "));
    assert!(said(of(&|_| 0.1, f64::NAN)).starts_with("slope: "));
    let scale = Scale::Radius(0.1);
    assert!(said(Radius::Density { density: Density::PerVertex(&[0.0; 4]), scale }).starts_with("density: "));
    let density = Density::PerVertex(&[1.0; 4]);
    assert!(said(Radius::Density { density, scale: Scale::Count(0.0) }).starts_with("count: "));
    assert!(said(Radius::Density { density, scale: Scale::Count(1e15) }).starts_with("count: "));
}

#[test]
fn the_checkers_see_what_is_wrong() {
    let mesh = mesh(meshes::torus());
    let radii = of_vertices(&mesh, |[x, ..]| 0.3 + 0.1 * x);
    let (field, classes) = (Field::PerVertex(&radii), Classes::of_radii(&[1.0, 1.0], 1.0).unwrap());
    let case = Case::new(&mesh, &classes, &field, Radius::PerVertex(&radii));
    let good = case.checked();
    for i in (0..good.len()).step_by(17) {
        let mut less = good.clone();
        for all in [&mut less.positions, &mut less.normals] {
            all.remove(i);
        }
        less.radii.remove(i);
        less.classes.remove(i);
        let gap = |class| case.gap(&less, class, |i| classes.radius(less.classes[i] as usize, class));
        assert!(gap(good.classes[i] as usize).is_some(), "a gap is not seen");
        let mut near = good.clone();
        near.radii[i] *= 2.0;
        assert!(case.conflict(&near).is_some(), "a conflict is not seen");
    }
}
