//! Samples in a hash grid: each cell lists, on pages of sixteen, every sample whose ball touches it. So a test of a
//! place, or of a part of the surface that lies in one cell, reads the pages of one cell.
//!
//! Samples have three axes, or a fourth one for their radius (`page.rs`). Normals, where they matter, are kept beside
//! the pages and tested once a sample is near enough to count.

use glam::DVec3;

use crate::psp::fill::cells::{Cells, each_cell};
use crate::psp::fill::page::{
    BATCH, BEYOND, Batch, CoveredTriangles, Covering, LANES, Near, Page, Part, WITHIN, samples, squares,
};
use crate::psp::fill::space::{MASK, Place, ROUNDER, Space};
use crate::psp::fragment::{CORNERS, CORNERS_OF_SIXTEENTHS, Cover, Facing, NO_NORMAL, PIERCING, PIERCING_BY_EDGE};
use crate::simd::{HALF, Lanes, Level, Work, run};

/// The number of pages that memory is reserved for at first: a cube of `psp/set/cubes.rs` hardly has more.
const PAGES: usize = 1 << 9;

/// Samples by the cells that their balls touch.
pub struct Pages<const AXES: usize> {
    pub space: Space,
    pub level: Level,
    pub facing: Facing,
    /// The limits of squared distances that are certainly close enough, and not surely too large.
    within: f32,
    pub beyond: f32,
    pub cells: Cells<Cell>,
    /// The first page is empty: that of all cells without samples.
    pages: Vec<Page<AXES>>,
    /// For each page, the page of its cell that was filled before it.
    earlier: Vec<u32>,
    /// The normals of the samples on each page, where normals matter.
    normals: Vec<[[f32; 3]; LANES]>,
}

/// The last page of a cell, and the number of samples that all of its pages list.
#[derive(Clone, Copy, Default)]
pub struct Cell {
    pub page: u32,
    pub count: u32,
}

impl<const AXES: usize> Pages<AXES> {
    pub fn new(space: Space, cells: Cells<Cell>, facing: Facing) -> Self {
        let [within, beyond] = if AXES > 3 { [WITHIN, BEYOND] } else { [space.surely_within, space.surely_beyond] };
        let (mut pages, mut earlier, mut normals) = (Vec::with_capacity(PAGES), Vec::with_capacity(PAGES), Vec::new());
        pages.push(Page::EMPTY);
        earlier.push(0);
        if facing.asks_normals() {
            normals.push([NO_NORMAL; LANES]);
        }
        Self { space, level: Level::widest(), facing, within, beyond, cells, pages, earlier, normals }
    }

    /// Lists a sample on a triangle with this normal in a range of cells; `listed` is called with each page and lane.
    #[inline(always)]
    pub fn list(
        &mut self,
        cells: [[u32; 3]; 2],
        sample: [f32; AXES],
        normal: [f32; 3],
        mut listed: impl FnMut(usize, usize),
    ) {
        each_cell(cells, |cell| {
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
            self.pages[cell.page as usize].put(lane, sample);
            if self.facing.asks_normals() {
                self.normals[cell.page as usize][lane] = normal;
            }
            listed(cell.page as usize, lane);
        });
    }

    /// The place of a sample by its page and lane.
    #[inline(always)]
    pub fn place(&self, page: usize, lane: usize) -> Place {
        self.pages[page].place(lane)
    }

    /// The sample on a page and lane.
    #[inline(always)]
    pub fn sample(&self, page: usize, lane: usize) -> [f32; AXES] {
        self.pages[page].sample(lane)
    }

    /// The samples of a page whose squared distance from one does not exceed a limit: a bit for each.
    #[inline(always)]
    pub fn near(&self, page: usize, from: [f32; AXES], limit: f32) -> u16 {
        run(self.level, Near { page: &self.pages[page], from, limit })
    }

    /// True if the test holds for a sample in a cell, by its page and lane, whose squared distance from one does not
    /// exceed a limit and which matters to a normal.
    #[inline(always)]
    pub fn any_near(
        &self,
        cell: [u32; 3],
        from: [f32; AXES],
        normal: [f32; 3],
        limit: f32,
        mut test: impl FnMut(usize, usize) -> bool,
    ) -> bool {
        self.any_page(cell, |page| {
            let mut near = self.near(page, from, limit);
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                if self.sees(page, lane, normal) && test(page, lane) {
                    return true;
                }
                near &= near - 1;
            }
            false
        })
    }

    /// Those of some sixteenths of a fragment that no single sample certainly covers. The fragment is given by its
    /// corners and half of the radii there, if radii vary, in the unit of the space, and the normal of its triangle. A
    /// sample that covers any of it lies in the ball of radius `reach` around its centre, or overlaps it.
    #[inline(always)]
    pub fn open_parts(&self, corners: &[DVec3; 3], halves: &[f64; 3], reach: f32, normal: [f32; 3], open: u16) -> u16 {
        run(self.level, OpenSixteenths { grid: self, corners, halves, reach, normal: &normal, open })
    }

    /// The triangles of a group, with these normals, that no single sample certainly covers: a bit for each. Their
    /// pages are looked up here.
    pub fn open_triangles(&self, group: &mut Batch<AXES>, count: usize, normal: impl Fn(usize) -> [f32; 3]) -> u64 {
        let (mut numbers, mut chained) = ([0; BATCH], 0);
        for (lane, number) in numbers.iter_mut().enumerate() {
            *number = self.cells.number(self.space.cell(place(&group.triangles[lane][0])));
        }
        for (lane, &number) in numbers.iter().enumerate() {
            let cell = self.cells.get(number);
            group.pages[lane] = cell.page;
            chained |= u64::from(cell.count as usize > LANES) << lane;
        }
        let all = u64::MAX >> (BATCH - count);
        let mut open = all & !run(self.level, CoveredTriangles { group, pages: &self.pages, limit: self.within });
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
    fn covers(&self, corners: &[[f32; AXES]; 3], normal: [f32; 3]) -> bool {
        self.any_page(self.space.cell(place(&corners[0])), |page| self.covering(page, corners, normal) != 0)
    }

    /// The samples of a page that certainly cover a triangle with a normal: a bit for each.
    pub fn covering(&self, page: usize, corners: &[[f32; AXES]; 3], normal: [f32; 3]) -> u16 {
        let covering = run(self.level, Covering { page: &self.pages[page], corners, limit: self.within });
        if covering == 0 { 0 } else { covering & self.seen(page, &normal) }
    }

    /// True if a sample matters to a normal.
    #[inline(always)]
    pub fn sees(&self, page: usize, lane: usize, normal: [f32; 3]) -> bool {
        !self.facing.asks_normals() || self.facing.sees(self.normals[page][lane], normal)
    }

    /// The samples of a page that matter to a normal: a bit for each.
    #[inline(always)]
    fn seen(&self, page: usize, normal: &[f32; 3]) -> u16 {
        if self.facing.asks_normals() { self.seen_from(page, *normal) } else { u16::MAX }
    }

    #[inline(never)]
    fn seen_from(&self, page: usize, normal: [f32; 3]) -> u16 {
        (0..LANES).fold(0, |seen, lane| seen | u16::from(self.sees(page, lane, normal)) << lane)
    }

    /// True if the test holds for a page of a cell.
    #[inline(always)]
    pub fn any_page(&self, cell: [u32; 3], mut test: impl FnMut(usize) -> bool) -> bool {
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

/// The place of a sample.
#[inline(always)]
fn place<const AXES: usize>(sample: &[f32; AXES]) -> Place {
    [sample[0], sample[1], sample[2]]
}

/// The sixteenths of a fragment, among the `open` ones, that no single sample certainly covers. Samples beyond `reach`
/// of its centre cover none.
///
/// The cells and the tests of their pages are one function, in which the corners stay in registers.
struct OpenSixteenths<'a, const AXES: usize> {
    grid: &'a Pages<AXES>,
    corners: &'a [DVec3; 3],
    halves: &'a [f64; 3],
    reach: f32,
    normal: &'a [f32; 3],
    open: u16,
}

impl<const AXES: usize> Work for OpenSixteenths<'_, AXES> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let Self { grid, corners, halves, reach, normal, mut open } = self;
        let cells = piercing_cells(lanes, &grid.space, &grid.cells, corners);
        let mut numbers = [0; HALF];
        lanes.store_longs(cells, &mut numbers);
        let part = Part::<AXES>::new(*corners, *halves, reach);
        let (s, t) = (lanes.load(&CORNERS[0]), lanes.load(&CORNERS[1]));
        let (mut corners, mut axis) = ([lanes.splat(0.0); AXES], 0);
        while axis < AXES {
            let ends = [part.corner[axis], part.edges[0][axis], part.edges[1][axis]];
            corners[axis] = along(lanes, [s, t], ends);
            axis += 1;
        }
        let origin = [lanes.splat(part.origin[0]), lanes.splat(part.origin[1]), lanes.splat(part.origin[2])];
        // Coverage: with one radius, if lanes can be permuted, by the squared distance of each sixteenth's farthest
        // corner from a sample, the least over all samples; otherwise by bits of corners. By bits the whole fill takes
        // 5 % longer in AVX-512.
        let by_least = L::PERMUTES && AXES == 3;
        let (mut least, limit) = (lanes.splat(f32::INFINITY), lanes.splat(grid.within));
        let (mut cover, mut unseen) = (Cover::default(), u8::MAX >> (HALF - PIERCING.len()));
        while unseen != 0 {
            let number = numbers[unseen.trailing_zeros() as usize % HALF];
            unseen &= !lanes.equal_longs(cells, number);
            let Cell { mut page, count } = grid.cells.get(number);
            for _ in 0..count.div_ceil(LANES as u32) {
                let mut seen = samples(lanes, &grid.pages[page as usize]);
                seen[0] = lanes.sub(seen[0], origin[0]);
                seen[1] = lanes.sub(seen[1], origin[1]);
                seen[2] = lanes.sub(seen[2], origin[2]);
                let [apart, limits] = squares(lanes, seen, part.centre, part.limit);
                let near = lanes.bits(lanes.at_most(apart, limits)) as u16;
                let mut reaching = near & grid.seen(page as usize, normal);
                page = grid.earlier[page as usize];
                if reaching == 0 {
                    continue;
                }
                let (mut stored, mut axis) = ([[0.0; LANES]; AXES], 0);
                while axis < AXES {
                    lanes.store(seen[axis], &mut stored[axis]);
                    axis += 1;
                }
                while reaching != 0 {
                    let lane = reaching.trailing_zeros() as usize % LANES;
                    let (mut sample, mut axis) = ([0.0; AXES], 0);
                    while axis < AXES {
                        sample[axis] = stored[axis][lane];
                        axis += 1;
                    }
                    let [squares, limits] = squares(lanes, corners, sample, grid.within);
                    if by_least {
                        let first = lanes.permute(squares, &CORNERS_OF_SIXTEENTHS[0]);
                        let two = lanes.max(first, lanes.permute(squares, &CORNERS_OF_SIXTEENTHS[1]));
                        let farthest = lanes.max(two, lanes.permute(squares, &CORNERS_OF_SIXTEENTHS[2]));
                        least = lanes.min(least, farthest);
                    } else {
                        cover.add(lanes.bits(lanes.less(squares, limits)) as u16);
                    }
                    reaching &= reaching - 1;
                }
                open &= !if by_least { lanes.bits(lanes.less(least, limit)) as u16 } else { cover.sixteenths() };
                if open == 0 {
                    return 0;
                }
            }
        }
        open
    }
}

/// A corner and shares of the edges from there, along one axis.
#[inline(always)]
fn along<L: Lanes>(lanes: L, [s, t]: [L::Floats; 2], [corner, e, f]: [f32; 3]) -> L::Floats {
    let offset = lanes.add(lanes.mul(s, lanes.splat(e)), lanes.mul(t, lanes.splat(f)));
    lanes.add(lanes.splat(corner), offset)
}

/// The numbers of the cells of a fragment's piercing corners: the same as by [`Space::cell`] and [`Cells::number`].
#[inline(always)]
fn piercing_cells<L: Lanes>(lanes: L, space: &Space, cells: &Cells<Cell>, &[a, b, c]: &[DVec3; 3]) -> L::Longs {
    let (first, shifts) = cells.numbering();
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
