//! Fill blocks where the radius varies: the leaves of a random kd-tree, as large as their radii require, and the order in which
//! they are filled.
//!
//! Octaves of small radii come first, so that a sample of a large radius does not displace many of small ones where the radius
//! changes fast. In an octave blocks that matter to each other have different colours.

use crate::error::Result;
use crate::job::Job;
use crate::math::cbrt;
use crate::plane::{Lattice, Rect};
use crate::points::{Boundary, MAXIMAL_DENSITY_IN_SPACE};
use crate::rng::{Draw, Rng, hash};
use crate::volume::adaptive::field::RadiusField;

/// The shortest side of a block, in its smallest radii, where the domain is wider. Sides are random, below twice this.
const SHORTEST: f64 = 9.0;

/// Darts also fall around a block, up to its smallest radius, if no radius there is below this share of it.
const RIVALS: f64 = 0.75;

/// A tree has no more nodes than there may be samples, divided by this: while a list of nodes grows, it takes three times the
/// bytes of a node, of which a sample has one and a half times as many.
const SAMPLES_PER_NODE: f64 = 4.0;

/// The nodes after which the call can be cancelled.
const NODES_PER_REPORT: usize = 1024;

/// A block whose samples matter to another one: its number, and the displacement of its image.
pub type Neighbour = (u32, [i32; 3]);

/// A block.
pub struct Block {
    pub rect: Rect<3>,
    /// The key of its random numbers.
    pub key: u64,
    /// Bounds of the radius in it.
    pub bounds: [f64; 2],
    /// The approximate number of samples in it.
    pub expected: f64,
    /// The lattice points that first darts fall on, and bounds of the radius there.
    pub region: Rect<3>,
    pub around: [f64; 2],
    /// The blocks whose samples may matter to it, also itself if images of its own do.
    pub neighbours: Vec<Neighbour>,
    /// The displacements of images of its own samples that may matter to it.
    pub images: Vec<[i32; 3]>,
}

/// A node of the tree.
struct Node {
    rect: Rect<3>,
    key: u64,
    bounds: [f64; 2],
    /// The numbers of its children, or of its block.
    next: Next,
}

enum Next {
    Halves([u32; 2]),
    Block(u32),
}

/// The blocks of a domain.
pub struct Blocks {
    pub blocks: Vec<Block>,
    /// For each octave, from small radii to large ones, the blocks of each colour.
    pub octaves: Vec<Vec<Vec<u32>>>,
    /// The approximate number of samples.
    pub expected: f64,
    /// The approximate number of samples in and around the block that has the most of them.
    pub most_standing: f64,
}

impl Blocks {
    /// The blocks of a lattice, which depend on the seed. Fails if there are more samples than `limit`, or if radii that change
    /// fast ask for blocks without end.
    pub fn new(job: &Job, lattice: &Lattice<3>, field: &RadiusField, seed: u64, limit: f64) -> Result<Self> {
        let (nodes, mut blocks) = tree(job, lattice, field, seed, limit)?;
        let images = images(lattice);
        let near = job.map(blocks.len(), |number| {
            let block = &blocks[number];
            images.iter().flat_map(|&image| neighbours(&nodes, number, block, image, field)).collect::<Vec<_>>()
        })?;
        for (number, (block, near)) in blocks.iter_mut().zip(near).enumerate() {
            let of_own = near.iter().filter(|&&(other, _)| other as usize == number);
            block.images = of_own.map(|&(_, image)| image).collect();
            block.neighbours = near;
        }
        let octaves = octaves(&blocks);
        let expected = blocks.iter().map(|block| block.expected).sum();
        let most_standing = blocks.iter().map(|block| standing(&blocks, block)).fold(0.0, f64::max);
        Ok(Self { blocks, octaves, expected, most_standing })
    }

    /// The radius of a set of one radius that has as many samples, in the units of the domain.
    pub fn mean_radius(&self, lattice: &Lattice<3>) -> f64 {
        let volume: f64 = lattice.size.iter().map(|&size| f64::from(size) * lattice.unit()).product();
        cbrt(MAXIMAL_DENSITY_IN_SPACE * volume / self.expected)
    }
}

/// The tree and its leaves. Too many samples are refused as soon as upper bounds of the radius say so: it grows level by level,
/// and has no leaf that could be counted before it is as large as memory.
fn tree(
    job: &Job,
    lattice: &Lattice<3>,
    field: &RadiusField,
    seed: u64,
    limit: f64,
) -> Result<(Vec<Node>, Vec<Block>)> {
    let rect = lattice.rect();
    let root = Node { rect, key: hash(seed, Draw::Split, &[]), bounds: field.bounds, next: Next::Block(0) };
    let (mut nodes, mut blocks, mut next, mut expected) = (vec![root], Vec::new(), 0, 0.0);
    let mut fewest = fewest_samples(&rect, field.bounds);
    while next < nodes.len() {
        if next.is_multiple_of(NODES_PER_REPORT) {
            job.report(0.0)?;
        }
        let Node { rect, key, bounds: around, .. } = nodes[next];
        let (bounds, samples) = field.in_box(&rect, around);
        field.check()?;
        fewest += fewest_samples(&rect, bounds) - fewest_samples(&rect, around);
        if fewest > limit {
            return Err(field.too_many());
        }
        if nodes.len() as f64 > limit / SAMPLES_PER_NODE {
            field.exceed_work(rect.min);
            field.check()?;
        }
        nodes[next].bounds = bounds;
        if let Some(halves) = split(&rect, key, bounds[0]) {
            nodes[next].next = Next::Halves([0, 1].map(|half| (nodes.len() + half) as u32));
            let halves = [0, 1].map(|half| (halves[half], hash(key, Draw::Split, &[half as u64])));
            nodes.extend(halves.map(|(rect, key)| Node { rect, key, bounds, next: Next::Block(0) }));
        } else {
            nodes[next].next = Next::Block(blocks.len() as u32);
            blocks.push(block(lattice, field, rect, key, bounds, samples));
            expected += samples;
            if expected > limit {
                return Err(field.too_many());
            }
        }
        next += 1;
    }
    Ok((nodes, blocks))
}

/// Refuses largest radii that alone ask for more samples than `limit`, before any work.
pub fn check_largest(lattice: &Lattice<3>, field: &RadiusField, limit: f64) -> Result<()> {
    if fewest_samples(&lattice.rect(), field.bounds) > limit { Err(field.too_many()) } else { Ok(()) }
}

/// The number of samples of a box that has the largest radius of its bounds throughout.
fn fewest_samples(rect: &Rect<3>, [_, most]: [f64; 2]) -> f64 {
    MAXIMAL_DENSITY_IN_SPACE * (0..3).map(|axis| f64::from(rect.length(axis)) / most).product::<f64>()
}

/// The children of a node; none if it is a block: a node is split across its longest side as long as that is long enough.
fn split(rect: &Rect<3>, key: u64, least: f64) -> Option<[Rect<3>; 2]> {
    let shortest = (SHORTEST * least).ceil().min(f64::from(i32::MAX)) as i32;
    let axis = (0..3).max_by_key(|&axis| rect.length(axis))?;
    if rect.length(axis) / 2 < shortest {
        return None;
    }
    let choices = rect.length(axis) - 2 * shortest + 1;
    let edge = rect.min[axis] + shortest + Rng::at(key, Draw::Split, &[]).below(choices as u64) as i32;
    let mut halves = [*rect; 2];
    (halves[0].max[axis], halves[1].min[axis]) = (edge, edge);
    Some(halves)
}

/// A block without neighbours. Its first darts do not cross the seam of a torus, across which the slope need not hold.
fn block(lattice: &Lattice<3>, field: &RadiusField, rect: Rect<3>, key: u64, bounds: [f64; 2], expected: f64) -> Block {
    let margin = bounds[0].ceil().min(f64::from(i32::MAX / 4)) as i32;
    let (mut region, mut around) = (rect.grown(margin).intersection(&lattice.rect()), bounds);
    if region != rect {
        let ([least, most], _) = field.in_box(&region, field.bounds);
        if least >= RIVALS * bounds[0] {
            around = [least.min(bounds[0]), most.max(bounds[1])];
        } else {
            region = rect;
        }
    }
    let (neighbours, images) = Default::default();
    Block { rect, key, bounds, expected, region, around, neighbours, images }
}

/// The displacements of the images of a domain.
fn images(lattice: &Lattice<3>) -> Vec<[i32; 3]> {
    let is_torus = lattice.boundary == Boundary::Periodic;
    let along = |axis: usize| if is_torus { vec![-lattice.size[axis], 0, lattice.size[axis]] } else { vec![0] };
    let (x, y, z) = (&along(0), &along(1), &along(2));
    z.iter().flat_map(|&z| y.iter().flat_map(move |&y| x.iter().map(move |&x| [x, y, z]))).collect()
}

/// The square of the distance of the nearest lattice points of two boxes.
fn square_between(a: &Rect<3>, b: &Rect<3>) -> f64 {
    let along = |axis: usize| {
        let apart = (i64::from(b.min[axis]) - i64::from(a.max[axis]) + 1)
            .max(i64::from(a.min[axis]) - i64::from(b.max[axis]) + 1);
        apart.max(0) as f64
    };
    (0..3).map(|axis| along(axis) * along(axis)).sum()
}

/// The blocks of the tree whose images, moved by a displacement, may have samples that matter to a block.
fn neighbours(nodes: &[Node], number: usize, block: &Block, image: [i32; 3], field: &RadiusField) -> Vec<Neighbour> {
    let moved = block.region.translated(image.map(|x| -x));
    let (mut found, mut left) = (Vec::new(), vec![0u32]);
    while let Some(node) = left.pop() {
        let Node { rect, bounds, next, .. } = &nodes[node as usize];
        // Wider by more than rounding.
        let reach = 0.5 * (bounds[1] + block.around[1]) + field.slack(bounds[1].max(block.around[1])) + 2.0;
        if square_between(&moved, rect) > reach * reach {
            continue;
        }
        match *next {
            Next::Halves(halves) => left.extend(halves),
            Next::Block(other) if other as usize == number && image == [0; 3] => (),
            Next::Block(other) => found.push((other, image)),
        }
    }
    found.sort_unstable();
    found
}

/// The approximate number of samples of a block and of its neighbours that may matter to it: a neighbour has them in the part of
/// it that lies near.
fn standing(blocks: &[Block], block: &Block) -> f64 {
    let part_of = |&(other, image): &Neighbour| {
        let other = &blocks[other as usize];
        let reach = (0.5 * (other.bounds[1] + block.around[1])).min(f64::from(i32::MAX / 4)) as i32;
        let near = other.rect.translated(image).intersection(&block.region.grown(reach));
        let along = |axis: usize| f64::from(near.length(axis).max(0)) / f64::from(other.rect.length(axis));
        other.expected * (0..3).map(along).product::<f64>()
    };
    block.expected + block.neighbours.iter().map(part_of).sum::<f64>()
}

/// The blocks by octaves of their smallest radii, and in an octave by colours, in the order of their random ranks: each has the
/// first colour that no neighbour has.
fn octaves(blocks: &[Block]) -> Vec<Vec<Vec<u32>>> {
    // The exponent of a float above 0.
    let octave = |block: u32| blocks[block as usize].bounds[0].to_bits() >> 52;
    let rank = |block: u32| (hash(blocks[block as usize].key, Draw::Priority, &[]), block);
    let mut order: Vec<u32> = (0..blocks.len() as u32).collect();
    order.sort_unstable_by_key(|&block| (octave(block), rank(block)));
    // Neighbours are mutual: the farther reach of the two counts.
    let mut near: Vec<Vec<u32>> =
        blocks.iter().map(|block| block.neighbours.iter().map(|near| near.0).collect()).collect();
    for (number, block) in (0..).zip(blocks) {
        block.neighbours.iter().for_each(|&(other, _)| near[other as usize].push(number));
    }
    let (mut colours, mut octaves) = (vec![None; blocks.len()], Vec::new());
    for members in order.chunk_by(|&a, &b| octave(a) == octave(b)) {
        let mut waves = Vec::<Vec<u32>>::new();
        for &block in members {
            let others = &near[block as usize];
            // Blocks of other octaves have colours of another number.
            let is_free = |&colour: &usize| {
                others.iter().all(|&other| other == block || colours[other as usize] != Some((octaves.len(), colour)))
            };
            let colour = (0..waves.len()).find(is_free).unwrap_or(waves.len());
            colours[block as usize] = Some((octaves.len(), colour));
            if colour == waves.len() {
                waves.push(Vec::new());
            }
            waves[colour].push(block);
        }
        octaves.push(waves);
    }
    octaves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::job::Context;
    use crate::points::Domain;
    use crate::volume::adaptive::field::Source;
    use crate::volume::adaptive::options::Radius;

    /// The error of the tree of a radius that is the same everywhere, of which the bounds do not say so.
    fn refusal(radius: f64, slope: f64) -> Error {
        let domain = Domain::unit(Boundary::Periodic);
        let at = |_: [f64; 3]| radius;
        let source = Source::new(&domain, Radius::Function { at: &at, smallest: 1e-5, largest: 1.0, slope }).unwrap();
        let lattice = Lattice::of_any_size(&domain, 1e-5).unwrap();
        let field = RadiusField::new(&source, &lattice).unwrap();
        let context = Context::new(1).unwrap();
        context.run(None, |job| tree(job, &lattice, &field, 0, 4e3).map(|(nodes, _)| nodes.len())).unwrap_err()
    }

    #[test]
    fn trees_without_end_are_refused() {
        let too_small = refusal(1e-3, 1e-3).to_string();
        assert!(too_small.starts_with("radius_function: asks for more samples"), "{too_small}");
        let too_steep = refusal(0.1, 5.0).to_string();
        assert!(too_steep.starts_with("slope") && too_steep.contains("change too fast"), "{too_steep}");
    }
}
