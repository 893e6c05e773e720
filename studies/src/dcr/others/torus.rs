//! Points on a torus that move one at a time, and their Voronoi cells.
//!
//! The torus is as large as there are points: the mean area of a cell is 1.

use glam::DVec2;

/// Points in a grid that has about one of them in each square.
pub struct Torus {
    side: f64,
    squares: i64,
    points: Vec<DVec2>,
    grid: Vec<Vec<u32>>,
}

/// A side of a cell.
#[derive(Clone, Copy)]
pub struct Side {
    /// The point on the other side of it.
    pub neighbour: u32,
    /// From the cell's point to that point.
    pub towards: DVec2,
    /// From the cell's point to the end of the side that comes first, counter-clockwise.
    pub from: DVec2,
}

/// The Voronoi cell of a point: its sides in order, each of which ends where the next begins.
pub struct Cell(pub Vec<Side>);

impl Torus {
    /// The points of a unit torus.
    pub fn new(points: &[[f32; 2]]) -> Self {
        let side = (points.len() as f64).sqrt();
        let squares = side.ceil().max(1.0) as i64;
        let mut torus =
            Self { side, squares, points: Vec::new(), grid: vec![Vec::new(); (squares * squares) as usize] };
        for point in points {
            torus.points.push(DVec2::ZERO);
            torus.insert(torus.points.len() - 1, DVec2::from(point.map(f64::from)) * side);
        }
        torus
    }

    /// The points, on the unit torus.
    pub fn to_unit(&self) -> Vec<[f32; 2]> {
        // A coordinate that rounds to 1 is 0 on the torus.
        let place = |x: f64| Some((x / self.side) as f32).filter(|&x| x < 1.0).unwrap_or(0.0);
        self.points.iter().map(|point| point.to_array().map(place)).collect()
    }

    pub fn len(&self) -> usize {
        self.points.len()
    }

    pub fn point(&self, index: usize) -> DVec2 {
        self.points[index]
    }

    /// Puts a point at a place, which may be beyond the sides.
    pub fn insert(&mut self, index: usize, place: DVec2) {
        let wrap = |x: f64| Some(x.rem_euclid(self.side)).filter(|&x| x < self.side).unwrap_or(0.0);
        self.points[index] = DVec2::new(wrap(place.x), wrap(place.y));
        let square = self.square(self.points[index]);
        self.grid[square].push(index as u32);
    }

    /// Takes a point out of the grid: no cell knows of it until it is inserted again.
    pub fn remove(&mut self, index: usize) {
        let square = self.square(self.points[index]);
        self.grid[square].retain(|&other| other as usize != index);
    }

    pub fn shift(&mut self, index: usize, by: DVec2) {
        self.remove(index);
        self.insert(index, self.points[index] + by);
    }

    fn row_and_column(&self, point: DVec2) -> [i64; 2] {
        [point.y, point.x].map(|x| ((x / self.side * self.squares as f64) as i64).min(self.squares - 1))
    }

    fn square(&self, point: DVec2) -> usize {
        let [row, column] = self.row_and_column(point);
        (row * self.squares + column) as usize
    }

    /// The cell of a point, whether that is in the grid or not. Nearer points are looked at first, until all others are
    /// farther than twice the cell's reach.
    pub fn cell(&self, index: usize) -> Cell {
        let (point, width) = (self.points[index], self.side / self.squares as f64);
        let [row, column] = self.row_and_column(point);
        let mut cell = Cell::of_images(index as u32, self.side);
        let mut reach = cell.reach();
        for ring in 0i64.. {
            if ring > 0 && 2.0 * reach <= (ring - 1) as f64 * width {
                break;
            }
            for (i, j) in (-ring..=ring).flat_map(|i| (-ring..=ring).map(move |j| (i, j))) {
                if i.abs() != ring && j.abs() != ring {
                    continue;
                }
                let [(row, above), (column, beside)] =
                    [row + i, column + j].map(|place| (place.rem_euclid(self.squares), place.div_euclid(self.squares)));
                let period = self.side * DVec2::new(beside as f64, above as f64);
                for &other in &self.grid[(row * self.squares + column) as usize] {
                    let towards = self.points[other as usize] + period - point;
                    if other as usize != index && towards.length() < 2.0 * reach && cell.clip(other, towards) {
                        reach = cell.reach();
                    }
                }
            }
        }
        cell
    }
}

impl Cell {
    /// The cell of a lone point, between its own images.
    fn of_images(index: u32, side: f64) -> Self {
        let turns = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        let from = |turn: DVec2| 0.5 * side * (turn + turn.perp() * -1.0);
        Self(turns.map(|turn| Side { neighbour: index, towards: side * turn, from: from(turn) }).to_vec())
    }

    /// Cuts off the part that is nearer to another point; returns true if there is one.
    fn clip(&mut self, neighbour: u32, towards: DVec2) -> bool {
        let beyond = |corner: DVec2| corner.dot(towards) - 0.5 * towards.length_squared();
        if towards == DVec2::ZERO || self.0.iter().all(|side| beyond(side.from) <= 0.0) {
            return false;
        }
        let mut left = Vec::with_capacity(self.0.len() + 1);
        for (i, &side) in self.0.iter().enumerate() {
            let next = self.0[(i + 1) % self.0.len()].from;
            let [start, end] = [side.from, next].map(beyond);
            let crossing = || side.from.lerp(next, start / (start - end));
            match (start <= 0.0, end <= 0.0) {
                (true, true) => left.push(side),
                (true, false) => left.extend([side, Side { neighbour, towards, from: crossing() }]),
                (false, true) => left.push(Side { from: crossing(), ..side }),
                (false, false) => {}
            }
        }
        self.0 = left;
        true
    }

    /// The sides with their lengths.
    pub fn lengths(&self) -> impl Iterator<Item = (Side, f64)> {
        self.ends().map(|(side, end)| (side, side.from.distance(end)))
    }

    /// The sides with their other ends.
    pub fn ends(&self) -> impl Iterator<Item = (Side, DVec2)> {
        (0..self.0.len()).map(|i| (self.0[i], self.0[(i + 1) % self.0.len()].from))
    }

    /// The distance of the farthest corner.
    pub fn reach(&self) -> f64 {
        self.farthest().length()
    }

    /// The farthest corner.
    pub fn farthest(&self) -> DVec2 {
        let corners = self.0.iter().map(|side| side.from);
        corners.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default()
    }

    pub fn area(&self) -> f64 {
        self.ends().map(|(side, end)| side.from.perp_dot(end) / 2.0).sum()
    }

    /// From the point to the centroid.
    pub fn centroid(&self) -> DVec2 {
        let moments = self.ends().map(|(side, end)| side.from.perp_dot(end) / 6.0 * (side.from + end));
        moments.sum::<DVec2>() / self.area()
    }

    /// The distance to the nearest neighbour.
    pub fn nearest(&self) -> f64 {
        self.0.iter().map(|side| side.towards.length()).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::random;

    #[test]
    fn cells_divide_the_torus_and_end_at_the_nearest_points() {
        for (count, seed) in [(1, 1), (2, 2), (5, 3), (40, 4), (700, 5)] {
            let torus = Torus::new(&random(count, seed));
            let cells: Vec<_> = (0..count).map(|i| torus.cell(i)).collect();
            let area: f64 = cells.iter().map(Cell::area).sum();
            assert!((area - count as f64).abs() < 1e-9 * count as f64, "{count}: {area}");
            let distance = |a: DVec2, b: DVec2| {
                let apart = |x: f64| x - torus.side * (x / torus.side).round();
                DVec2::new(apart(a.x - b.x), apart(a.y - b.y)).length()
            };
            for (i, cell) in cells.iter().enumerate() {
                for side in &cell.0 {
                    // No point is nearer to a corner than the cell's own, nor than its neighbour.
                    let corner = torus.point(i) + side.from;
                    let nearest =
                        torus.points.iter().map(|&other| distance(corner, other)).fold(f64::INFINITY, f64::min);
                    assert!((nearest - side.from.length()).abs() < 1e-9, "{count}: {i}");
                    assert!((side.from.distance(side.towards) - nearest).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn what_is_taken_out_is_no_neighbour_and_what_moves_is_found() {
        let mut torus = Torus::new(&random(200, 6));
        let neighbour = torus.cell(7).0[0].neighbour as usize;
        let has = |torus: &Torus| torus.cell(7).0.iter().any(|side| side.neighbour as usize == neighbour);
        let before = torus.point(neighbour);
        torus.remove(neighbour);
        assert!(!has(&torus));
        torus.insert(neighbour, before - DVec2::splat(torus.side));
        assert!(has(&torus) && torus.point(neighbour).distance(before) < 1e-9);
        torus.shift(neighbour, DVec2::splat(0.5 * torus.side));
        assert!(!has(&torus) && torus.to_unit().iter().flatten().all(|x| (0.0..1.0).contains(x)));
    }

    #[test]
    fn the_centroid_of_a_square_is_its_middle() {
        let cell = Cell::of_images(0, 2.0);
        assert!(cell.centroid().length() < 1e-12 && (cell.area() - 4.0).abs() < 1e-12);
        assert!((cell.reach() - 2f64.sqrt()).abs() < 1e-12 && cell.nearest() == 2.0);
    }
}
