//! Filling a part of the surface by itself: the first darts, what they leave open, and the rounds.

use crate::mesh::Mesh;
use crate::psp::fill::darts::{Rain, random_point, shuffle};
use crate::psp::fill::ground::{Ground, Point, UniformGround};
use crate::psp::fill::items::ItemRow;
use crate::psp::fill::page::{GROUP, Group};
use crate::psp::fill::rounds::{Open, PATCH, WHOLE, throw};
use crate::psp::fill::triangles::Triangles;
use crate::psp::fragment::Fragment;
use crate::psp::pieces::slice;
use crate::rng::Rng;

/// The first darts on an empty surface, for each squared radius: about six for each sample that will stand there. They
/// are cheap, as nothing but the triangle that they fall on is known of them, and leave little of the surface open.
pub(in crate::psp) const FIRST_DARTS: f64 = 4.2;

/// On which of some groups of triangles the first darts fall as rain, in order. Of groups that stay dry only the area
/// is needed.
pub(in crate::psp) fn first_darts(
    mesh: &Mesh,
    radius: f64,
    triangles: Triangles,
    groups: impl Iterator<Item = (usize, f64)>,
    rng: &mut Rng,
) -> Vec<u32> {
    let (mut darts, mut rain) = (Vec::new(), Rain::new(rng, FIRST_DARTS / (radius * radius)));
    for (group, area) in groups {
        if !rain.passes(area) {
            let (areas, _) = triangles.measure(mesh, group);
            for (index, area) in triangles.group(group).zip(areas) {
                darts.extend(std::iter::repeat_n(index as u32, rain.fall(area)));
            }
        }
    }
    darts
}

/// Throws the first darts at triangles on which they fall.
pub(in crate::psp) fn throw_at(ground: &mut UniformGround, triangles: Triangles, mut darts: Vec<u32>, rng: &mut Rng) {
    shuffle(rng, &mut darts);
    let mut point =
        |index: u32| Point { triangle: triangles.at(index as usize), barycentrics: random_point(rng), local: () };
    throw(ground, darts.iter().map(|&index| point(index)));
}

/// Throws the first darts at all of some items.
pub(in crate::psp) fn throw_first(ground: &mut UniformGround, row: &mut ItemRow, rng: &mut Rng) {
    let radius = ground.radius();
    let darts = (FIRST_DARTS * row.total() / (radius * radius) + rng.unit()) as usize;
    throw(ground, (0..darts).map(|_| row.point(rng)));
}

/// What is open of some triangles, by their indices.
pub(in crate::psp) fn open_triangles(
    ground: &UniformGround,
    triangles: Triangles,
    indices: impl Iterator<Item = usize>,
) -> Open {
    let (mut open, mut lanes, mut numbers, space) = (Open::default(), Group::EMPTY, [0; GROUP], ground.grid.space);
    let mut count = 0;
    let mut look = |lanes: &mut Group, numbers: &[u32]| {
        let mut uncovered = ground.open_triangles(lanes, numbers.len(), |lane| numbers[lane]);
        while uncovered != 0 {
            add(ground, numbers[uncovered.trailing_zeros() as usize], &mut open);
            uncovered &= uncovered - 1;
        }
    };
    for index in indices {
        numbers[count] = triangles.at(index);
        lanes.triangles[count] = space.places(ground.mesh.corners(numbers[count]));
        count += 1;
        if count == GROUP {
            look(&mut lanes, &numbers);
            count = 0;
        }
    }
    if count > 0 {
        look(&mut lanes, &numbers[..count]);
    }
    open
}

/// Adds a triangle that is not covered: whole, if it is small and has any area, or in parts.
fn add(ground: &UniformGround, triangle: u32, open: &mut Open) {
    let (whole, has_area) = ground.whole(triangle);
    if !has_area {
    } else if whole.longest <= WHOLE {
        open.wholes.push(whole);
    } else if f64::from(whole.longest) < 0.999 * PATCH {
        // One patch, which nothing has to be cut for.
        open.patches.extend(ground.look(&Fragment::whole(triangle), ()));
    } else {
        let (mut slices, radius) = (Vec::new(), ground.radius());
        slice(ground.mesh, triangle, PATCH * radius, &mut slices);
        slices.iter().for_each(|slice| open_parts(ground, slice, open));
    }
}

/// Adds what is open of a fragment, in patches that are small enough.
pub(in crate::psp) fn open_parts(ground: &UniformGround, fragment: &Fragment, open: &mut Open) {
    let count = count_up_to(ground.mesh, fragment, PATCH * ground.radius());
    ground.look_at_parts(fragment, count, &mut open.patches);
}

/// How many parts of its own shape along each of its edges a fragment has that are no longer than `longest`.
fn count_up_to(mesh: &Mesh, fragment: &Fragment, longest: f64) -> u32 {
    (fragment.shape(mesh).longest / longest).ceil().max(1.0) as u32
}

/// The parts of a fragment, of its own shape, that are no longer than `longest`.
pub(in crate::psp) fn parts_up_to(mesh: &Mesh, fragment: &Fragment, longest: f64) -> impl Iterator<Item = Fragment> {
    fragment.parts(count_up_to(mesh, fragment, longest))
}

const _: () = assert!(GROUP == 64, "a bit for each triangle");
