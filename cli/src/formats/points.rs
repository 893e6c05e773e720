//! Sets of the plane or of a cuboid as a table: what files of them hold, and in which order.

use std::io::{self, Write};

use super::columns::{CLASS, Column, Number, RADIUS, RANK, write_floats};

/// Points of `D` coordinates with their radii, ranks and classes.
#[derive(Clone, Copy, Default)]
pub struct PointTable<'a, const D: usize = 2> {
    pub points: &'a [[f32; D]],
    /// The radius of each point, where they differ within a class; otherwise empty.
    pub radii: &'a [f64],
    /// The rank of each point, in progressive order; otherwise empty.
    pub ranks: &'a [f32],
    /// The class of each point, where there are several; otherwise empty.
    pub classes: &'a [u32],
    /// The radius of each class, or of all points, where `radii` has none; empty if it is not known. No column: some formats show it as a size.
    pub class_radii: &'a [f64],
}

impl<'a, const D: usize> PointTable<'a, D> {
    /// Points of which no more is known.
    pub fn of(points: &'a [[f32; D]]) -> Self {
        Self { points, ..Self::default() }
    }

    /// The columns that only some sets have.
    pub fn more_columns(&self) -> impl Iterator<Item = Column> {
        let (rank, class) = ((!self.ranks.is_empty()).then_some(RANK), (!self.classes.is_empty()).then_some(CLASS));
        [(!self.radii.is_empty()).then_some(RADIUS), rank, class].into_iter().flatten()
    }

    /// The numbers of a point in these columns.
    pub fn more_numbers(&self, point: usize) -> impl Iterator<Item = Number> {
        let radius = self.radii.get(point).map(|&radius| Number::Float(radius as f32));
        let rank = self.ranks.get(point).map(|&rank| Number::Float(rank));
        let class = self.classes.get(point).map(|&class| Number::Whole(class));
        [radius, rank, class].into_iter().flatten()
    }

    /// Writes all rows as binary numbers, little-endian and without gaps: the coordinates, zeros for other axes, and radius,
    /// rank and class if there are any.
    pub fn write_binary<const AXES: usize>(&self, writer: &mut impl Write) -> io::Result<()> {
        (0..self.points.len()).try_for_each(|i| {
            let mut place = [0.0; AXES];
            place[..D].copy_from_slice(&self.points[i]);
            write_floats(writer, &[place])?;
            self.more_numbers(i).try_for_each(|number| writer.write_all(&number.bytes()))
        })
    }
}
