//! The boundary with pins and with mirrored points (thesis fig. 4.12): the thesis's relaxation twice, alike but for the
//! points beyond the domain that its triangulation gets.

use std::fmt::Write;

use azulejo::dcr::Thesis;
use azulejo::{Boundary, Context, Domain, Result};
use glam::DVec2;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use crate::dcr::bounded::{Quality, draw_corners};
use crate::dcr::sets::{FIRST_SEED, Start};
use crate::files::Files;
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::progress::watched;
use azulejo_cli::summary::Summary;
use azulejo_cli::text::rounded;

/// The distance of the pins from the centre of the domain, in its sides.
const FAR: f64 = 20.0;
/// The distance from the boundary up to which points are mirrored, in units of d_max: more than a triangle that crosses
/// it.
const MIRRORED: f64 = 4.0;
/// A force within this cosine of the reverse of the one before: the point oscillates (thesis §4.4.2).
const OSCILLATION_COSINE: f64 = 0.95;
/// Pixels per unit of the picture.
const PIXELS: u32 = 2;

/// The points beyond the domain.
#[derive(Clone, Copy)]
enum Beyond {
    /// Four points far away: the hull is convex, and nothing else. They exert no force.
    Pins,
    /// The points near the boundary, mirrored at it.
    Mirrored,
}

const KINDS: [(&str, Beyond); 2] = [("(a) pins far away", Beyond::Pins), ("(b) mirrored points", Beyond::Mirrored)];

/// A vertex of the triangulation: the point that it is, or is the image of; none of a pin.
struct Vertex {
    place: DVec2,
    point: Option<usize>,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.place.x, self.place.y)
    }
}

/// A point, the inverse of its activeness, and the tension that it felt.
#[derive(Clone, Copy)]
struct Particle {
    place: DVec2,
    yielding: f64,
    tension: DVec2,
}

/// The points of the unit square and what is beyond, in the order of the points.
fn vertices(particles: &[Particle], beyond: Beyond, unit: f64) -> Vec<Vertex> {
    let own = particles.iter().enumerate().map(|(index, one)| Vertex { place: one.place, point: Some(index) });
    let mut vertices: Vec<_> = own.collect();
    match beyond {
        Beyond::Pins => {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let pin = |corner: [f64; 2]| DVec2::splat(0.5) + FAR * DVec2::from(corner);
            vertices.extend(corners.map(|corner| Vertex { place: pin(corner), point: None }));
        }
        Beyond::Mirrored => {
            let near = -MIRRORED * unit..1.0 + MIRRORED * unit;
            for (index, DVec2 { x, y }) in particles.iter().map(|one| one.place).enumerate() {
                for image in [-x, x, 2.0 - x].into_iter().flat_map(|x| [-y, y, 2.0 - y].map(|y| DVec2::new(x, y))) {
                    if image != DVec2::new(x, y) && near.contains(&image.x) && near.contains(&image.y) {
                        vertices.push(Vertex { place: image, point: Some(index) });
                    }
                }
            }
        }
    }
    vertices
}

/// One step (thesis §4.2.4, §4.3.5): every edge is visited from both ends, tensions are shared by activeness.
fn step(particles: &[Particle], beyond: Beyond, unit: f64, thesis: &Thesis) -> Vec<Particle> {
    let mesh = DelaunayTriangulation::<Vertex>::bulk_load_stable(vertices(particles, beyond, unit));
    let mesh = mesh.expect("places are finite");
    let force = |offset: DVec2| {
        let distance = offset.length() / unit;
        let over = |radius: f64| (distance - radius) / radius;
        let strength = match distance {
            d if d < thesis.conflict_radius => over(thesis.conflict_radius),
            d if d > thesis.attraction_radius => over(thesis.attraction_radius),
            _ => 0.0,
        };
        strength * offset.normalize_or_zero()
    };
    let moved = |(vertex, particle): (_, &Particle)| {
        let mesh: &DelaunayTriangulation<Vertex> = &mesh;
        let (mut displacement, mut tension, mut tensions) = (DVec2::ZERO, DVec2::ZERO, 0.0);
        for edge in mesh.vertex(vertex).out_edges() {
            let to = edge.to();
            let Some(other) = to.data().point else { continue };
            let force = 2.0 * force(to.data().place - particle.place);
            let sum = particle.yielding + particles[other].yielding;
            displacement += if sum > 0.0 { particle.yielding / sum } else { 0.5 } * force;
            tension += force;
            tensions += force.length();
        }
        let reversed = -tension.dot(particle.tension);
        let oscillates = reversed > OSCILLATION_COSINE * tension.length() * particle.tension.length();
        let yielding = match tensions {
            _ if oscillates => 0.0,
            0.0 => 1.0,
            sum => (tension.length() / sum).min(1.0),
        };
        let place = particle.place + thesis.step * unit * displacement;
        Particle { place: place.clamp(DVec2::ZERO, DVec2::splat(1.0 - f64::EPSILON)), yielding, tension }
    };
    mesh.fixed_vertices().zip(particles).map(moved).collect()
}

fn relaxed(start: &[[f32; 2]], beyond: Beyond, steps: usize) -> Vec<[f32; 2]> {
    let unit = Domain::unit(Boundary::Bounded).hexagonal_distance(start.len());
    let at_rest =
        |point: &[f32; 2]| Particle { place: DVec2::from(point.map(f64::from)), yielding: 1.0, tension: DVec2::ZERO };
    let mut particles: Vec<_> = start.iter().map(at_rest).collect();
    (0..steps).for_each(|_| particles = step(&particles, beyond, unit, &Thesis::default()));
    let inside = |x: f64| (x as f32).min(1.0f32.next_down());
    particles.iter().map(|particle| particle.place.to_array().map(inside)).collect()
}

/// The section.
pub fn section(context: &Context, files: &Files, quick: bool) -> Result<String> {
    let (count, sets, steps) = if quick { (200, 2, 20) } else { (1000, 20, 100) };
    let (single, domain) = (Context::new(1)?, Domain::unit(Boundary::Bounded));
    let work = |task: usize| {
        let (kind, seed) = (KINDS[task / sets].1, FIRST_SEED + (task % sets) as u64);
        let points = relaxed(&Start::Kdrt.points(&single, domain, count, seed)?, kind, steps);
        Ok((Quality::of(&single, &points)?, points))
    };
    let found = watched("pins", |progress| in_parallel(context.num_threads(), KINDS.len() * sets, progress, work))?;
    let found: Vec<_> = found.into_iter().collect::<Result<_>>()?;
    let corners: Vec<_> = (0..KINDS.len()).map(|kind| (KINDS[kind].0, &*found[kind * sets].1)).collect();
    draw_corners(&corners, 1140 * PIXELS, &files.picture("pins")?)?;
    let mut text = format!(
        "## Points beyond the boundary (thesis fig. 4.12)\n\n![pins](figures/pins.png)\n\nThe thesis's relaxation of {count} \
         points of a bounded square, {steps} steps from maximal sets, with four pins far away, which make the hull convex \
         and exert no force, and with mirrored points; means of {sets} sets, and their standard errors. Lengths are in \
         d_max; the strip is that within 1 d_max of the boundary. The thesis says that with pins the points at the boundary \
         are without order, and shows no figures.\n\n\
         | | ρ | cover | cover on the boundary | density of the strip over that inside | mean distance to the nearest, strip \
         over inside |\n|---|---|---|---|---|---|\n"
    );
    for (kind, sets) in KINDS.iter().zip(found.chunks(sets)) {
        let cell = |figure: fn(&Quality) -> f64| {
            let Summary { mean, error, .. } = Summary::of(&sets.iter().map(|set| figure(&set.0)).collect::<Vec<_>>());
            format!("{} ± {}", rounded(mean, 3), rounded(error, 2))
        };
        let cells = [
            cell(|set| set.rho),
            cell(|set| set.cover),
            cell(|set| set.boundary_cover),
            cell(|set| set.densities[0]),
            cell(|set| set.spacing),
        ];
        _ = writeln!(text, "| {} | {} |", kind.0, cells.join(" | "));
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hexagonal patch in the middle of the square keeps its places whatever is beyond: its edges are as long as the
    /// constraints allow.
    #[test]
    fn without_tension_nothing_moves() {
        let unit = Domain::unit(Boundary::Bounded).hexagonal_distance(7);
        let at = |k: u8| DVec2::splat(0.5) + unit * DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_3);
        let places = (0..6).map(at).chain([DVec2::splat(0.5)]);
        let start: Vec<_> = places.map(|place| place.to_array().map(|x| x as f32)).collect();
        assert_eq!(relaxed(&start, Beyond::Pins, 3), start);
    }

    /// A point beside a wall is pushed by its image, and by nothing where there are pins only.
    #[test]
    fn images_push_and_pins_do_not() {
        let start = [[0.01, 0.5], [0.5, 0.5]];
        assert!(relaxed(&start, Beyond::Mirrored, 1)[0][0] > 0.01);
        let (pins, unit) = (relaxed(&start, Beyond::Pins, 1)[0][0], 1.07);
        assert!(pins <= 0.01, "{pins}: two points {unit} apart at most repel each other");
    }
}
