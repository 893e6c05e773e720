//! Several classes on a mesh, held against their definition by plain checkers: all pairs, and for each class the whole
//! surface.

use std::ops::ControlFlow;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, ClassOptions, DEFAULT_QUOTIENT, Options};
use azulejo::{Classes, Context, Error, Given, Order, Points};

use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::surface_oracle::gap_in_part;
use crate::common::tolerance::tolerance;
use crate::common::triangle::{distance, exact, has_area, normal};

type Point = [f64; 3];

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// The request.
#[derive(Clone, Copy)]
struct Case<'a> {
    mesh: &'a Arc<Mesh>,
    classes: &'a Classes,
    options: ClassOptions<'a>,
    masks: Option<&'a [u32]>,
    /// The mesh's own.
    own_mask: Option<&'a [bool]>,
}

impl<'a> Case<'a> {
    fn new(mesh: &'a Arc<Mesh>, classes: &'a Classes) -> Self {
        Self { mesh, classes, options: ClassOptions::default().seed(3), masks: None, own_mask: None }
    }

    fn sample_on(&self, threads: usize) -> Result<Points<3>, Error> {
        let context = Context::new(threads).unwrap();
        let (samples, report) =
            psp::sample_classes(&context, self.mesh, &self.options, self.classes, self.masks, None)?;
        assert_eq!((report.samples, report.darts), (samples.len() as u64, report.accepted + report.conflicts));
        Ok(samples)
    }

    /// The set, which is the same on one thread and on three, and keeps every promise.
    fn checked(&self) -> Points<3> {
        let samples = self.sample_on(1).unwrap();
        assert_eq!(samples, self.sample_on(3).unwrap(), "depends on the number of threads");
        assert_eq!([samples.positions.len(), samples.normals.len(), samples.classes.len()], [samples.len(); 3]);
        self.check(&samples);
        samples
    }

    fn allows(&self, class: usize, triangle: u32) -> bool {
        let by_mask = self.masks.is_none_or(|masks| masks[triangle as usize] >> class & 1 == 1);
        by_mask && self.own_mask.is_none_or(|mask| mask[triangle as usize])
    }

    fn sees(&self, a: [f32; 3], b: [f32; 3]) -> bool {
        let ([a1, a2, a3], [b1, b2, b3]) = (exact(a), exact(b));
        self.options.cosine <= -1.0 || a == b || a1 * b1 + a2 * b2 + a3 * b3 >= self.options.cosine
    }

    fn clearance(&self, given: usize, class: usize) -> f64 {
        let count = self.classes.count();
        self.options.given.clearances.map_or(self.classes.own(class), |clearances| clearances[given * count + class])
    }

    fn check(&self, samples: &Points<3>) {
        let class = |i: usize| samples.classes[i] as usize;
        assert!(samples.classes.is_sorted() && samples.classes.iter().all(|&i| (i as usize) < self.classes.count()));
        let points: Vec<Point> = samples.positions.iter().map(|&position| exact(position)).collect();
        for i in 0..points.len() {
            assert!(self.allows(class(i), samples.triangles[i]), "a class stands where it may not");
            let [a, b, c] = self.mesh.corners(samples.triangles[i]).map(exact);
            let [u, v] = samples.barycentrics[i].map(f64::from);
            let place = std::array::from_fn(|axis| ((1.0 - u - v) * a[axis] + u * b[axis] + v * c[axis]) as f32);
            assert_eq!(samples.positions[i], place);
            for j in (0..i).filter(|&j| self.sees(samples.normals[i], samples.normals[j])) {
                let (near, radius) = (distance(points[i], points[j]), self.classes.radius(class(i), class(j)));
                assert!(near >= radius, "{near} of classes {} and {}, radius {radius}", class(i), class(j));
            }
            for (given, &position) in self.options.given.positions.iter().enumerate() {
                assert!(distance(points[i], exact(position)) >= self.clearance(given, class(i)));
            }
        }
        for class_j in 0..self.classes.count() {
            self.check_covered(samples, class_j, |i| self.classes.radius(class(i), class_j));
        }
    }

    /// Every place where a class may stand is within the radius of a sample, or the clearance of a given one.
    fn check_covered(&self, samples: &Points<3>, class: usize, radius: impl Fn(usize) -> f64) {
        let tolerance = tolerance(self.mesh);
        for triangle in (0..self.mesh.triangles().len() as u32).filter(|&triangle| self.allows(class, triangle)) {
            let corners = self.mesh.corners(triangle).map(exact);
            if !has_area(corners) {
                continue;
            }
            let normal = normal(self.mesh, triangle);
            let ball = |i: usize| (exact(samples.positions[i]), radius(i));
            let seen = |&i: &usize| self.sees(samples.normals[i], normal);
            let mut balls: Vec<_> = (0..samples.len()).filter(seen).map(ball).collect();
            let given = self.options.given.positions.iter().enumerate();
            balls.extend(given.map(|(given, &position)| (exact(position), self.clearance(given, class))));
            balls.retain(|ball| ball.1 > 0.0);
            balls.iter_mut().for_each(|ball| ball.1 += tolerance);
            let gap = gap_in_part(corners, &balls, tolerance / 100.0);
            assert_eq!(gap, None, "class {class}, triangle {triangle}: {:?}", self.classes);
        }
    }

    /// The ranks of each class fall, and all samples of a group up to a rank keep the promises of that rank.
    fn check_order(&self, samples: &Points<3>) {
        let (class, rank) = (|i: usize| samples.classes[i] as usize, |i: usize| f64::from(samples.ranks[i]));
        let (low, high) = self.mesh.bounds();
        let diagonal = distance(exact(low), exact(high));
        let is_grouped = |i: usize, j: usize| self.classes.own(class(i)) == self.classes.own(class(j));
        for i in 0..samples.len() {
            assert!(i == 0 || class(i - 1) != class(i) || rank(i - 1) >= rank(i), "ranks rise");
            assert!(rank(i) >= f64::from(self.classes.own(class(i)) as f32).next_down(), "a rank below the radius");
            for j in (0..i).filter(|&j| is_grouped(i, j) && self.sees(samples.normals[i], samples.normals[j])) {
                let near = distance(exact(samples.positions[i]), exact(samples.positions[j]));
                let multiple = rank(i).min(rank(j)).min(diagonal) / self.classes.own(class(i));
                let radius = self.classes.radius(class(i), class(j)) * multiple;
                assert!(near >= radius, "{near}, {radius}");
                assert!(class(i) != class(j) || near >= rank(i).min(rank(j)));
            }
        }
        for class_j in 0..self.classes.count() {
            let own = self.classes.own(class_j);
            let mut ranks: Vec<f64> =
                (0..samples.len()).filter(|&i| self.classes.own(class(i)) == own).map(rank).collect();
            ranks.sort_by(|a, b| b.total_cmp(a));
            for count in [2, 5, 12, 40, 99, 100, 250].into_iter().filter(|&count| count <= ranks.len()) {
                let last = ranks[count - 1];
                let quotient = self.options.quotient;
                let loose = if count < 100 { 2f64.max(quotient * quotient) } else { quotient };
                self.check_covered(samples, class_j, |i| {
                    let radius = self.classes.radius(class(i), class_j);
                    match self.classes.own(class(i)) {
                        larger if larger > own => radius,
                        equal if equal == own && rank(i) >= last => radius * loose * last / own,
                        _ => 0.0,
                    }
                });
            }
        }
    }
}

fn counts(samples: &Points<3>, classes: usize) -> Vec<usize> {
    (0..classes).map(|i| samples.classes.iter().filter(|&&class| class as usize == i).count()).collect()
}

/// Matrices of all kinds, with the smallest own radius 1: those of Wei with several factors, cross radii above own ones,
/// equal own radii and none equal, and such as no rule makes.
fn matrices() -> Vec<Classes> {
    let wei = |own: &[f64], factor| Classes::of_radii(own, factor).unwrap();
    vec![
        wei(&[1.0], 1.0),
        wei(&[1.0, 1.0], 1.0),
        wei(&[1.0, 2.0], 0.7),
        wei(&[1.0, 1.0, 1.0], 0.0),
        wei(&[4.0, 1.0, 2.0], 1.0),
        wei(&[1.0, 1.5, 1.0, 1.5, 1.1], 1.0),
        wei(&[1.0; 8], 1.0),
        wei(&[1.0, 2.0, 1.0, 2.5, 1.0, 2.0, 1.0, 1.0], 0.7),
        // The larger of two own radii, and more.
        Classes::new(2, &[2.0, 2.0, 2.0, 1.0]).unwrap(),
        Classes::new(3, &[1.0, 1.0, 3.0, 1.0, 1.0, 0.0, 3.0, 0.0, 2.0]).unwrap(),
        // Each pair as it likes, in one group.
        Classes::new(4, &[1.0, 0.3, 0.0, 0.9, 0.3, 1.0, 2.2, 0.3, 0.0, 2.2, 1.0, 0.5, 0.9, 0.3, 0.5, 1.0]).unwrap(),
    ]
}

fn scaled(classes: &Classes, unit: f64) -> Classes {
    let radii: Vec<f64> = classes.radii().iter().map(|radius| radius * unit).collect();
    Classes::new(classes.count(), &radii).unwrap()
}

#[test]
fn every_matrix_on_awkward_meshes_keeps_all_distances_and_leaves_no_gap() {
    // Six squares that share no vertex.
    let unwelded_cube = || {
        meshes::join((0..6).map(|side| {
            let (mut square, triangles) = meshes::plane();
            for position in &mut square {
                position[2] = (side / 3) as f32;
                position.rotate_right(side % 3);
            }
            (square, triangles)
        }))
    };
    let huge_and_tiny = || meshes::join([meshes::plane(), meshes::placed(meshes::fine_torus(30, 20), 0.05, 0.3)]);
    let soups: [(Soup, f64); 9] = [
        // Triangles that are small beside all radii but few.
        (meshes::fine_torus(60, 30), 0.4),
        (meshes::random_soup(5, 6), 0.15),
        (meshes::needles(1e-4), 0.04),
        (meshes::slivers(), 0.1),
        (meshes::sheets(0.02), 0.12),
        (unwelded_cube(), 0.2),
        (huge_and_tiny(), 0.1),
        (meshes::duplicated(meshes::book(4)), 0.2),
        (meshes::placed(meshes::plane(), 1e-20, 3e-20), 0.1e-20),
    ];
    for (soup, radius) in soups {
        let mesh = mesh(soup);
        for classes in matrices() {
            let classes = scaled(&classes, radius);
            assert!(!Case::new(&mesh, &classes).checked().is_empty());
        }
    }
}

/// The samples of a case, by cells in which all that is near to a point is found.
struct Near<'a> {
    classes: &'a Classes,
    samples: &'a Points<3>,
    points: Vec<Point>,
    width: f64,
    cells: std::collections::HashMap<[i32; 3], Vec<usize>>,
}

impl<'a> Near<'a> {
    fn new(classes: &'a Classes, samples: &'a Points<3>) -> Self {
        let width = classes.radii().iter().copied().fold(0.0, f64::max);
        let points: Vec<Point> = samples.positions.iter().map(|&position| exact(position)).collect();
        let mut cells = std::collections::HashMap::<[i32; 3], Vec<usize>>::new();
        (0..points.len()).for_each(|i| cells.entry(points[i].map(|x| (x / width).floor() as i32)).or_default().push(i));
        Self { classes, samples, points, width, cells }
    }

    fn around(&self, point: Point) -> impl Iterator<Item = usize> {
        let [x, y, z] = point.map(|x| (x / self.width).floor() as i32);
        let near = (0..27).map(move |n| [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]);
        near.filter_map(|cell| self.cells.get(&cell)).flatten().copied()
    }

    fn class(&self, i: usize) -> usize {
        self.samples.classes[i] as usize
    }

    fn check_distances(&self) {
        let radius = |i: usize, j: usize| self.classes.radius(self.class(i), self.class(j));
        for (i, &point) in self.points.iter().enumerate() {
            let is_far = |j: usize| i == j || distance(point, self.points[j]) >= radius(i, j);
            assert!(self.around(point).all(is_far), "{:?}: {point:?}", self.classes);
        }
    }

    /// A class, and a triangle that it could not be proved to cover.
    fn gap(&self, mesh: &Mesh) -> Option<(usize, u32)> {
        let tolerance = tolerance(mesh);
        (0..mesh.triangles().len() as u32).find_map(|triangle| {
            let corners = mesh.corners(triangle).map(exact);
            let near = self.in_box(&corners);
            let is_open = |&class: &usize| {
                let reach = |i: usize| self.classes.radius(self.class(i), class) + tolerance;
                let balls: Vec<_> = near.iter().map(|&i| (self.points[i], reach(i))).collect();
                gap_in_part(corners, &balls, tolerance / 100.0).is_some()
            };
            (0..self.classes.count()).find(is_open).map(|class| (class, triangle))
        })
    }

    /// The samples in the cells of a triangle's box and in those beside them.
    fn in_box(&self, corners: &[Point; 3]) -> Vec<usize> {
        let [low, high] = [f64::min, f64::max].map(|pick| {
            [0, 1, 2].map(|axis| {
                corners.map(|corner| (corner[axis] / self.width).floor()).into_iter().reduce(pick).unwrap() as i32
            })
        });
        let along = |axis: usize| low[axis] - 1..=high[axis] + 1;
        let cells = along(0).flat_map(|x| along(1).flat_map(move |y| along(2).map(move |z| [x, y, z])));
        cells.filter_map(|cell| self.cells.get(&cell)).flatten().copied().collect()
    }
}

/// So many samples that cubes are filled by themselves.
#[test]
fn many_samples_are_filled_by_cubes() {
    let mesh = mesh(meshes::torus());
    for (number, classes) in matrices().into_iter().enumerate() {
        let classes = scaled(&classes, 0.014);
        let case = Case::new(&mesh, &classes);
        let mut samples = case.sample_on(1 + number % 2).unwrap();
        assert!(number % 4 != 3 || samples == case.sample_on(1).unwrap());
        let near = Near::new(&classes, &samples);
        near.check_distances();
        assert_eq!(near.gap(&mesh), None, "{classes:?}");
        if number == 0 {
            // One of them all that is missing is noticed.
            samples.positions.pop();
            assert!(Near::new(&classes, &samples).gap(&mesh).is_some());
        }
    }
}

/// Triangles that are small beside the radii are filled as wholes: a few that are forgotten leave few gaps, none of them
/// larger than a triangle.
#[test]
fn no_small_triangle_is_forgotten() {
    let mesh = mesh(meshes::fine_torus(300, 150));
    let longest = mesh.triangles().iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| exact(mesh.positions()[vertex as usize]));
        distance(a, b).max(distance(b, c)).max(distance(c, a))
    });
    let radius = 2.1 * longest.fold(0.0, f64::max);
    for own in [&[1.0, 1.0][..], &[1.5, 1.0, 1.0, 1.0], &[2.0, 1.0]] {
        let classes = scaled(&Classes::of_radii(own, 1.0).unwrap(), radius);
        let samples = Case::new(&mesh, &classes).sample_on(1).unwrap();
        let near = Near::new(&classes, &samples);
        near.check_distances();
        assert_eq!(near.gap(&mesh), None, "{classes:?}");
    }
}

/// A class at a time may be kept off a triangle, by its own mask and by that of the mesh.
#[test]
fn masks_say_where_a_class_stands() {
    let (positions, triangles) = meshes::torus();
    let masks: Vec<u32> =
        (0..triangles.len() as u32).map(|i| [0b111, 0b001, 0b010, 0b1_0000, 0][i as usize / 37 % 5]).collect();
    let own_mask: Vec<bool> = (0..triangles.len()).map(|i| i % 11 != 3).collect();
    let bare = mesh((positions.clone(), triangles.clone()));
    let masked = Arc::new(Mesh::new(positions, triangles).unwrap().with_mask(own_mask.clone()).unwrap());
    for (mesh, own_mask) in [(&bare, None), (&masked, Some(&own_mask[..]))] {
        for own in [[0.2, 0.2, 0.2], [0.4, 0.2, 0.3]] {
            let classes = Classes::of_radii(&own, 1.0).unwrap();
            let samples = Case { masks: Some(&masks), own_mask, ..Case::new(mesh, &classes) }.checked();
            let counts = counts(&samples, 3);
            assert!(counts[0] > 0 && counts[1] > 0 && counts[2] > 0, "{counts:?}");
            let nowhere = vec![0b011; masks.len()];
            let without = Case { masks: Some(&nowhere), own_mask, ..Case::new(mesh, &classes) }.checked();
            assert!(without.classes.iter().all(|&class| class < 2));
        }
    }
    // In cubes.
    let classes = Classes::of_radii(&[0.016, 0.016, 0.016], 1.0).unwrap();
    let [one, two] =
        [1, 2].map(|threads| Case { masks: Some(&masks), ..Case::new(&bare, &classes) }.sample_on(threads));
    let (one, two) = (one.unwrap(), two.unwrap());
    assert_eq!(one, two);
    assert!((0..one.len()).all(|i| masks[one.triangles[i] as usize] >> one.classes[i] & 1 == 1));
    let nowhere = vec![0; masks.len()];
    assert!(Case { masks: Some(&nowhere), ..Case::new(&bare, &classes) }.checked().is_empty());
}

#[test]
fn given_samples_keep_their_clearance_from_each_class() {
    let mesh = mesh(meshes::torus());
    let mut random = Random::new(8);
    let positions: Vec<[f32; 3]> = (0..40)
        .map(|_| {
            let triangle = (random.unit() * mesh.triangles().len() as f32) as u32;
            mesh.point(triangle, [0.3, 0.4]).map(|x| x + 0.1 * (random.unit() - 0.5))
        })
        .collect();
    for own in [&[0.3, 0.3][..], &[0.2, 0.4, 0.3]] {
        let classes = Classes::of_radii(own, 1.0).unwrap();
        let clearances: Vec<f64> =
            (0..positions.len() * own.len()).map(|i| [0.0, 0.01, 0.2, 0.35, 0.7][i * 7 % 5]).collect();
        for given in [Given::at(&positions), Given::with_clearances(&positions, &clearances)] {
            let case = Case::new(&mesh, &classes);
            Case { options: case.options.given(given), ..case }.checked();
        }
    }
}

#[test]
fn the_sides_of_a_wall_ignore_each_other_where_a_cosine_says_so() {
    let (mut soup, mut turned) = (meshes::plane(), meshes::plane());
    turned.1.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    turned.0.iter_mut().for_each(|position| position[2] = -0.01);
    soup = meshes::join([soup, turned]);
    let mesh = mesh(soup);
    let classes = Classes::of_radii(&[0.2, 0.1, 0.1], 1.0).unwrap();
    let case = Case::new(&mesh, &classes);
    let thick = Case { options: case.options.cosine(0.0), ..case }.checked();
    assert!(2 * thick.len() > 3 * case.checked().len());
}

/// In progressive order a set is one of classes as any other, with the same shares, and each class is thinned by its
/// ranks.
#[test]
fn every_class_is_thinned_by_its_ranks() {
    let soups: [(Soup, f64); 4] = [
        (meshes::plane(), 0.07),
        (meshes::fine_torus(24, 12), 0.4),
        (meshes::random_soup(5, 6), 0.15),
        (meshes::sheets(0.02), 0.12),
    ];
    for (number, (soup, radius)) in soups.into_iter().enumerate() {
        let mesh = mesh(soup);
        let masks: Vec<u32> =
            (0..mesh.triangles().len() as u32).map(|i| [u32::MAX, 0b10, u32::MAX][i as usize % 3]).collect();
        let positions = [mesh.positions()[0], mesh.positions()[1]];
        for (quotient, classes) in [DEFAULT_QUOTIENT, 1.4].into_iter().cycle().zip(matrices()) {
            let classes = scaled(&classes, radius);
            let options = ClassOptions::default().seed(5).order(Order::Progressive).quotient(quotient);
            let options = if number == 1 { options.given(Given::at(&positions)) } else { options };
            let masks = (number == 2).then_some(&masks[..]);
            let case = Case { options, masks, ..Case::new(&mesh, &classes) };
            let samples = case.checked();
            assert_eq!(samples.ranks.len(), samples.len());
            case.check_order(&samples);
        }
    }
}

/// Classes of larger radii have as many samples as without an order, in one piece and in cubes.
#[test]
fn an_order_changes_the_shares_of_classes_little() {
    let mesh = mesh(meshes::torus());
    for unit in [0.05, 0.014] {
        let classes = scaled(&Classes::of_radii(&[4.0, 1.0, 2.0, 1.0], 1.0).unwrap(), unit);
        let of = |order| Case { options: ClassOptions::default().order(order), ..Case::new(&mesh, &classes) };
        let [any, ordered] = [Order::Any, Order::Progressive].map(|order| of(order).sample_on(2).unwrap());
        assert_eq!(ordered, of(Order::Progressive).sample_on(1).unwrap());
        let near = Near::new(&classes, &ordered);
        near.check_distances();
        assert_eq!(near.gap(&mesh), None);
        for (any, ordered) in counts(&any, 4).into_iter().zip(counts(&ordered, 4)) {
            // Nested maximal sets are sparser than others.
            assert!((0.88..1.04).contains(&(ordered as f64 / any as f64)), "{any} {ordered}");
        }
    }
}

/// No class of a group has an advantage, wherever it is in the matrix, in one piece and in cubes.
#[test]
fn equal_radii_have_equal_shares() {
    let mesh = mesh(meshes::torus());
    for (radius, seeds) in [(0.05, 12), (0.012, 2)] {
        for count in [2, 3, 8] {
            let classes = Classes::of_radii(&vec![radius; count], 1.0).unwrap();
            let mut totals = vec![0; count];
            for seed in 0..seeds {
                let samples = Case { options: ClassOptions::default().seed(seed), ..Case::new(&mesh, &classes) };
                let samples = counts(&samples.sample_on(2).unwrap(), count);
                totals.iter_mut().zip(samples).for_each(|(total, count)| *total += count);
            }
            let mean = totals.iter().sum::<usize>() as f64 / count as f64;
            for total in &totals {
                // Counts scatter by less than their root.
                assert!((*total as f64 - mean).abs() < 3.0 * mean.sqrt(), "{totals:?}");
            }
        }
    }
}

/// One class is a maximal set as any other, and the first class takes what it would have alone.
#[test]
fn large_classes_come_first() {
    let mesh = mesh(meshes::torus());
    let context = Context::new(2).unwrap();
    let alone = |radius| psp::sample(&context, &mesh, &Options::new(radius), None).unwrap().0.len() as f64;
    let (large, small) = (alone(0.1), alone(0.05));
    let one = Classes::of_radii(&[0.1], 1.0).unwrap();
    let two = Classes::of_radii(&[0.05, 0.1], 1.0).unwrap();
    let one = Case::new(&mesh, &one).sample_on(2).unwrap().len() as f64;
    let two = counts(&Case::new(&mesh, &two).sample_on(2).unwrap(), 2);
    assert!((one / large - 1.0).abs() < 0.02 && (two[1] as f64 / large - 1.0).abs() < 0.02, "{one} {two:?} {large}");
    let share = two[0] as f64 / small;
    assert!((0.75..0.95).contains(&share), "{share}");
}

#[test]
fn what_does_not_go_with_classes_is_refused() {
    let mesh = mesh(meshes::plane());
    let classes = Classes::of_radii(&[0.2, 0.1], 1.0).unwrap();
    let case = Case::new(&mesh, &classes);
    let said = |options| Case { options, ..case }.sample_on(1).unwrap_err().to_string();
    let options = ClassOptions::default();
    assert!(said(options.cosine(2.0)).starts_with("cosine: "));
    let positions = [[0.0; 3], [f32::NAN, 0.0, 0.0]];
    assert!(said(options.given(Given::at(&positions))).starts_with("given_positions: [1]"));
    let with = |clearances| said(options.given(Given::with_clearances(&positions[..1], clearances)));
    assert_eq!(with(&[0.1]), "given_clearances: 1 for 1 positions and 2 classes");
    assert_eq!(with(&[0.1, -1.0]), "given_clearances: [1] is -1.0; it must be 0 or more and finite");
    let masks = Case { masks: Some(&[3]), ..case }.sample_on(1).unwrap_err().to_string();
    assert_eq!(masks, "mask_count: 1 masks for 2 triangles");
    let said = |classes: &Classes| Case::new(&mesh, classes).sample_on(1).unwrap_err().to_string();
    assert!(said(&Classes::of_radii(&[1.0, 1.0], 1e-7).unwrap()).starts_with("radii: "));
    assert!(said(&Classes::of_radii(&[1e-5; 16], 1.0).unwrap()).starts_with("radii: "));
    // Nothing is returned of a call that is cancelled.
    let cancelled = psp::sample_classes(
        &Context::new(1).unwrap(),
        &mesh,
        &options,
        &classes,
        None,
        Some(&|_| ControlFlow::Break(())),
    );
    assert!(matches!(cancelled, Err(Error::Cancelled)));
}
