//! The neighbour search of a fill: a hash grid with cells of two radii, where each cell lists, on pages of sixteen,
//! every sample whose ball touches it. So a test of a place, or of a part of the surface that lies in one cell, reads
//! one page.
//!
//! Normals, where they matter, are kept beside the pages and tested once a sample is near enough to count.

use glam::DVec3;

use crate::mesh::exact;
use crate::psp::facing::{Facing, NO_NORMAL};
use crate::psp::fill::cells::Cells;
use crate::psp::fill::page::{CoveredTriangles, Covering, GROUP, Group, LANES, Near, Page, Part, samples, squares};
use crate::psp::fill::space::{MASK, Place, ROUNDER, Space};
use crate::psp::sixteenths::{CORNERS, CORNERS_OF_SIXTEENTHS, Cover, PIERCING, PIERCING_BY_EDGE};
use crate::simd::{HALF, Lanes, Level, Work, run};

/// The number of pages that memory is reserved for at first: a cube of `psp/cubes.rs` hardly has more.
const PAGES: usize = 1 << 9;

/// Samples by the cells that their balls touch.
pub struct Grid {
    pub space: Space,
    level: Level,
    pub cells: Cells<Cell>,
    /// The first page is empty: that of all cells without samples.
    pub pages: Vec<Page>,
    /// For each page, the page of its cell that was filled before it.
    pub earlier: Vec<u32>,
    facing: Facing,
    /// The normals of the samples on each page, where normals matter.
    normals: Vec<[[f32; 3]; LANES]>,
}

/// The last page of a cell, and the number of samples that all of its pages list.
#[derive(Clone, Copy, Default)]
pub struct Cell {
    pub page: u32,
    pub count: u32,
}

impl Grid {
    pub fn new(space: Space, cells: Cells<Cell>, facing: Facing) -> Self {
        let (mut pages, mut earlier, mut normals) = (Vec::with_capacity(PAGES), Vec::with_capacity(PAGES), Vec::new());
        pages.push(Page::EMPTY);
        earlier.push(0);
        if facing.asks_normals() {
            normals.push([NO_NORMAL; LANES]);
        }
        Self { space, level: Level::widest(), cells, pages, earlier, facing, normals }
    }

    /// Adds a sample on a triangle with this normal.
    pub fn add(&mut self, place: Place, normal: [f32; 3]) {
        each_cell(self.cells.clip(self.space.cells_around(place)), |cell| {
            let cell = self.cells.entry(cell);
            let lane = cell.count as usize % LANES;
            if lane == 0 {
                self.earlier.push(cell.page);
                cell.page = self.pages.len() as u32;
                self.pages.push(Page::EMPTY);
                if self.facing.asks_normals() {
                    self.normals.push([NO_NORMAL; LANES]);
                }
            }
            cell.count += 1;
            self.pages[cell.page as usize].put(lane, place);
            if self.facing.asks_normals() {
                self.normals[cell.page as usize][lane] = normal;
            }
        });
    }

    /// True if a place on a triangle with this normal is closer to a sample than the radius: in `f64`, without
    /// tolerance.
    pub fn rejects(&self, place: Place, normal: [f32; 3]) -> bool {
        self.any_page(self.space.cell(place), |number| {
            let page = &self.pages[number];
            let mut near = run(self.level, Near { page, place, limit: self.space.surely_beyond });
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                if self.space.conflict(place, page.place(lane)) && self.sees(number, lane, normal) {
                    return true;
                }
                near &= near - 1;
            }
            false
        })
    }

    /// True if one page of its cell shows that a place is no farther from a sample than the square root of `limit`.
    #[inline(always)]
    pub fn is_seen_within(&self, place: Place, limit: f32) -> bool {
        let Cell { page, .. } = self.cells.get(self.cells.number(self.space.cell(place)));
        run(self.level, Near { page: &self.pages[page as usize], place, limit }) != 0
    }

    /// True if a place is found to be no farther from a sample than the square root of `limit`.
    pub fn is_within(&self, place: Place, limit: f32) -> bool {
        self.any_page(self.space.cell(place), |number| {
            run(self.level, Near { page: &self.pages[number], place, limit }) != 0
        })
    }

    /// The distance of a place on a triangle with this normal to the nearest sample, or `reach` if none is nearer: at
    /// most twice the radius, in the unit of places.
    pub fn distance(&self, place: Place, normal: [f32; 3], reach: f64) -> f64 {
        let mut least = reach * reach;
        each_cell(self.cells.clip(self.space.cells_within(place, reach - self.space.radius())), |cell| {
            self.any_page(cell, |number| {
                let page = &self.pages[number];
                let mut near = run(self.level, Near { page, place, limit: Space::beyond(least) });
                while near != 0 {
                    let lane = near.trailing_zeros() as usize;
                    if self.sees(number, lane, normal) {
                        least = least.min(exact(place).distance_squared(exact(page.place(lane))));
                    }
                    near &= near - 1;
                }
                false
            });
        });
        least.sqrt()
    }

    /// Those of some sixteenths of a fragment, given by its corners in the unit of the space and the normal of its
    /// triangle, that no single sample certainly covers.
    #[inline(always)]
    pub fn open_sixteenths(&self, corners: &[DVec3; 3], longest: f64, normal: [f32; 3], open: u16) -> u16 {
        // A sample that covers a sixteenth is no farther from its centre than the radius, and this is no farther from
        // the centre of the fragment than three quarters of the way to a corner, which is two thirds of the longest
        // edge.
        let reach = (self.space.radius() + 0.5 * longest) as f32;
        let corners = corners.map(|corner| corner.to_array().map(Apart));
        run(self.level, OpenSixteenths { grid: self, corners, reach, normal: &normal, open })
    }

    /// The triangles of a group, with these normals, that no single sample certainly covers: a bit for each. Their
    /// pages are looked up here.
    pub fn open_triangles(&self, group: &mut Group, count: usize, normal: impl Fn(usize) -> [f32; 3]) -> u64 {
        let (mut numbers, mut chained) = ([0; GROUP], 0);
        for (lane, number) in numbers.iter_mut().enumerate() {
            *number = self.cells.number(self.space.cell(group.triangles[lane][0]));
        }
        for (lane, &number) in numbers.iter().enumerate() {
            let cell = self.cells.get(number);
            group.pages[lane] = cell.page;
            chained |= u64::from(cell.count as usize > LANES) << lane;
        }
        let all = u64::MAX >> (64 - count);
        let mut open =
            all & !run(self.level, CoveredTriangles { group, pages: &self.pages, limit: self.space.surely_within });
        let mut rest = open & chained;
        if self.facing.asks_normals() {
            // Triangles that may be covered by a sample that faces another way.
            rest |= all & !open;
            open = all;
        }
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize;
            if self.covers(&group.triangles[lane], normal(lane)) {
                open &= !(1 << lane);
            }
            rest &= rest - 1;
        }
        open
    }

    /// True if one sample certainly covers a triangle.
    fn covers(&self, corners: &[Place; 3], normal: [f32; 3]) -> bool {
        self.any_page(self.space.cell(corners[0]), |number| {
            let (page, limit) = (&self.pages[number], self.space.surely_within);
            let covering = run(self.level, Covering { page, corners, limit });
            (0..LANES).any(|lane| covering >> lane & 1 == 1 && self.sees(number, lane, normal))
        })
    }

    /// True if a sample matters to a normal.
    #[inline(always)]
    fn sees(&self, page: usize, lane: usize, normal: [f32; 3]) -> bool {
        !self.facing.asks_normals() || self.facing.sees(self.normals[page][lane], normal)
    }

    /// The samples of a page that matter to a normal: a bit for each.
    #[inline(always)]
    pub fn seen(&self, page: usize, normal: &[f32; 3]) -> u16 {
        if self.facing.asks_normals() { self.seen_from(page, *normal) } else { u16::MAX }
    }

    #[inline(never)]
    fn seen_from(&self, page: usize, normal: [f32; 3]) -> u16 {
        (0..LANES).fold(0, |seen, lane| seen | u16::from(self.sees(page, lane, normal)) << lane)
    }

    /// True if the test holds for a page of a cell.
    #[inline(always)]
    fn any_page(&self, cell: [u32; 3], mut test: impl FnMut(usize) -> bool) -> bool {
        let Cell { mut page, count } = self.cells.get(self.cells.number(cell));
        for _ in 0..count.div_ceil(LANES as u32) {
            if test(page as usize) {
                return true;
            }
            page = self.earlier[page as usize];
        }
        false
    }
}

/// The sixteenths of a fragment, among the `open` ones, that no single sample certainly covers. Samples beyond `reach`
/// of its centre cover none.
///
/// The cells and the tests of their pages are one function, in which the corners stay in registers.
struct OpenSixteenths<'a> {
    grid: &'a Grid,
    corners: [[Apart; 3]; 3],
    reach: f32,
    normal: &'a [f32; 3],
    open: u16,
}

/// A number with a gap before the next. Without gaps compilers load several numbers at once, and a load across fresh
/// stores waits until all of them are in the cache.
#[derive(Clone, Copy)]
#[repr(align(16))]
struct Apart(f64);

impl Work for OpenSixteenths<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let Self { grid, corners, reach, normal, open } = self;
        let corners = corners.map(|[x, y, z]| DVec3::new(x.0, y.0, z.0));
        let cells = piercing_cells(lanes, grid, &corners);
        let mut numbers = [0; HALF];
        lanes.store_longs(cells, &mut numbers);
        let part = Part::new(corners, reach);
        let (s, t) = (lanes.load(&CORNERS[0]), lanes.load(&CORNERS[1]));
        let corners = [0, 1, 2].map(|axis| [part.corner[axis], part.edges[0][axis], part.edges[1][axis]]);
        let corners =
            [along(lanes, [s, t], corners[0]), along(lanes, [s, t], corners[1]), along(lanes, [s, t], corners[2])];
        let origin = [lanes.splat(part.origin[0]), lanes.splat(part.origin[1]), lanes.splat(part.origin[2])];
        let (limit, reach2) = (lanes.splat(grid.space.surely_within), lanes.splat(part.reach2));
        // Coverage: if lanes can be permuted, by the squared distance of each sixteenth's farthest corner from a
        // sample, the least over all samples; otherwise by bits of corners. By bits the whole fill takes 5 % longer in
        // AVX-512.
        let mut least = lanes.splat(f32::INFINITY);
        let (mut cover, mut unseen) = (Cover::default(), u8::MAX >> (HALF - PIERCING.len()));
        while unseen != 0 {
            let number = numbers[unseen.trailing_zeros() as usize % HALF];
            unseen &= !lanes.equal_longs(cells, number);
            let Cell { mut page, count } = grid.cells.get(number);
            for _ in 0..count.div_ceil(LANES as u32) {
                let [x, y, z] = samples(lanes, &grid.pages[page as usize]);
                let seen = [lanes.sub(x, origin[0]), lanes.sub(y, origin[1]), lanes.sub(z, origin[2])];
                let near = lanes.bits(lanes.at_most(squares(lanes, seen, part.centre), reach2)) as u16;
                let mut reaching = near & grid.seen(page as usize, normal);
                page = grid.earlier[page as usize];
                if reaching == 0 {
                    continue;
                }
                let mut places = [[0.0; LANES]; 3];
                lanes.store(seen[0], &mut places[0]);
                lanes.store(seen[1], &mut places[1]);
                lanes.store(seen[2], &mut places[2]);
                while reaching != 0 {
                    let lane = reaching.trailing_zeros() as usize % LANES;
                    let squares = squares(lanes, corners, [places[0][lane], places[1][lane], places[2][lane]]);
                    if L::PERMUTES {
                        let first = lanes.permute(squares, &CORNERS_OF_SIXTEENTHS[0]);
                        let two = lanes.max(first, lanes.permute(squares, &CORNERS_OF_SIXTEENTHS[1]));
                        let farthest = lanes.max(two, lanes.permute(squares, &CORNERS_OF_SIXTEENTHS[2]));
                        least = lanes.min(least, farthest);
                    } else {
                        cover.add(lanes.bits(lanes.less(squares, limit)) as u16);
                    }
                    reaching &= reaching - 1;
                }
                if open & !covered(lanes, least, limit, &cover) == 0 {
                    return 0;
                }
            }
        }
        open & !covered(lanes, least, limit, &cover)
    }
}

/// The sixteenths that are covered, by either method.
#[inline(always)]
fn covered<L: Lanes>(lanes: L, least: L::Floats, limit: L::Floats, cover: &Cover) -> u16 {
    if L::PERMUTES { lanes.bits(lanes.less(least, limit)) as u16 } else { cover.sixteenths() }
}

/// A corner and shares of the edges from there, along one axis.
#[inline(always)]
fn along<L: Lanes>(lanes: L, [s, t]: [L::Floats; 2], [corner, e, f]: [f32; 3]) -> L::Floats {
    let offset = lanes.add(lanes.mul(s, lanes.splat(e)), lanes.mul(t, lanes.splat(f)));
    lanes.add(lanes.splat(corner), offset)
}

/// The numbers of the cells of a fragment's piercing corners: the same as by [`Space::cell`] and [`Cells::number`].
#[inline(always)]
fn piercing_cells<L: Lanes>(lanes: L, grid: &Grid, &[a, b, c]: &[DVec3; 3]) -> L::Longs {
    let (space, (first, shifts)) = (&grid.space, grid.cells.numbering());
    let (a, e, f) = (a.to_array(), (b - a).to_array(), (c - a).to_array());
    let [s, t] = [lanes.load_doubles(&PIERCING_BY_EDGE[0]), lanes.load_doubles(&PIERCING_BY_EDGE[1])];
    let mut cells = [lanes.widen(lanes.splat_int(0)); 3];
    let mut axis = 0;
    while axis < 3 {
        let (e, f) = (lanes.splat_double(e[axis]), lanes.splat_double(f[axis]));
        let offset = lanes.add_doubles(lanes.mul_doubles(s, e), lanes.mul_doubles(t, f));
        let place = lanes.narrow(lanes.add_doubles(lanes.splat_double(a[axis]), offset));
        let scaled = lanes.mul(lanes.sub(place, lanes.splat(space.origin[axis])), lanes.splat(space.per_cell));
        let rounded = lanes.float_bits(lanes.add(scaled, lanes.splat(ROUNDER)));
        let cell = lanes.and_ints(rounded, lanes.splat_int(MASK.cast_signed()));
        cells[axis] = lanes.widen(lanes.sub_ints(cell, lanes.splat_int(first[axis].cast_signed())));
        axis += 1;
    }
    let (y, z) = (lanes.shift_longs(cells[1], shifts[0]), lanes.shift_longs(cells[2], shifts[1]));
    lanes.or_longs(cells[0], lanes.or_longs(y, z))
}

/// True if the test holds for a cell whose pages have to be read for the sixteenths of a fragment: samples that cover
/// one are on the pages of each of its corners.
#[inline(always)]
pub fn any_cell(space: &Space, [a, b, c]: [DVec3; 3], mut test: impl FnMut([u32; 3]) -> bool) -> bool {
    let (to_b, to_c) = (b - a, c - a);
    let mut cells = [[0; 3]; PIERCING.len()];
    for (known, [s, t]) in PIERCING.into_iter().enumerate() {
        let cell = space.cell((a + (s * to_b + t * to_c)).as_vec3().to_array());
        let is_known = cells[..known].contains(&cell);
        cells[known] = cell;
        if !is_known && test(cell) {
            return true;
        }
    }
    false
}

/// Calls `visit` with all cells from the lowest to the highest.
#[inline(always)]
pub fn each_cell([low, high]: [[u32; 3]; 2], mut visit: impl FnMut([u32; 3])) {
    for z in low[2]..=high[2] {
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                visit([x, y, z]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::psp::fill::extent::Extent;
    use crate::psp::fragment::Fragment;
    use crate::rng::{Draw, Rng};

    /// The places of the tests: near the origin, and where a radius has hardly more than 64 float spacings.
    const PLACES: [(f64, f64); 4] = [(8.0, 1.0), (8.0, 7.0), (8e30, 1e30), (2e5, 1.1)];

    fn random_point(rng: &mut Rng, centre: f64, size: f64) -> [f32; 3] {
        [(); 3].map(|()| (centre + size * (2.0 * rng.unit() - 1.0)) as f32)
    }

    /// Against exact distances: what conflicts with no sample is not rejected, and what does is.
    #[test]
    fn rejects_what_a_loop_over_all_samples_rejects() {
        for (centre, radius) in PLACES {
            let mut rng = Rng::at(1, Draw::Probe, &[]);
            let end = |radii: f64| [(centre + radii * radius) as f32; 3];
            let corners = vec![random_point(&mut rng, centre, radius), end(4.0), end(-4.0)];
            let mesh = Mesh::new(corners, vec![[0, 1, 2]]).unwrap();
            let mut grid = Grid::new(Space::new(&mesh, radius), Cells::anywhere(), Facing::ANY);
            let mut samples: Vec<[f32; 3]> = Vec::new();
            for _ in 0..2000 {
                let point = random_point(&mut rng, centre, 4.0 * radius);
                let conflicts = samples.iter().any(|&sample| exact(sample).distance(exact(point)) < radius);
                assert_eq!(grid.rejects(grid.space.place(point), NO_NORMAL), conflicts);
                let distances = samples.iter().map(|&sample| exact(sample).distance(exact(point)));
                let (reach, scale) = (1.5 * grid.space.radius(), f64::from(grid.space.scale()));
                let nearest = distances.map(|distance| distance * scale).fold(reach, f64::min);
                assert!((grid.distance(grid.space.place(point), NO_NORMAL, reach) / nearest - 1.0).abs() < 1e-15);
                if samples.len() < 400 {
                    grid.add(grid.space.place(point), NO_NORMAL);
                    samples.push(point);
                }
            }
        }
    }

    /// Against exact distances to the corners: what no single sample covers is open, and what one covers well is not.
    #[test]
    fn only_what_is_covered_is_dropped_and_all_that_is_well_covered() {
        let (mut rng, mut counts) = (Rng::at(2, Draw::Probe, &[]), [0; 4]);
        for round in 0..3000 {
            let (centre, radius) = PLACES[round % 3];
            let size = [1.0, 0.1, 1e-3][round / 3 % 3] * radius;
            let corners = (0..3).map(|_| random_point(&mut rng, centre, size)).collect();
            let Ok(mesh) = Mesh::new(corners, vec![[0, 1, 2]]) else { continue };
            let (space, mut extent) = (Space::new(&mesh, radius), Extent::EMPTY);
            mesh.corners(0).into_iter().for_each(|corner| extent.add(corner));
            let cells = if round % 2 == 0 { Cells::anywhere() } else { Cells::around(&extent, &space) };
            let mut grid = Grid::new(space, cells, Facing::ANY);
            let samples: Vec<_> = (0..30).map(|_| random_point(&mut rng, centre, 1.4 * radius)).collect();
            // A radius far larger than the mesh is replaced by a smaller one.
            let radius = grid.space.radius() / f64::from(grid.space.scale());
            samples.iter().for_each(|&sample| grid.add(grid.space.place(sample), NO_NORMAL));
            let (whole, mut group) = (Fragment::whole(0), Group::EMPTY);
            group.triangles[0] = mesh.corners(0).map(|corner| grid.space.place(corner));
            let is_open = grid.open_triangles(&mut group, 1, |_| NO_NORMAL) == 1;
            let shape = whole.shape(&mesh);
            let scaled = shape.corners.map(|corner| grid.space.scaled(corner));
            let mut open_at = |level| {
                grid.level = level;
                grid.open_sixteenths(&scaled, shape.longest * f64::from(grid.space.scale()), NO_NORMAL, u16::MAX)
            };
            let open = open_at(Level::Portable);
            assert!(Level::available().into_iter().all(|level| open_at(level) == open), "vectors find something else");
            let parts = (0..16).map(|part| (open >> part & 1 == 1, whole.sixteenth(part)));
            for (is_open, part) in std::iter::once((is_open, whole)).chain(parts) {
                let corners = part.shape(&mesh).corners;
                let farthest =
                    |&sample: &[f32; 3]| corners.map(|c| c.distance(exact(sample))).into_iter().fold(0.0, f64::max);
                let nearest = samples.iter().map(farthest).fold(f64::INFINITY, f64::min);
                assert!(is_open || nearest < radius, "{nearest} {radius}");
                assert!(!is_open || nearest > radius * (1.0 - 2e-5), "{nearest} {radius}");
                counts[2 * usize::from(part.corners == whole.corners) + usize::from(is_open)] += 1;
            }
        }
        assert!(counts.into_iter().all(|count| count > 300), "{counts:?}");
    }
}
