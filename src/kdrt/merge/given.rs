//! The points that are given, sorted by cells that hold at most one survivor, with the exact test of their conflicts.

use std::ops::Range;

use crate::error::{Error, Result};
use crate::index::Binned;
use crate::job::Job;
use crate::plane::CellAxis;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::points::{Boundary, Domain};

use crate::kdrt::merge::NARROWING;

/// Points per task.
const POINTS: usize = 1 << 14;

/// The set of the points that must stay.
pub const FIXED: u32 = 0;

/// A point of a set, and which one it is.
#[derive(Clone, Copy, Default)]
pub struct Site {
    pub position: [f32; 2],
    /// [`FIXED`], or `i + 1` for piece `i`.
    pub set: u32,
    pub index: u32,
}

/// All points of all sets, sorted by cell and in it by set.
pub struct Given<'a> {
    domain: Domain,
    radius: f64,
    lattice: Lattice,
    /// The cells of the domain's lattice points: small enough that two points of one conflict.
    pub axes: [CellAxis; 2],
    /// For each column and row, the columns and rows that can hold a conflict with it, each once.
    near: [Vec<[Range<usize>; 2]>; 2],
    /// The sites of each cell.
    by_cell: Binned<Site>,
    sets: &'a [&'a [[f32; 2]]],
}

impl<'a> Given<'a> {
    /// Sorts the sets, whose points lie in the domain.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for two points of a set that fall in the same cell, unless they are there over the seam
    /// of a torus: they conflict. (What comes later would find them too, but could be kept busy by very many.)
    pub fn new(job: &Job, domain: Domain, lattice: &Lattice, radius: f64, sets: &'a [&'a [[f32; 2]]]) -> Result<Self> {
        let axes = lattice.size.map(|size| CellAxis::new(size, lattice.radius - NARROWING));
        // Distances of given points are at most two units shorter per axis than those of their lattice points.
        let near = axes.each_ref().map(|axis| near_on_axis(axis, lattice.separation.reach + 3, domain.boundary));
        let lattice = lattice.clone();
        let mut given = Self { domain, radius, lattice, axes, near, by_cell: Binned::default(), sets };
        given.sort(job)?;
        given.check_cells()?;
        Ok(given)
    }

    /// Sorts the points. Which cells they lie in is most of the work, and is shared.
    fn sort(&mut self, job: &Job) -> Result<()> {
        let chunks: Vec<&[[f32; 2]]> = self.sets.iter().flat_map(|set| set.chunks(POINTS)).collect();
        let cells = job.map(chunks.len(), |i| chunks[i].iter().map(|&point| self.cell(point)).collect::<Vec<_>>())?;
        let sites = (0..)
            .zip(self.sets)
            .flat_map(|(set, points)| (0..).zip(*points).map(move |(index, &position)| Site { position, set, index }));
        let count = self.axes.iter().map(|axis| axis.count() as usize).product();
        self.by_cell = Binned::new(count, cells.iter().flatten().copied().zip(sites));
        Ok(())
    }

    fn check_cells(&self) -> Result<()> {
        let crowded = |pair: &&[Site]| self.conflict(&pair[0], &pair[1]) && self.is_fault(&pair[0], &pair[1]);
        match self.sites().windows(2).find(crowded) {
            Some(pair) => Err(self.refusal(&pair[0], &pair[1])),
            None => Ok(()),
        }
    }

    fn cell(&self, point: [f32; 2]) -> usize {
        let point = self.lattice_point(point);
        let [column, row] = [0, 1].map(|axis: usize| self.axes[axis].cell(point[axis]) as usize);
        row * self.columns() + column
    }

    fn columns(&self) -> usize {
        self.axes[0].count() as usize
    }

    /// The number of sets, empty ones too.
    pub fn set_count(&self) -> usize {
        self.sets.len()
    }

    /// All points, by cells and in each by sets.
    pub fn sites(&self) -> &[Site] {
        self.by_cell.items()
    }

    /// The number of cells.
    pub fn cells(&self) -> usize {
        self.by_cell.len()
    }

    /// The lattice point that stands for a given one.
    pub fn lattice_point(&self, point: [f32; 2]) -> [i32; 2] {
        self.lattice.nearest(&self.domain, point)
    }

    /// Whether two points are closer than the radius: as the user's own check in `f64` says, whether that takes the
    /// root or not. (The root of a rounded square is the number itself, and rounding is monotone.)
    fn conflict(&self, a: &Site, b: &Site) -> bool {
        self.squared_distance(a, b) < self.radius * self.radius
    }

    fn squared_distance(&self, a: &Site, b: &Site) -> f64 {
        let extent = self.domain.extent();
        let [dx, dy] = offset(a, b).map(f64::abs);
        let [dx, dy] = match self.domain.boundary {
            Boundary::Periodic => [dx.min(extent[0] - dx), dy.min(extent[1] - dy)],
            Boundary::Bounded => [dx, dy],
        };
        dx * dx + dy * dy
    }

    /// Whether a conflict must not be: neither of two fixed points can go, and a piece conflicts with itself over the
    /// seam of a torus only.
    fn is_fault(&self, a: &Site, b: &Site) -> bool {
        let [dx, dy] = offset(a, b);
        a.set == b.set && (a.set == FIXED || dx * dx + dy * dy < self.radius * self.radius)
    }

    /// Visits all conflicts of the sites of a cell, by their places in `sites`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a conflict in one set, unless it can be resolved.
    pub fn conflicts(&self, cell: usize, mut visit: impl FnMut(usize, usize)) -> Result<()> {
        let sites = self.by_cell.range(cell..cell + 1);
        if sites.is_empty() {
            return Ok(());
        }
        let (row, column) = (cell / self.columns(), cell % self.columns());
        let rows = self.near[1][row].iter().cloned().flatten();
        let runs = rows.flat_map(|row| self.near[0][column].iter().map(move |columns| self.places(row, columns)));
        for other in runs.flatten() {
            for site in sites.clone().filter(|&site| site != other) {
                let (a, b) = (&self.sites()[site], &self.sites()[other]);
                if !self.conflict(a, b) {
                    continue;
                }
                if self.is_fault(a, b) {
                    return Err(self.refusal(a, b));
                }
                visit(site, other);
            }
        }
        Ok(())
    }

    /// The places in `sites` of the points in a run of cells of one row.
    fn places(&self, row: usize, columns: &Range<usize>) -> Range<usize> {
        let first = row * self.columns();
        self.by_cell.range(first + columns.start..first + columns.end)
    }

    /// The places in `sites` of all points in the cells that hold the lattice points of `rect`, a part of the domain.
    pub fn places_in(&self, rect: &Rect) -> impl Iterator<Item = usize> {
        let [columns, rows] = [0, 1].map(|axis: usize| {
            let [first, last] = [rect.min[axis], rect.max[axis] - 1].map(|x| self.axes[axis].cell(x) as usize);
            if rect.is_empty() { 0..0 } else { first..last + 1 }
        });
        rows.flat_map(move |row| self.places(row, &columns))
    }

    /// The surviving points in the order in which they were given.
    pub fn in_order(&self, survives: &[bool]) -> Vec<[f32; 2]> {
        let mut stays: Vec<Vec<bool>> = self.sets.iter().map(|set| vec![true; set.len()]).collect();
        for (site, _) in self.sites().iter().zip(survives).filter(|(_, survives)| !**survives) {
            stays[site.set as usize][site.index as usize] = false;
        }
        let points = self.sets.iter().copied().flatten().zip(stays.iter().flatten());
        points.filter(|(_, stays)| **stays).map(|(point, _)| *point).collect()
    }

    fn refusal(&self, a: &Site, b: &Site) -> Error {
        let [i, j] = [a.index.min(b.index), a.index.max(b.index)];
        let (distance, radius) = (self.squared_distance(a, b).sqrt(), self.radius);
        let apart = format!("{i} and {j} are {distance:?} apart, closer than the radius {radius:?}");
        match a.set {
            FIXED => Error::invalid("fixed", format!("points {apart}")),
            set => Error::invalid("pieces", format!("[{}]: samples {apart}", set - 1)),
        }
    }
}

fn offset(a: &Site, b: &Site) -> [f64; 2] {
    std::array::from_fn(|axis| f64::from(a.position[axis]) - f64::from(b.position[axis]))
}

/// For each cell of an axis the cells that hold points within `reach` of its own, as two runs that may be empty.
fn near_on_axis(axis: &CellAxis, reach: i32, boundary: Boundary) -> Vec<[Range<usize>; 2]> {
    let count = axis.count();
    let run = |first: i32, end: i32| first as usize..end as usize;
    let near = |cell: i32| {
        let (first, end) = (axis.cell(axis.edge(cell) - reach), axis.cell(axis.edge(cell + 1) - 1 + reach) + 1);
        match boundary {
            Boundary::Bounded => [run(first.max(0), end.min(count)), 0..0],
            Boundary::Periodic if end - first >= count => [run(0, count), 0..0],
            Boundary::Periodic if first < 0 => [run(0, end), run(first + count, count)],
            Boundary::Periodic => [run(first, end.min(count)), run(0, (end - count).max(0))],
        }
    };
    (0..count).map(near).collect()
}
