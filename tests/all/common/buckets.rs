//! Points by the cubes of a grid that they are in, so that large sets can be checked.

use std::collections::HashMap;

type Point = [f64; 3];

pub struct Buckets {
    side: f64,
    cubes: HashMap<[i64; 3], Vec<(usize, Point)>>,
    all: Vec<(usize, Point)>,
}

impl Buckets {
    pub fn new(positions: &[[f32; 3]], side: f64) -> Self {
        let all: Vec<_> = positions.iter().map(|position| position.map(f64::from)).enumerate().collect();
        let mut buckets = Self { side, cubes: HashMap::new(), all: all.clone() };
        for (index, point) in all {
            buckets.cubes.entry(buckets.cube(point)).or_default().push((index, point));
        }
        buckets
    }

    pub fn all(&self) -> &[(usize, Point)] {
        &self.all
    }

    fn cube(&self, point: Point) -> [i64; 3] {
        point.map(|x| (x / self.side).floor() as i64)
    }

    /// All points within a distance of the box around some places, and some beyond it.
    pub fn near(&self, places: &[Point], distance: f64) -> Vec<(usize, Point)> {
        let bound = |pick: fn(f64, f64) -> f64, by: f64| -> Point {
            std::array::from_fn(|axis| places.iter().map(|place| place[axis]).reduce(pick).unwrap() + by)
        };
        let reach = 1.001 * distance;
        let [low, high] = [self.cube(bound(f64::min, -reach)), self.cube(bound(f64::max, reach))];
        if (0..3).map(|axis| (high[axis] as f64) - (low[axis] as f64) + 1.0).product::<f64>() > self.cubes.len() as f64
        {
            return self.all.clone();
        }
        let cubes = (low[0]..=high[0])
            .flat_map(|x| (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z])));
        cubes.filter_map(|cube| self.cubes.get(&cube)).flatten().copied().collect()
    }
}
