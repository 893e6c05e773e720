//! The neighbour search in one cube where the radius varies: the counterpart of `psp/fill/grid.rs`, which is for one
//! radius.
//!
//! A cell lists every sample whose ball is near enough to overlap that of any place in the cell, so that a test reads
//! the pages of one cell here, too. This requires that the largest radius on the surface of the cube is known
//! beforehand; the size of the cells suits the usual one.

use glam::DVec3;

use crate::math::square;
use crate::mesh::Mesh;
use crate::psp::adaptive::dot::Dot;
use crate::psp::adaptive::page::{Ball, CoveredSixteenths, CoveredTriangles, Covering, Group, LANES, Near, Page, Part};
use crate::psp::fill::grid::{any_cell, each_cell};
use crate::psp::fill::page::GROUP;
use crate::psp::fill::space::{Place, Space, key};
use crate::psp::fill::table::Table;
use crate::psp::fragment::Facing;
use crate::simd::{Level, run};

/// The share by which rounding can increase the distance at which a sample matters, and some more.
const SLACK: f64 = 1e-4;

/// Samples in and around a cube.
pub(super) struct Grid {
    pub facing: Facing,
    space: Space,
    /// Half of the largest radius of darts and of the surface that they fall on, in the unit of the space.
    half: f64,
    /// The distance up to which samples are listed, as a multiple of the distance of conflicts.
    stretch: f64,
    /// The box of the darts and of the surface that they fall on.
    low: Place,
    high: Place,
    level: Level,
    cells: Table<Cell>,
    /// The first page is empty: that of all cells without samples.
    pages: Vec<Page>,
    /// For each page, the samples on it.
    numbers: Vec<[u32; LANES]>,
    /// For each page, the page of its cell that was filled before it.
    earlier: Vec<u32>,
    dots: Vec<Dot>,
}

/// The last page of a cell, and the number of samples that all of its pages list.
#[derive(Clone, Copy, Default)]
struct Cell {
    page: u32,
    count: u32,
}

/// The data of a fragment that a grid tests.
pub(super) struct Shade {
    pub corners: [DVec3; 3],
    /// Radii of the corners, such that no point has a smaller radius than their linear interpolation.
    pub radii: [f64; 3],
    pub longest: f64,
    /// The normal of the triangle, where normals matter.
    pub normal: [f32; 3],
}

impl Grid {
    /// A grid for the surface in a box where no radius exceeds `largest` and most are about `usual`. Ratios of samples
    /// are known up to `stretch`, at least 1.
    pub fn new(mesh: &Mesh, facing: Facing, [low, high]: [DVec3; 2], [usual, largest]: [f64; 2], stretch: f64) -> Self {
        let space = Space::new(mesh, usual.max(0.5 * largest));
        let scale = f64::from(space.scale());
        // Positions are rounded, but by a small part of a radius.
        let margin = 0.25 * space.radius();
        let low = (low * scale - margin).as_vec3().to_array();
        let high = (high * scale + margin).as_vec3().to_array();
        let (pages, numbers, earlier) = (vec![Page::EMPTY], vec![[0; LANES]], vec![0]);
        let (level, cells, dots) = (Level::widest(), Table::new(), Vec::new());
        let half = 0.5 * largest * scale;
        Self { facing, space, half, stretch, low, high, level, cells, pages, numbers, earlier, dots }
    }

    /// A ball in the unit of the space.
    pub fn ball(&self, position: [f32; 3], radius: f64) -> Ball {
        let [x, y, z] = self.space.place(position);
        [x, y, z, self.half_of(radius)]
    }

    fn half_of(&self, radius: f64) -> f32 {
        (0.5 * radius * f64::from(self.space.scale())) as f32
    }

    fn cell_of(&self, [x, y, z, _]: Ball) -> [u32; 3] {
        self.space.cell([x, y, z])
    }

    /// Adds a sample, unless it matters to no place in the box.
    pub fn add(&mut self, dot: Dot) {
        let (ball, number) = (self.ball(dot.position, dot.radius), self.dots.len() as u32);
        let reach = (self.stretch * (f64::from(ball[3]) + self.half) * (1.0 + SLACK)) as f32;
        let inside = |by: f32| [0, 1, 2].map(|axis| (ball[axis] + by).clamp(self.low[axis], self.high[axis]));
        let [x, y, z] = inside(0.0);
        let squared = square(x - ball[0]) + square(y - ball[1]) + square(z - ball[2]);
        if squared > reach * reach {
            return;
        }
        let cells = [-reach, reach].map(|reach| self.space.cell(inside(reach)));
        self.dots.push(dot);
        each_cell(cells, |cell| {
            let cell = self.cells.entry(key(cell));
            let lane = cell.count as usize % LANES;
            if lane == 0 {
                self.earlier.push(cell.page);
                cell.page = self.pages.len() as u32;
                self.pages.push(Page::EMPTY);
                self.numbers.push([0; LANES]);
            }
            cell.count += 1;
            self.pages[cell.page as usize].put(lane, ball);
            self.numbers[cell.page as usize][lane] = number;
        });
    }

    /// True if a dot conflicts with a sample: in `f64`, without tolerance.
    pub fn rejects(&self, dot: &Dot) -> bool {
        let ball = self.ball(dot.position, dot.radius);
        self.any_page(self.cell_of(ball), |page| {
            let mut near = run(self.level, Near { page: &self.pages[page], ball });
            while near != 0 {
                let number = self.numbers[page][near.trailing_zeros() as usize];
                if dot.conflicts(&self.dots[number as usize], self.facing) {
                    return true;
                }
                near &= near - 1;
            }
            false
        })
    }

    /// The least ratio of a dot to the samples that matter to it, or the stretch if that is less.
    pub fn ratio(&self, dot: &Dot) -> f64 {
        let mut least = self.stretch;
        let Cell { mut page, count } = self.cells.get(key(self.cell_of(self.ball(dot.position, dot.radius))));
        for number in (0..count).rev() {
            let lane = number as usize % LANES;
            let other = &self.dots[self.numbers[page as usize][lane] as usize];
            if self.facing.sees(other.normal, dot.normal) {
                least = least.min(dot.ratio(other));
            }
            if lane == 0 {
                page = self.earlier[page as usize];
            }
        }
        least
    }

    /// Those of some sixteenths of a fragment that no single sample certainly covers.
    pub fn open_sixteenths(&self, shade: &Shade, mut open: u16) -> u16 {
        let corners = shade.corners.map(|corner| self.space.scaled(corner));
        let halves = shade.radii.map(|radius| 0.5 * radius * f64::from(self.space.scale()));
        let a = corners[0].as_vec3();
        let [corner, to_b, to_c] = [corners[0] - a.as_dvec3(), corners[1] - corners[0], corners[2] - corners[0]];
        let ball = |place: DVec3, half: f64| place.extend(half).as_vec4().to_array();
        // A sample that covers a sixteenth covers its centre. This is no farther from the centre of the fragment than
        // three quarters of the way to a corner, which is two thirds of the longest edge.
        let extent = 0.5 * f64::from(self.space.scale()) * shade.longest;
        let part = Part {
            origin: a.to_array(),
            corner: ball(corner, halves[0]),
            edges: [ball(to_b, halves[1] - halves[0]), ball(to_c, halves[2] - halves[0])],
            whole: ball(corner + (to_b + to_c) * (1.0 / 3.0), halves[0].max(halves[1]).max(halves[2]) + extent),
        };
        any_cell(&self.space, corners, |cell| {
            self.any_page(cell, |page| {
                let among = self.seen(page, shade.normal);
                open &= !run(self.level, CoveredSixteenths { page: &self.pages[page], part: &part, among });
                open == 0
            })
        });
        open
    }

    /// The triangles of a group that no single sample certainly covers: a bit for each. Their pages are looked up here.
    pub fn open_triangles(&self, group: &mut Group, normals: &[[f32; 3]]) -> u64 {
        let count = normals.len();
        let mut chained = 0;
        for lane in 0..count {
            let cell = self.cells.get(key(self.cell_of(group.triangles[lane][0])));
            group.pages[lane] = cell.page;
            chained |= u64::from(cell.count as usize > LANES) << lane;
        }
        group.pages[count..].fill(0);
        let all = u64::MAX >> (GROUP - count);
        let mut open = all;
        if self.facing.asks_normals() {
            chained = all;
        } else {
            open &= !run(self.level, CoveredTriangles { group, pages: &self.pages });
        }
        let mut rest = open & chained;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize;
            if self.covers(&group.triangles[lane], normals[lane]) {
                open &= !(1 << lane);
            }
            rest &= rest - 1;
        }
        open
    }

    /// True if one sample certainly covers a triangle.
    fn covers(&self, corners: &[Ball; 3], normal: [f32; 3]) -> bool {
        self.any_page(self.cell_of(corners[0]), |page| {
            run(self.level, Covering { page: &self.pages[page], corners }) & self.seen(page, normal) != 0
        })
    }

    /// The samples on a page that matter to a normal.
    #[inline(always)]
    fn seen(&self, page: usize, normal: [f32; 3]) -> u16 {
        if !self.facing.asks_normals() {
            return u16::MAX;
        }
        let is_seen = |number: u32| self.facing.sees(self.dots[number as usize].normal, normal);
        self.numbers[page].iter().rev().fold(0, |seen, &number| seen << 1 | u16::from(is_seen(number)))
    }

    /// True if the test holds for a page of a cell.
    #[inline(always)]
    fn any_page(&self, cell: [u32; 3], mut test: impl FnMut(usize) -> bool) -> bool {
        let Cell { mut page, count } = self.cells.get(key(cell));
        for _ in 0..count.div_ceil(LANES as u32) {
            if test(page as usize) {
                return true;
            }
            page = self.earlier[page as usize];
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::exact;
    use crate::psp::adaptive::field::RadiusField;
    use crate::psp::adaptive::options::Radius;
    use crate::psp::adaptive::page::WITHIN;
    use crate::psp::fragment::Fragment;
    use crate::rng::{Draw, Rng};

    /// Against exact distances, in space and with normals, near the origin and far from it.
    #[test]
    fn rejects_and_ratios_are_those_of_a_loop_over_all_dots() {
        for (cosine, ratio, at, stretch) in
            [(-1.0, 1.0, 0.0, 1.0), (-1.0, 1e3, 0.0, 1.1), (0.5, 30.0, 0.0, 2.0), (-1.0, 8.0, 1e3, 1.3)]
        {
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            let mesh = Mesh::new(vec![[at; 3], [at + 1.0; 3], [at, at, at + 1.0]], vec![[0, 1, 2]]).unwrap();
            let largest = 0.1;
            let mut dot = |spread: f64, times: f64| Dot {
                position: [(); 3].map(|()| (f64::from(at) + 0.5 + spread * (rng.unit() - 0.5)) as f32),
                radius: times * largest * f64::powf(ratio, -rng.unit()),
                normal: DVec3::new(rng.unit() - 0.5, rng.unit() - 0.5, 0.3).normalize().as_vec3().to_array(),
            };
            let bounds = [DVec3::splat(f64::from(at) + 0.2), DVec3::splat(f64::from(at) + 0.8)];
            let facing = Facing::new(cosine).unwrap();
            let mut grid = Grid::new(&mesh, facing, bounds, [0.6 * largest, largest], stretch);
            let (mut dots, mut rejected) = (Vec::<Dot>::new(), 0);
            for step in 0..3000 {
                // Samples may also lie outside and be large; darts are in the box and no larger than stated.
                let (new, probe) = (dot(1.0, if step % 10 == 0 { 4.0 } else { 1.0 }), dot(0.6, 1.0));
                if dots.len() < 600 {
                    grid.add(new);
                    dots.push(new);
                }
                let sees = |other: &Dot| cosine == -1.0 || exact(other.normal).dot(exact(probe.normal)) >= cosine;
                let expected = dots.iter().any(|other| {
                    let apart = (exact(other.position) - exact(probe.position)).length();
                    apart < 0.5 * (other.radius + probe.radius) && sees(other)
                });
                assert_eq!(grid.rejects(&probe), expected);
                rejected += u32::from(expected);
                let ratio = |other: &Dot| {
                    let apart = (exact(other.position) - exact(probe.position)).length();
                    2.0 * apart / (other.radius + probe.radius)
                };
                let least = dots.iter().filter(|other| sees(other)).map(ratio).fold(stretch, f64::min);
                assert!((grid.ratio(&probe) / least - 1.0).abs() < 1e-12);
            }
            assert!((100..2950).contains(&rejected), "{rejected}");
        }
    }

    /// Against exact distances to the corners of a triangle and of its sixteenths: what no single sample covers is
    /// open, and what one covers with more than rounding to spare is not.
    #[test]
    fn only_what_is_covered_is_dropped_and_all_that_is_well_covered() {
        let (mut rng, mut counts) = (Rng::at(2, Draw::Probe, &[]), [0; 4]);
        for round in 0..3000 {
            let (size, ratio) = ([1.0, 0.1, 1e-3][round % 3], [1.0, 8.0, 500.0f64][round / 3 % 3]);
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            // The second triangle makes the mesh large: radii are cut at four diagonals.
            let corners = vec![corner(), corner(), corner(), [4.0; 3], [12.0; 3], [4.0, 12.0, 4.0]];
            let mesh = Mesh::new(corners, vec![[0, 1, 2], [3, 4, 5]]).unwrap();
            let radii: [f32; 6] = std::array::from_fn(|_| (1.0 + 0.5 * rng.unit()) as f32);
            let field = RadiusField::new(&mesh, Radius::PerVertex(&radii), None, 1.0).unwrap();
            let bounds = [DVec3::splat(8.0), DVec3::splat(9.0)];
            let mut grid = Grid::new(&mesh, Facing::ANY, bounds, [1.0, 1.5], 1.0);
            let mut dots = Vec::new();
            for _ in 0..20 {
                let radius = ratio.powf(rng.unit());
                let position = std::array::from_fn(|_| (8.0 + 1.2 * radius * (2.0 * rng.unit() - 1.0)) as f32);
                grid.add(Dot { position, radius, normal: [0.0; 3] });
                dots.push((exact(position), radius));
            }
            let whole = Fragment::whole(0);
            let shape = whole.shape(&mesh);
            let of = |part: &Fragment| field.radii_from(part, field.all());
            let shade = Shade { corners: shape.corners, radii: of(&whole), longest: shape.longest, normal: [0.0; 3] };
            let open = grid.open_sixteenths(&shade, u16::MAX);
            let mut group = Group::EMPTY;
            group.triangles[0] = [0, 1, 2].map(|i| grid.ball(mesh.corners(0)[i], radii[i].into()));
            let is_open = grid.open_triangles(&mut group, &[[0.0; 3]]) == 1;
            let parts = (0..16).map(|part| (open >> part & 1 == 1, whole.sixteenth(part)));
            for (is_open, part) in std::iter::once((is_open, whole)).chain(parts) {
                let (corners, radii) = (part.shape(&mesh).corners, of(&part));
                let covers = |share: f64| {
                    dots.iter().any(|&(centre, radius)| {
                        (0..3).all(|i| corners[i].distance(centre) < share * 0.5 * (radius + radii[i]))
                    })
                };
                assert!(is_open || covers(1.0));
                assert!(!(is_open && covers(1.0 - 1.2 * f64::from(1.0 - WITHIN))));
                counts[2 * usize::from(part.corners == whole.corners) + usize::from(is_open)] += 1;
            }
        }
        assert!(counts.into_iter().all(|count| count > 300), "{counts:?}");
    }
}
