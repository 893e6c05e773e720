//! The uniform grid of the thesis (§2.4.1): samples of the unit torus that are valid or not, by cells of the radius.

/// Samples in cells at least a radius wide.
pub struct Grid {
    radius: f64,
    side: i64,
    cells: Vec<Vec<u32>>,
    places: Vec<[f32; 2]>,
    is_valid: Vec<bool>,
}

/// From one place to another, the shortest way.
pub fn offset(from: [f32; 2], to: [f32; 2]) -> [f64; 2] {
    [0, 1].map(|axis: usize| {
        let x = f64::from(to[axis]) - f64::from(from[axis]);
        if x > 0.5 {
            x - 1.0
        } else if x < -0.5 {
            x + 1.0
        } else {
            x
        }
    })
}

impl Grid {
    pub fn new(radius: f64) -> Self {
        let side = (1.0 / radius).floor().max(1.0) as i64;
        Self { radius, side, cells: vec![Vec::new(); (side * side) as usize], places: Vec::new(), is_valid: Vec::new() }
    }

    fn cell(&self, x: f32) -> i64 {
        ((f64::from(x) * self.side as f64) as i64).min(self.side - 1)
    }

    /// Adds a valid sample.
    pub fn insert(&mut self, place: [f32; 2]) -> usize {
        let index = self.places.len();
        let [column, row] = place.map(|x| self.cell(x));
        self.cells[(row * self.side + column) as usize].push(index as u32);
        self.places.push(place);
        self.is_valid.push(true);
        index
    }

    pub fn eliminate(&mut self, index: usize) {
        self.is_valid[index] = false;
    }

    pub fn len(&self) -> usize {
        self.places.len()
    }

    pub fn place(&self, index: usize) -> [f32; 2] {
        self.places[index]
    }

    pub fn is_valid(&self, index: usize) -> bool {
        self.is_valid[index]
    }

    /// The valid samples nearer to a place than so many radii, with their offsets from it.
    pub fn near(&self, place: [f32; 2], radii: i64) -> impl Iterator<Item = (usize, [f64; 2])> {
        // On a small torus no cell is visited twice.
        let (reach, limit) = (radii.min((self.side - 1) / 2), radii as f64 * self.radius);
        let [column, row] = place.map(|x| self.cell(x));
        let side = self.side;
        let cells = (-reach..=reach).flat_map(move |up| (-reach..=reach).map(move |along| (row + up, column + along)));
        // Nothing is more than a side away.
        let wrapped = move |x: i64| if x < 0 { x + side } else { x - if x < side { 0 } else { side } };
        let members =
            cells.flat_map(move |(row, column)| self.cells[(wrapped(row) * side + wrapped(column)) as usize].iter());
        let found = members.map(move |&index| (index as usize, offset(place, self.places[index as usize])));
        found.filter(move |&(index, [x, y])| self.is_valid[index] && (x * x + y * y).sqrt() < limit)
    }

    /// True if no valid sample is nearer to a position than the radius.
    pub fn is_gap(&self, place: [f32; 2]) -> bool {
        self.near(place, 1).next().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::random;

    #[test]
    fn what_is_near_is_what_a_search_of_all_finds() {
        let (points, radius) = (random(400, 3), 0.07);
        let mut grid = Grid::new(radius);
        points.iter().for_each(|&point| _ = grid.insert(point));
        (0..400).step_by(7).for_each(|index| grid.eliminate(index));
        for (place, radii) in random(50, 4).into_iter().flat_map(|place| [1, 2, 4].map(|radii| (place, radii))) {
            let mut found: Vec<_> = grid.near(place, radii).map(|(index, _)| index).collect();
            found.sort_unstable();
            let is_near = |&index: &usize| {
                let [x, y] = offset(place, points[index]);
                index % 7 > 0 && (x * x + y * y).sqrt() < radii as f64 * radius
            };
            assert_eq!(found, (0..400).filter(is_near).collect::<Vec<_>>());
            assert_eq!(grid.is_gap(place), grid.near(place, 1).count() == 0);
        }
    }
}
