//! A scene seen through camera rays, one for each sample of the picture.

use std::ops::ControlFlow;

use azulejo::Result;
use azulejo::trace::{Hit, Ray, Scene};
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::procedural::shapes::hall;
use glam::Vec3;

/// The place of the camera, its view to each side of the middle, and the direction of the light.
const EYE: Vec3 = Vec3::new(0.12, 0.93, 0.52);
const HALF_VIEW: f32 = 0.8;
const LIGHT: Vec3 = Vec3::new(-0.48, 0.36, 0.8);

/// The hall, of length 4, is traced at this scale: in about a unit box.
const SCALE: f32 = 0.2;

/// Chequers per unit of length, and where one begins: on no wall.
const CHEQUERS: f32 = 5.0;
const BEGIN: f32 = 0.37;

/// The standard deviation of the filter, and where it is cut off, in pixels: those of the zone plate.
const DEVIATION: f64 = 0.5;
const REACH: f64 = 2.0;

/// Rays of a task.
const TASK: usize = 1 << 14;

pub struct Hall {
    scene: Scene,
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    num_threads: usize,
}

impl Hall {
    pub fn new(detail: u32, num_threads: usize) -> Result<Self> {
        let (mut positions, triangles) = hall(detail);
        positions.iter_mut().flatten().for_each(|x| *x *= SCALE);
        Ok(Self { scene: Scene::new(&positions, &triangles, num_threads)?, positions, triangles, num_threads })
    }

    /// A picture of `side` by `side` pixels, row by row from the top, each the mean of the samples near it, weighted by
    /// the filter.
    pub fn picture(&self, samples: &[[f32; 2]], side: usize) -> Result<Vec<f64>> {
        let tasks: Vec<_> = samples.chunks(TASK).collect();
        let values =
            in_parallel(self.num_threads, tasks.len(), &|_| ControlFlow::Continue(()), |i| self.values(tasks[i]))?;
        let (mut sums, mut weights) = (vec![0.0; side * side], vec![0.0; side * side]);
        for (sample, value) in samples.iter().zip(values.concat()) {
            let [x, y] = sample.map(|x| f64::from(x) * side as f64);
            let near = |x: f64| (x - REACH).max(0.0) as usize..((x + REACH).ceil() as usize).min(side);
            for (row, column) in near(y).flat_map(|row| near(x).map(move |column| (row, column))) {
                let squared = (column as f64 + 0.5 - x).powi(2) + (row as f64 + 0.5 - y).powi(2);
                if squared < REACH * REACH {
                    let weight = (-squared / (2.0 * DEVIATION * DEVIATION)).exp();
                    sums[row * side + column] += weight * value;
                    weights[row * side + column] += weight;
                }
            }
        }
        Ok(sums.iter().zip(&weights).map(|(sum, &weight)| if weight > 0.0 { sum / weight } else { 0.0 }).collect())
    }

    /// The brightness that is seen through each sample, from 0 to 1.
    fn values(&self, samples: &[[f32; 2]]) -> Vec<f64> {
        let ray = |&[x, y]: &[f32; 2]| Ray {
            origin: (SCALE * EYE).to_array(),
            direction: [1.0, HALF_VIEW * (1.0 - 2.0 * x), HALF_VIEW * (1.0 - 2.0 * y)],
        };
        let rays: Vec<_> = samples.iter().map(ray).collect();
        let hits = self.scene.closest_hits_in_packets(self.scene.packet_width(), &rays);
        rays.iter().zip(hits).map(|(ray, hit)| hit.map_or(0.0, |hit| self.shade(ray, &hit))).collect()
    }

    fn shade(&self, ray: &Ray, hit: &Hit) -> f64 {
        let [a, b, c] = self.triangles[hit.triangle as usize].map(|vertex| Vec3::from(self.positions[vertex as usize]));
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let place = Vec3::from(ray.origin) + hit.t * Vec3::from(ray.direction);
        let chequers = (place / SCALE * CHEQUERS + BEGIN).floor();
        let is_dark = (chequers.x + chequers.y + chequers.z) as i32 % 2 == 0;
        let light = 0.15 + 0.85 * normal.dot(LIGHT).abs();
        f64::from(light * if is_dark { 0.45 } else { 1.0 })
    }
}

/// The difference of a picture from another: the root mean square over pixels.
pub fn error(picture: &[f64], reference: &[f64]) -> f64 {
    let squares: f64 = picture.iter().zip(reference).map(|(value, other)| (value - other).powi(2)).sum();
    (squares / picture.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{jittered, random};

    #[test]
    fn more_rays_and_more_even_ones_err_less() {
        let (hall, side) = (Hall::new(8, 2).unwrap(), 24);
        let picture = |samples: &[[f32; 2]]| hall.picture(samples, side).unwrap();
        let reference = picture(&jittered(480, 1));
        let error = |samples: &[[f32; 2]]| error(&picture(samples), &reference);
        let [few, many, even] = [error(&random(2304, 2)), error(&random(36_864, 2)), error(&jittered(48, 2))];
        assert!(many < 0.4 * few && even < 0.8 * few, "{few} {many} {even}");
        // The hall is closed, and every wall is lit.
        let (low, high) = reference.iter().fold((1.0f64, 0.0f64), |(low, high), &x| (low.min(x), high.max(x)));
        assert!(low > 0.05 && high <= 1.0, "{low} to {high}");
        assert!(picture(&random(100, 1)).contains(&0.0));
    }
}
