//! The part of a block that lies inside a mesh.
//!
//! A voxel is *cut* if a triangle meets it, tested by separating axes (Schwarz and Seidel 2010, "Fast parallel surface and solid
//! voxelization on GPUs", section 3, by intervals instead of edge functions). Where cut voxels are divided, box and plane of a triangle
//! are enough. Each triangle of a cell knows the parts of the cell that it is near to. Voxels that are not cut and share faces lie on one
//! side of the surface: cells are flooded, then the parts of each cut cell, beginning at neighbours whose side is known, and one
//! question to the mesh (`interior/`), which is closed, decides for all that a flood reaches.
//!
//! Cut voxels are divided until they are small: those of which no side is longer than the tolerance are dropped. So a place inside
//! that is not covered lies in a voxel with such sides that meets the surface. Darts on cut voxels ask the mesh.
//!
//! # Exactness
//! All tests are right to 10^-5 radii, and voxels are wider by that and by what a dart may be rounded, so that a voxel is never taken
//! for one that is not cut.

use crate::index::Binned;
use crate::interior::Interior;
use crate::math::{rounded_down, rounded_up};
use crate::plane::{Lattice, Rect};
use crate::simd::Lanes;
use crate::volume::grid::Grid;
use crate::volume::search::Centre;
use crate::volume::shape::{Shape, Voxels};
use crate::volume::shell::{Cells, Share, Shell, Thickness};
use crate::volume::voxels::{Level, Voxel, VoxelBox};

/// The error of coordinates in a block, in radii.
const ERROR: f64 = 1e-5;

/// Triangles with less area than this share of the product of two edges have a plane that is no use; their edges say all.
const FLAT: f64 = 1e-7;

/// Voxels with sides below this, in lattice units, are the last: a little more than where the levels end.
const LAST: f64 = 1.01;

/// The faces of a voxel in bits of its parts: those at its lower and upper end along each axis.
const FACES: [[u64; 2]; 3] = [
    [0x1111_1111_1111_1111, 0x8888_8888_8888_8888],
    [0x000f_000f_000f_000f, 0xf000_f000_f000_f000],
    [0x0000_0000_0000_ffff, 0xffff_0000_0000_0000],
];

/// The distance of neighbouring parts along each axis, in bits.
const STEPS: [u32; 3] = [1, 4, 16];

/// A direction along which a triangle and a box may be apart, and the interval of the triangle, in radii from the block's centre.
#[derive(Clone, Copy, Default)]
struct Axis {
    along: [f32; 3],
    low: f32,
    high: f32,
}

/// A triangle, in radii from the region's centre.
struct Triangle {
    corners: [[f32; 3]; 3],
    low: [f32; 3],
    high: [f32; 3],
    /// Of a triangle with a plane.
    normal: Axis,
}

/// A triangle of a cell: its number, and the parts of the cell that it is near to.
#[derive(Clone, Copy, Default)]
struct Met {
    triangle: u32,
    parts: u64,
}

/// The inside of a mesh.
#[derive(Clone, Copy)]
pub struct Solid<'a> {
    pub interior: &'a Interior,
    /// The largest side of cut voxels that are dropped, in radii.
    pub tolerance: f64,
    /// None of all of the inside.
    pub thickness: Option<Thickness>,
}

/// The smallest tolerance that [`Solid::refine`] makes, or a thin shell.
const FINEST: f64 = 1.0 / 1024.0;

/// The largest side of cut voxels that are dropped, in thicknesses of a shell.
const OF_SHELL: f64 = 0.25;

impl<'a> Solid<'a> {
    /// Makes the tolerance smaller, if it is not very small.
    pub fn refine(&mut self) -> bool {
        self.tolerance /= 4.0;
        self.tolerance > FINEST
    }

    /// The largest side of cut voxels that are dropped for a radius, in radii.
    pub fn tolerance_of(&self, radius: f64) -> f64 {
        let of_shell = self.thickness.map(|thickness| (OF_SHELL * thickness.distance / radius).max(FINEST));
        of_shell.map_or(self.tolerance, |of_shell| self.tolerance.min(of_shell))
    }

    /// Its part in a region of lattice points.
    pub fn within(&self, lattice: &'a Lattice<3>, region: Rect<3>) -> Inside<'a> {
        let (triangles, met, known) = Default::default();
        let margin = (Grid::margin(lattice.radius) / lattice.radius + ERROR) as f32;
        let tolerance = self.tolerance_of(lattice.radius * lattice.unit()) as f32;
        let shell = self.thickness.map(|thickness| Shell::new(self.interior, thickness, lattice, &region, margin));
        let half = std::array::from_fn(|axis| 0.5 * f64::from(region.length(axis)) / lattice.radius);
        let interior = self.interior;
        Inside { interior, lattice, tolerance, shell, region, half, side: half, margin, triangles, met, known }
    }
}

/// The part of a block that lies inside a mesh.
pub struct Inside<'a> {
    interior: &'a Interior,
    lattice: &'a Lattice<3>,
    /// The largest side of cut voxels that are dropped, in radii.
    tolerance: f32,
    /// None of all of the inside.
    shell: Option<Shell<'a>>,
    region: Rect<3>,
    /// Half the sides of the region and the sides of a cell, in radii.
    half: [f64; 3],
    side: [f64; 3],
    /// In radii, by which voxels are wider on all sides.
    margin: f32,
    triangles: Vec<Triangle>,
    /// The triangles that meet each cell.
    met: Binned<Met>,
    /// The parts of each cell that are known to lie inside, and outside.
    known: Vec<[u64; 2]>,
}

impl Inside<'_> {
    /// The triangles that may meet the region, by their intervals.
    fn gather(&mut self) {
        let Self { lattice, region, margin, .. } = *self;
        let unit = lattice.unit();
        let beyond = f64::from(margin) * lattice.radius * unit;
        let ends = |axis: usize| [region.min[axis], region.max[axis] - 1].map(|x| lattice.coordinate(axis, x));
        let low = std::array::from_fn(|axis| rounded_down(ends(axis)[0] - beyond));
        let high = std::array::from_fn(|axis| rounded_up(ends(axis)[1] + beyond));
        let centre: [f64; 3] = std::array::from_fn(|axis| ends(axis)[0] + 0.5 * f64::from(region.length(axis)) * unit);
        let per_radius = 1.0 / (lattice.radius * unit);
        let triangles = &mut self.triangles;
        self.interior.for_each_near([low, high], |corners| {
            let local = corners.map(|corner| std::array::from_fn(|k| (f64::from(corner[k]) - centre[k]) * per_radius));
            triangles.push(Triangle::new(&local));
        });
    }

    /// The vector from the region's centre to a cell's, in radii.
    #[inline(always)]
    fn cell_centre(&self, grid: &Grid, cell: usize) -> [f32; 3] {
        let (place, mut centre, mut axis) = (grid.place(cell), [0.0; 3], 0);
        while axis < 3 {
            centre[axis] = ((f64::from(place[axis]) + 0.5) * self.side[axis] - self.half[axis]) as f32;
            axis += 1;
        }
        centre
    }

    /// The side of the lattice point nearest to a place that is given in radii from the region's centre.
    fn is_inside(&self, place: [f32; 3]) -> bool {
        let Self { half, lattice, region, .. } = self;
        self.interior.contains(lattice.position(std::array::from_fn(|axis| {
            let along = (f64::from(place[axis]) + half[axis]) * lattice.radius;
            region.min[axis] + (along as i32).clamp(0, region.length(axis) - 1)
        })))
    }

    /// Finds the parts of a cell that each of its triangles may meet.
    #[inline(always)]
    fn find_parts<L: Lanes>(&mut self, lanes: L, parts: &Parts<L>, cell: usize) {
        let Self { triangles, met, .. } = self;
        let (met, mut index) = (met.bin_mut(cell), 0);
        while index < met.len() {
            let triangle = &triangles[met[index].triangle as usize];
            met[index].parts = parts.near(lanes, triangle, u64::MAX);
            index += 1;
        }
    }

    /// The parts of a voxel that boxes and planes of triangles meet. The voxel belongs to this part of its cell.
    #[inline(always)]
    fn near_parts<L: Lanes>(&self, lanes: L, parts: &Parts<L>, cell: usize, part: Option<u32>) -> u64 {
        let (mut near, met, mut index) = (0, self.met.bin(cell), 0);
        while index < met.len() {
            let Met { triangle, parts: of_cell } = met[index];
            index += 1;
            match part {
                None if parts.level.all == u64::MAX => near |= of_cell,
                Some(part) if of_cell >> part & 1 == 0 => (),
                _ => near |= parts.near(lanes, &self.triangles[triangle as usize], parts.level.all & !near),
            }
        }
        near
    }

    /// The parts of a voxel, of those in `wanted`, that triangles meet.
    #[inline(always)]
    fn met_parts<L: Lanes>(&self, lanes: L, parts: &Parts<L>, cell: usize, part: Option<u32>, wanted: u64) -> u64 {
        let (mut cut, met, mut index) = (0, self.met.bin(cell), 0);
        while index < met.len() && cut != wanted {
            let Met { triangle, parts: of_cell } = met[index];
            index += 1;
            if part.is_none_or(|part| of_cell >> part & 1 == 1) {
                let triangle = &self.triangles[triangle as usize];
                let mut meets = parts.near(lanes, triangle, wanted & !cut);
                let mut number = 0;
                while number < 9 && meets != 0 {
                    meets &= !parts.apart(lanes, &triangle.across_edge(number / 3, number % 3));
                    number += 1;
                }
                cut |= meets;
            }
        }
        cut
    }

    /// The parts on known sides that neighbours of a part of a cell, or of a cell as a whole, have at its faces.
    fn known_around(&self, grid: &Grid, cell: usize, part: Option<u32>) -> [u64; 2] {
        let (place, counts) = (grid.place(cell), grid.counts());
        let strides = [1, counts[0], counts[0] * counts[1]];
        let mut seeds = [0; 2];
        for axis in 0..3 {
            for (end, face) in FACES[axis].into_iter().enumerate() {
                let at_face = part.is_none_or(|part| face >> part & 1 == 1);
                let neighbour = if !at_face {
                    cell
                } else if end == 0 {
                    if place[axis] == 0 {
                        continue;
                    }
                    cell - strides[axis]
                } else {
                    if usize::from(place[axis]) + 1 == counts[axis] {
                        continue;
                    }
                    cell + strides[axis]
                };
                let known = self.known[neighbour];
                for side in 0..2 {
                    seeds[side] |= match part {
                        // A face of parts of the neighbouring cell, moved to this one's.
                        None if end == 0 => (known[side] & FACES[axis][1]) >> (3 * STEPS[axis]),
                        None => (known[side] & FACES[axis][0]) << (3 * STEPS[axis]),
                        Some(part) => {
                            let step = if at_face { 3 * STEPS[axis] } else { STEPS[axis] };
                            let next = if (end == 0) == at_face { part + step } else { part - step };
                            if known[side] >> next & 1 == 1 { face } else { 0 }
                        }
                    };
                }
            }
        }
        seeds
    }

    /// The sides of the parts of a voxel that are not cut: those inside and outside. Neighbours in `seeds` decide, and only
    /// components with parts in `wanted` are asked for.
    fn sides(&self, level: &Level, centre: [f32; 3], [free, wanted]: [u64; 2], seeds: [u64; 2]) -> [u64; 2] {
        let (mut sides, mut left) = ([0; 2], free);
        while left != 0 {
            let component = flood(left & left.wrapping_neg(), free);
            left &= !component;
            if component & seeds[0] != 0 {
                sides[0] |= component;
            } else if component & seeds[1] != 0 {
                sides[1] |= component;
            } else if component & wanted != 0 {
                let first = level.part_centre(centre, component.trailing_zeros());
                sides[usize::from(!self.is_inside(first))] |= component;
            }
        }
        sides
    }
}

impl Shape for Inside<'_> {
    #[inline(always)]
    fn cells<L: Lanes>(&mut self, _: L, grid: &Grid, mut open: Vec<Voxel>) -> Voxels {
        let (cells, counts) = (grid.cells(), grid.counts());
        self.side = std::array::from_fn(|axis| 2.0 * self.half[axis] / counts[axis] as f64);
        if self.shell.as_ref().is_some_and(|shell| shell.is_beyond(self.half)) {
            return Voxels::default();
        }
        self.gather();
        self.known = vec![[0; 2]; cells];
        self.bin(grid);
        let mut voxels = Voxels::default();
        self.flood_cells(grid);
        open.retain(|voxel| self.known[voxel.cell as usize][1] != u64::MAX);
        let Self { side, half, .. } = *self;
        if let Some(shell) = &mut self.shell {
            shell.sort_cells(Cells { counts, side, half }, &open);
        }
        for voxel in open {
            let cell = voxel.cell as usize;
            let share = self.shell.as_ref().map_or(Share::All, |shell| shell.of_cell(cell));
            if share == Share::All && self.known[cell][0] == u64::MAX {
                voxels.inside.push(voxel);
            } else if share != Share::None {
                voxels.cut.push(voxel);
            }
        }
        voxels
    }

    #[inline(always)]
    fn parts<L: Lanes>(&mut self, lanes: L, grid: &Grid, level: &Level, voxel: Voxel, open: u64) -> [u64; 2] {
        let cell = voxel.cell as usize;
        let (from_cell, in_cell) = (self.cell_centre(grid, cell), VoxelBox::new(level, voxel).centre);
        let centre = [from_cell[0] + in_cell[0], from_cell[1] + in_cell[1], from_cell[2] + in_cell[2]];
        let part = part_of_cell(level, voxel);
        let [x, y, z] = level.part_halves;
        let side = 2.0 * x.max(y).max(z);
        let small = side <= self.tolerance;
        // What is not divided any more is dropped if it is cut.
        let is_last = small || f64::from(side) * self.lattice.radius < LAST;
        if let Some(shell) = &mut self.shell {
            let [inside, _] = self.known[cell];
            // Only the inner border of the shell cuts it.
            if inside == u64::MAX || part.is_some_and(|part| inside >> part & 1 == 1) {
                let around = shell.distances_of_cell(grid.place(cell));
                return shell.parts(&around, level, centre, open, is_last);
            }
        }
        let of_cell = level.counts == [1; 3];
        let is_divided = level.all == u64::MAX;
        let parts = Parts::new(lanes, level, centre, self.margin);
        if of_cell && is_divided {
            self.find_parts(lanes, &parts, cell);
        }
        let mut cut = self.near_parts(lanes, &parts, cell, part);
        if is_last {
            // Only where a triangle meets it.
            cut = cut & !open | self.met_parts(lanes, &parts, cell, part, cut & open);
        }
        let free = level.all & !cut;
        let seeds = match level.counts {
            _ if !is_divided => [0; 2],
            [1, 1, 1] => self.known_around(grid, cell, None),
            [4, 4, 4] => {
                let [x, y, z] = voxel.numbers;
                self.known_around(grid, cell, Some(u32::from(x + 4 * y + 16 * z)))
            }
            _ => [0; 2],
        };
        let [inside, outside] = self.sides(level, centre, [free, open], seeds);
        if of_cell && is_divided {
            self.known[cell] = [inside, outside];
        }
        let [inside, cut] = [inside & open, if small { 0 } else { cut & open }];
        match &mut self.shell {
            Some(shell) if inside | cut != 0 && shell.of_cell(cell) != Share::All => {
                let around = shell.distances_of_cell(grid.place(cell));
                let [whole, partly] = shell.parts(&around, level, centre, inside | cut, is_last);
                [inside & whole, inside & partly | cut & (whole | partly)]
            }
            _ => [inside, cut],
        }
    }

    fn holds(&self, point: Centre) -> bool {
        let position = self.lattice.position(point);
        self.shell.as_ref().is_none_or(|shell| shell.holds(position)) && self.interior.contains(position)
    }
}

impl Inside<'_> {
    /// Puts each triangle into the cells that it meets.
    fn bin(&mut self, grid: &Grid) {
        let (counts, Self { half, side, .. }) = (grid.counts(), &*self);
        let margin = f64::from(self.margin);
        let halves: [f32; 3] = side.map(|side| (0.5 * side) as f32 + self.margin);
        let mut met = Vec::new();
        for (number, triangle) in (0..).zip(&self.triangles) {
            let range = |axis: usize| {
                let to = |x: f64| (x + half[axis]) / side[axis];
                let (low, high) =
                    (to(f64::from(triangle.low[axis]) - margin), to(f64::from(triangle.high[axis]) + margin));
                let last = counts[axis] as f64 - 1.0;
                if high < 0.0 || low > last + 1.0 {
                    0..0
                } else {
                    low.max(0.0).min(last) as usize..high.min(last) as usize + 1
                }
            };
            let [columns, rows, layers] = [range(0), range(1), range(2)];
            let is_alone = columns.len() * rows.len() * layers.len() == 1;
            for (z, y) in layers.flat_map(|z| rows.clone().map(move |y| (z, y))) {
                for x in columns.clone() {
                    let cell = (z * counts[1] + y) * counts[0] + x;
                    if is_alone || triangle.is_near(self.cell_centre(grid, cell), halves) {
                        met.push((cell, Met { triangle: number, parts: u64::MAX }));
                    }
                }
            }
        }
        self.met = Binned::new(grid.cells(), met.iter().copied());
    }

    /// Finds the sides of the cells that are not cut.
    fn flood_cells(&mut self, grid: &Grid) {
        let (counts, cells) = (grid.counts(), grid.cells());
        let strides = [1, counts[0], counts[0] * counts[1]];
        let mut seen: Vec<bool> = (0..cells).map(|cell| !self.met.bin(cell).is_empty()).collect();
        for first in 0..cells {
            if seen[first] {
                continue;
            }
            seen[first] = true;
            let (mut component, mut next) = (vec![first], 0);
            while next < component.len() {
                let cell = component[next];
                next += 1;
                let place = grid.place(cell);
                for axis in 0..3 {
                    let below = (place[axis] > 0).then(|| cell - strides[axis]);
                    let above = (usize::from(place[axis]) + 1 < counts[axis]).then(|| cell + strides[axis]);
                    for neighbour in [below, above].into_iter().flatten() {
                        if !seen[neighbour] {
                            seen[neighbour] = true;
                            component.push(neighbour);
                        }
                    }
                }
            }
            let is_inside = self.is_inside(self.cell_centre(grid, first));
            for cell in component {
                self.known[cell][usize::from(!is_inside)] = u64::MAX;
            }
        }
    }
}

impl Triangle {
    /// A triangle by its corners, in radii from the region's centre.
    fn new(corners: &[[f64; 3]; 3]) -> Self {
        let minus = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| a[k] - b[k]) };
        let square = |v: [f64; 3]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let [a, b, c] = *corners;
        let (u, v) = (minus(b, a), minus(c, a));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let area = square(normal);
        let mut triangle = Self {
            corners: corners.map(|corner| corner.map(|x| x as f32)),
            low: std::array::from_fn(|k| a[k].min(b[k]).min(c[k]) as f32),
            high: std::array::from_fn(|k| a[k].max(b[k]).max(c[k]) as f32),
            normal: Axis::default(),
        };
        if area > FLAT * FLAT * square(u) * square(v) {
            let length = area.sqrt();
            triangle.normal = triangle.axis(normal.map(|x| (x / length) as f32));
        }
        triangle
    }

    /// Its interval along a direction.
    #[inline(always)]
    fn axis(&self, along: [f32; 3]) -> Axis {
        let place = |p: [f32; 3]| p[0] * along[0] + p[1] * along[1] + p[2] * along[2];
        let [a, b, c] = [place(self.corners[0]), place(self.corners[1]), place(self.corners[2])];
        Axis { along, low: a.min(b).min(c), high: a.max(b).max(c) }
    }

    /// Its interval along the normal of an edge in the plane across an axis of space.
    #[inline(always)]
    fn across_edge(&self, edge: usize, axis: usize) -> Axis {
        let (from, to) = (self.corners[edge], self.corners[(edge + 1) % 3]);
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut along = [0.0; 3];
        (along[i], along[j]) = (from[j] - to[j], to[i] - from[i]);
        self.axis(along)
    }

    /// True if a box may meet the triangle: its box and plane do.
    fn is_near(&self, centre: [f32; 3], halves: [f32; 3]) -> bool {
        let Axis { along: [x, y, z], low, high } = self.normal;
        let along = x * centre[0] + y * centre[1] + z * centre[2];
        let radius = x.abs() * halves[0] + y.abs() * halves[1] + z.abs() * halves[2];
        (0..3).all(|k| self.low[k] <= centre[k] + halves[k] && centre[k] - halves[k] <= self.high[k])
            && low <= along + radius
            && along - radius <= high
    }
}

/// The parts of a voxel, for tests of all of them at once.
struct Parts<'a, L: Lanes> {
    level: &'a Level,
    /// The vector from the region's centre to the voxel's, in radii.
    centre: [f32; 3],
    /// Half the sides of a part with the margin.
    halves: [f32; 3],
    /// The centres of a layer of parts along x and y.
    columns: [L::Floats; 2],
}

impl<'a, L: Lanes> Parts<'a, L> {
    #[inline(always)]
    fn new(lanes: L, level: &'a Level, centre: [f32; 3], margin: f32) -> Self {
        let [x, y, z] = level.part_halves;
        let columns = [
            lanes.add(lanes.splat(centre[0]), lanes.load(&level.columns[0])),
            lanes.add(lanes.splat(centre[1]), lanes.load(&level.columns[1])),
        ];
        Self { level, centre, halves: [x + margin, y + margin, z + margin], columns }
    }

    /// Those of some that the box of a triangle and its plane meet.
    #[inline(always)]
    fn near(&self, lanes: L, triangle: &Triangle, among: u64) -> u64 {
        let (mut parts, mut axis) = (among, 0);
        while axis < 3 {
            let (low, high) = (
                triangle.low[axis] - self.halves[axis] - self.centre[axis],
                triangle.high[axis] + self.halves[axis] - self.centre[axis],
            );
            let (mut met, mut number) = (0, 0);
            while number < 4 {
                let place = self.level.offset(axis, number);
                // All parts with this number along the axis.
                let slice = FACES[axis][0] << (number as u32 * STEPS[axis]);
                met |= if low <= place && place <= high { slice } else { 0 };
                number += 1;
            }
            parts &= met;
            axis += 1;
        }
        if parts == 0 { 0 } else { parts & !self.apart(lanes, &triangle.normal) }
    }

    /// Those that a direction separates from a triangle.
    #[inline(always)]
    fn apart(&self, lanes: L, axis: &Axis) -> u64 {
        let [x, y, z] = axis.along;
        let radius = x.abs() * self.halves[0] + y.abs() * self.halves[1] + z.abs() * self.halves[2];
        let sums = lanes.add(lanes.mul(self.columns[0], lanes.splat(x)), lanes.mul(self.columns[1], lanes.splat(y)));
        let (mut parts, mut layer) = (0, 0);
        while layer < self.level.layers.len() {
            let along = z * (self.centre[2] + self.level.layers[layer]);
            let (from, to) = (axis.low - radius - along, axis.high + radius - along);
            let apart = lanes.bits(lanes.less(sums, lanes.splat(from))) | lanes.bits(lanes.less(lanes.splat(to), sums));
            parts |= u64::from(apart) << (16 * layer);
            layer += 1;
        }
        parts
    }
}

/// The part of its cell that a voxel belongs to; none of a whole cell, or if cells do not have 64 parts.
#[inline(always)]
fn part_of_cell(level: &Level, voxel: Voxel) -> Option<u32> {
    let number = |axis: usize| u32::from(voxel.numbers[axis]) * 4 / level.counts[axis];
    (level.counts.iter().all(|&count| count >= 4)).then(|| number(0) + 4 * number(1) + 16 * number(2))
}

/// The parts that are connected with those of `from` by faces, through those of `free`.
#[inline(always)]
fn flood(from: u64, free: u64) -> u64 {
    let mut reached = from;
    loop {
        let (mut next, mut axis) = (reached, 0);
        while axis < 3 {
            next |= (reached & !FACES[axis][1]) << STEPS[axis] | (reached & !FACES[axis][0]) >> STEPS[axis];
            axis += 1;
        }
        next &= free;
        if next == reached {
            return reached;
        }
        reached = next;
    }
}
