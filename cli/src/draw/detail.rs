//! The search for parts that are worth a closer look.

use azulejo::trace::Ray;
use glam::{Vec2, Vec3};

use super::camera::Window;
use super::stage::{Seen, Stage};

/// Places per side of the grid on which a window is searched.
const GRID: usize = 96;

/// The least distance of a detail from the edge of the outer window, in parts of the outer window.
const MARGIN: f32 = 0.04;

/// The square window of half side `half` inside `outer` that the surface fills best and where it turns most: where its
/// normals vary. Of equal ones the higher wins, as heads are on top.
pub fn most_interesting(stage: &Stage, outer: &Window, half: f32) -> Window {
    let share = |i: usize| (i as f32 + 0.5) / GRID as f32;
    let ray = |i: usize| {
        let place = outer.at(share(i % GRID), share(i / GRID));
        Ray { origin: stage.camera.eye.to_array(), direction: stage.camera.direction(place).to_array() }
    };
    let rays: Vec<_> = (0..GRID * GRID).map(ray).collect();
    let seen = stage.look(&rays);
    let cells = |length: f32| (length * GRID as f32) as usize;
    let reach = [cells(0.5 * half / outer.half.x), cells(0.5 * half / outer.half.y)];
    let inside = reach.map(|reach| reach + cells(MARGIN)..GRID - reach - cells(MARGIN));
    let candidates = inside[1].clone().flat_map(|row| inside[0].clone().map(move |column| [column, row]));
    let score = |[column, row]: [usize; 2]| {
        let rows = row - reach[1]..=row + reach[1];
        let window = rows.flat_map(|row| &seen[row * GRID + column - reach[0]..=row * GRID + column + reach[0]]);
        interest(window) * (1.5 - share(row))
    };
    let best = candidates.map(|cell| (score(cell), cell)).max_by(|a, b| a.0.total_cmp(&b.0));
    let [column, row] = best.map_or([GRID / 2; 2], |(_, cell)| cell);
    Window { centre: outer.at(share(column), share(row)), half: Vec2::splat(half) }
}

fn interest<'a>(window: impl Iterator<Item = &'a Option<Seen>>) -> f32 {
    let (mut all, mut filled, mut normals) = (0.0, 0.0, Vec3::ZERO);
    for seen in window {
        all += 1.0;
        if let Some(seen) = seen {
            filled += 1.0;
            normals += seen.normal;
        }
    }
    let turn = 1.0 - normals.length() / f32::max(filled, 1.0);
    (filled / all).powi(2) * turn
}
