//! Finding what is worth a closer look.

use azulejo::trace::Ray;
use glam::{Vec2, Vec3};

use super::camera::Window;
use super::stage::{Seen, Stage};

/// Places per side of the grid on which a window is searched.
const GRID: usize = 96;

/// The square window of half side `half` inside `outer` that is filled best by the surface and where the surface turns
/// most: its normals vary.
pub fn most_interesting(stage: &Stage, outer: &Window, half: f32) -> Window {
    let share = |i: usize| (i as f32 + 0.5) / GRID as f32;
    let ray = |i: usize| {
        let place = outer.at(share(i % GRID), share(i / GRID));
        Ray { origin: stage.camera.eye.to_array(), direction: stage.camera.direction(place).to_array() }
    };
    let rays: Vec<_> = (0..GRID * GRID).map(ray).collect();
    let seen = stage.look(&rays);
    let reach = [half / outer.half.x, half / outer.half.y].map(|part| (0.5 * part * GRID as f32) as usize);
    let candidates =
        (reach[1]..GRID - reach[1]).flat_map(|row| (reach[0]..GRID - reach[0]).map(move |column| [column, row]));
    let score = |[column, row]: [usize; 2]| {
        let rows = row - reach[1]..=row + reach[1];
        let window = rows.flat_map(|row| &seen[row * GRID + column - reach[0]..=row * GRID + column + reach[0]]);
        interest(window)
    };
    let best = candidates.max_by(|&a, &b| score(a).total_cmp(&score(b))).unwrap_or([GRID / 2; 2]);
    let centre = outer.at(share(best[0]), share(best[1]));
    Window { centre, half: Vec2::splat(half) }.moved_into(outer)
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
    (filled / all).powi(3) * turn
}
