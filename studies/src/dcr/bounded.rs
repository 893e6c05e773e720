//! Sets of a bounded square: what they are like along its boundary, and what its corner looks like.

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::spacing::nearest_distances_2d;
use azulejo::dcr::relax;
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::sets::{FIRST_SEED, METHODS, Method, STARTS, Start};
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::COBALT;
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::output::Output;
use azulejo_cli::summary::Summary;

/// The strips along the boundary, from one `d_max` wide to so many; what lies deeper is the inside.
pub const STRIPS: usize = 4;

/// Places along the boundary per `d_max`, at which the distance from the set is measured.
const PLACES: f64 = 50.0;

/// The side of the picture's part of the domain, in `d_max`.
const SHOWN: f64 = 16.0;

/// The figures of a set. Lengths are in units of `d_max`.
#[derive(Clone, Copy)]
pub struct Quality {
    /// The smallest distance of two points, and the largest of a place from the set: in the domain, and on its boundary.
    pub rho: f64,
    pub cover: f64,
    pub boundary_cover: f64,
    /// The density of each strip over that of the inside. Strips share the boundary: narrow ones beside each other would show
    /// which rows of points they cut, not how many points there are too many.
    pub densities: [f64; STRIPS],
    /// The mean distance to the nearest neighbour in the outermost strip over that of the inside.
    pub spacing: f64,
}

impl Quality {
    /// The figures of points of the unit square.
    pub fn of(context: &Context, points: &[[f32; 2]]) -> Result<Self> {
        let domain = Domain::unit(Boundary::Bounded);
        let unit = domain.hexagonal_distance(points.len());
        let distances = nearest_distances_2d(context, &domain, points, None)?;
        let (mut counts, mut sums) = ([0.0; STRIPS + 1], [0.0; STRIPS + 1]);
        for (point, distance) in points.iter().zip(&distances) {
            let depth = point.iter().map(|&x| f64::from(x.min(1.0 - x))).fold(1.0, f64::min);
            let strip = ((depth / unit) as usize).min(STRIPS);
            counts[strip] += 1.0;
            sums[strip] += distance;
        }
        // The square that a strip of this width leaves.
        let within = |width: usize| (1.0 - 2.0 * unit * width as f64).powi(2);
        let inside = counts[STRIPS] / within(STRIPS);
        let density = |strip: usize| counts[..=strip].iter().sum::<f64>() / (1.0 - within(strip + 1)) / inside;
        Ok(Self {
            rho: distances.iter().copied().fold(f64::INFINITY, f64::min) / unit,
            cover: covering_radius_2d(context, &domain, points, None)? / unit,
            boundary_cover: boundary_cover(points, unit) / unit,
            densities: std::array::from_fn(density),
            spacing: sums[0] / counts[0] / (sums[STRIPS] / counts[STRIPS]),
        })
    }
}

/// The largest distance of a place on the boundary of the unit square from the points; `unit` is about their spacing.
fn boundary_cover(points: &[[f32; 2]], unit: f64) -> f64 {
    let steps = (PLACES / unit).ceil() as usize;
    let sides = (0..2).flat_map(|axis| [0.0, 1.0].map(|end| (axis, end)));
    let farthest = sides.map(|(axis, end)| {
        // Points as (place along the side, distance from it).
        let near = points.iter().map(|point| point.map(f64::from));
        let near =
            near.map(|point| (point[1 - axis], (point[axis] - end).abs())).filter(|(_, away)| *away < 3.0 * unit);
        let mut near: Vec<_> = near.collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let nearest = |step: usize| {
            let place = step as f64 / steps as f64;
            let first = near.partition_point(|(along, _)| *along < place - 3.0 * unit);
            let around = near[first..].iter().take_while(|(along, _)| *along < place + 3.0 * unit);
            around.map(|(along, away)| (along - place).hypot(*away)).fold(f64::INFINITY, f64::min)
        };
        (0..=steps).map(nearest).fold(0.0, f64::max)
    });
    farthest.fold(0.0, f64::max)
}

/// The sets of one size and start, before they are relaxed or after.
pub struct Measured {
    /// None for the sets that are not relaxed.
    pub method: Option<Method>,
    pub start: Start,
    pub count: usize,
    pub sets: Vec<Quality>,
    /// The first set.
    pub first: Vec<[f32; 2]>,
}

impl Measured {
    /// All sizes and starts of the momentum method, and maximal sets as they are.
    pub fn all(context: &Context, sizes: &[(usize, u64)], progress: &Progress) -> Result<Vec<Self>> {
        let relaxed = METHODS.into_iter().filter(|method| !method.is_thesis).map(Some);
        let kinds = relaxed.flat_map(|method| STARTS.map(|start| (method, start))).chain([(None, Start::Kdrt)]);
        let kinds: Vec<_> =
            kinds.flat_map(|(method, start)| sizes.iter().map(move |size| (method, start, size))).collect();
        let mut measured = Vec::new();
        for &(method, start, &(count, sets)) in &kinds {
            measured.push(Self::kind(context, method, start, count, sets)?);
            _ = progress(measured.len() as f64 / kinds.len() as f64);
        }
        Ok(measured)
    }

    fn kind(context: &Context, method: Option<Method>, start: Start, count: usize, sets: u64) -> Result<Self> {
        let domain = Domain::unit(Boundary::Bounded);
        let mut measured = Self { method, start, count, sets: Vec::new(), first: Vec::new() };
        for seed in FIRST_SEED..FIRST_SEED + sets {
            let mut points = start.points(context, domain, count, seed)?;
            if let Some(method) = method {
                points = relax(context, &method.options(domain, seed), &points, None)?.0;
            }
            measured.sets.push(Quality::of(context, &points)?);
            if seed == FIRST_SEED {
                measured.first = points;
            }
        }
        Ok(measured)
    }

    pub fn name(&self) -> &'static str {
        self.method.map_or("not relaxed", |method| method.name)
    }

    /// A figure over the sets.
    pub fn summary(&self, figure: impl Fn(&Quality) -> f64) -> Summary {
        Summary::of(&self.sets.iter().map(figure).collect::<Vec<_>>())
    }
}

/// Draws the lower left corner of some sets of the unit square beside each other, each with its name.
pub fn draw_corners(sets: &[(&str, &[[f32; 2]])], pixels: u32, output: &Output) -> Result<()> {
    const SIDE: f32 = 480.0;
    let mut canvas = Canvas::new(60.0 + (SIDE + 60.0) * sets.len() as f32, SIDE + 130.0, pixels);
    for ((name, points), column) in sets.iter().zip(0u8..) {
        let unit = Domain::unit(Boundary::Bounded).hexagonal_distance(points.len());
        let axis = |label| Axis::linear(label, [0.0, SHOWN], 4);
        let rect = Rect { x: 70.0 + (SIDE + 60.0) * f32::from(column), y: 60.0, width: SIDE, height: SIDE };
        let panel = Panel { rect, x: axis("x / d_max"), y: axis("") };
        panel.ground(&mut canvas, false);
        let dots = points.iter().map(|point| point.map(|x| f64::from(x) / unit));
        let dots = dots.filter(|dot| dot.iter().all(|&x| x < SHOWN + 1.0)).map(|dot| panel.place(dot));
        canvas.discs(dots, 0.24 / SHOWN as f32 * SIDE, COBALT, rect);
        panel.axes(&mut canvas);
        panel.title(&mut canvas, name, "");
    }
    canvas.write(output)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square lattice of 40 by 40 points, half a cell from the boundary.
    #[test]
    fn a_lattice_has_the_figures_that_are_known_of_it() {
        let at = |k: usize| [k % 40, k / 40].map(|i| (i as f32 + 0.5) / 40.0);
        let lattice: Vec<_> = (0..1600).map(at).collect();
        let context = Context::new(1).unwrap();
        let unit = Domain::unit(Boundary::Bounded).hexagonal_distance(1600);
        let side = 0.025 / unit;
        let even = Quality::of(&context, &lattice).unwrap();
        assert!((even.rho - side).abs() < 1e-5 && (even.spacing - 1.0).abs() < 1e-5);
        assert!((even.cover - side / 2f64.sqrt()).abs() < 1e-5 && (even.boundary_cover - even.cover).abs() < 1e-5);
        // The first strip has the outermost ring of points, the second the next as well.
        let strip = |width: f64| 1.0 - (1.0 - 2.0 * unit * width).powi(2);
        let inside = 32.0 * 32.0 / (1.0 - 8.0 * unit).powi(2);
        assert!((even.densities[0] - 4.0 * 39.0 / strip(1.0) / inside).abs() < 1e-9, "{:?}", even.densities);
        assert!((even.densities[1] - 4.0 * (39.0 + 37.0) / strip(2.0) / inside).abs() < 1e-9, "{:?}", even.densities);

        // Without the points along one side.
        let bare = Quality::of(&context, &lattice[40..]).unwrap();
        assert!(bare.densities[0] < 0.8 * even.densities[0] && bare.boundary_cover > 2.0 * even.boundary_cover);
    }
}
