//! Procedural triangle soups for the tests: shapes of the command-line tool, and worse.

#[path = "../../../cli/src/procedural/shapes.rs"]
mod shapes;

pub use shapes::*;

/// The unit square at height 0, as two triangles.
pub fn plane() -> Soup {
    shapes::patch(1, 1, |x, y| [x, y, 0.0])
}

/// A sphere of radius 1; the triangles at the poles have no area.
pub fn sphere() -> Soup {
    shapes::sphere(48)
}

/// A torus of radii 1 and 0.4.
pub fn torus() -> Soup {
    fine_torus(40, 20)
}

/// The same with coordinates on a lattice of 2^-18, so that the seams of a shape meet.
pub fn welded((mut positions, triangles): Soup) -> Soup {
    let scale = (1 << 18) as f32;
    positions.iter_mut().for_each(|p| *p = p.map(|x| (x * scale).round() / scale + 0.0));
    (positions, triangles)
}

/// The torus, of as many quads around the hole and around the tube.
pub fn fine_torus(around_hole: u32, around_tube: u32) -> Soup {
    shapes::torus(around_hole, around_tube)
}

/// Two parallel unit squares, this far apart.
pub fn sheets(distance: f32) -> Soup {
    let (low, mut high) = (plane(), plane());
    high.0.iter_mut().for_each(|position| position[2] = distance);
    join([low, high])
}

/// A triangle of length 1 and width `aspect`, askew in space, and a second one across it.
pub fn needles(aspect: f32) -> Soup {
    let positions = vec![
        [0.0, 0.0, 0.0],
        [0.6, 0.64, 0.48],
        [0.3 + aspect, 0.32, 0.24 - aspect],
        [0.5, 0.0, 0.1],
        [0.1, 0.7, 0.4],
        [0.1, 0.7 + aspect, 0.4],
    ];
    (positions, vec![[0, 1, 2], [3, 4, 5]])
}

/// A book: so many pages on one edge, and as many leaves that touch its end with a corner.
pub fn book(pages: u32) -> Soup {
    let mut soup: Soup = (vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]], vec![]);
    for page in 0..pages {
        let (sin, cos) = (page as f32 * 0.9).sin_cos();
        let first = soup.0.len() as u32;
        soup.0.extend([[cos, sin, 0.4], [0.5 * cos, 0.5 * sin, 1.6], [0.4 * sin, -0.4 * cos, 1.5]]);
        soup.1.extend([[0, first, 1], [1, first + 1, first + 2]]);
    }
    soup
}

/// A strip of slivers: triangles of length 1 whose third corner is near the middle of the longest edge (a cap) or near one
/// of its ends (a blade), from a tenth down to 10^-7 of the length in height.
pub fn slivers() -> Soup {
    let sliver = |i: i32| {
        let (height, y) = (10f32.powi(-1 - i / 2), 0.015 * i as f32);
        let foot = if i % 2 == 0 { 0.47 } else { height };
        (vec![[0.0, y, 0.0], [1.0, y, 0.3], [foot, y + 0.7 * height, 0.3 * foot + height]], vec![[0, 1, 2]])
    };
    join((0..14).map(sliver))
}

/// Triangles of random corners in the unit cube: they cross each other, and nothing is closed.
pub fn random_soup(seed: u64, triangles: u32) -> Soup {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 24) as f32
    };
    let positions = (0..3 * triangles).map(|_| [random(), random(), random()]).collect();
    (positions, (0..triangles).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
}

/// Every face twice more, once of them turned over.
pub fn duplicated((positions, mut triangles): Soup) -> Soup {
    let turned: Vec<_> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    triangles.extend(triangles.clone());
    triangles.extend(turned);
    (positions, triangles)
}

/// Scaled, then moved along all axes.
pub fn placed((mut positions, triangles): Soup, scale: f64, offset: f64) -> Soup {
    positions.iter_mut().for_each(|position| *position = position.map(|x| (x as f64 * scale + offset) as f32));
    (positions, triangles)
}
