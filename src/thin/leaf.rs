//! The points of a leaf and the boxes of a node, in lanes: loops of constant length, of which compilers make vectors.

/// The most points of a leaf. Of 8, 16 and 32, measured, 16 takes the least time.
pub(super) const POINTS: usize = 16;

/// The boxes of a node.
pub(super) const BOXES: usize = 8;

/// A point of the cloud, or the best that there is of several: the square of its distance from the selected points, and
/// its index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Farthest {
    pub squared: f64,
    pub index: u32,
}

/// What `N` places know of their farthest point, each of its own.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Lanes<const N: usize> {
    squared: [f64; N],
    index: [u32; N],
}

impl<const N: usize> Lanes<N> {
    /// Places without a point: farther than none, behind all.
    const EMPTY: Self = Self { squared: [0.0; N], index: [u32::MAX; N] };

    fn set(&mut self, lane: usize, point: Farthest) {
        (self.squared[lane], self.index[lane]) = (point.squared, point.index);
    }

    /// The farthest of all, the lowest index on ties. `N` is a power of two.
    #[inline(always)]
    fn farthest(&self) -> Farthest {
        let squared = halved(self.squared, |a, b| if a > b { a } else { b });
        let mut index = self.index;
        for (index, own) in index.iter_mut().zip(self.squared) {
            *index = if own == squared { *index } else { u32::MAX };
        }
        Farthest { squared, index: halved(index, u32::min) }
    }
}

/// The best of all lanes, by halves.
#[inline(always)]
fn halved<T: Copy, const N: usize>(mut lanes: [T; N], best: impl Fn(T, T) -> T) -> T {
    let mut half = N / 2;
    while half > 0 {
        for lane in 0..half {
            lanes[lane] = best(lanes[lane], lanes[lane + half]);
        }
        half /= 2;
    }
    lanes[0]
}

/// What becomes of a point's distance when one is selected that is nearer than all before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Nearer {
    /// It is the distance from that one.
    Distance,
    /// It is 0: the point is out.
    Zero,
}

/// A few points that are near each other.
#[derive(Clone, Debug)]
pub(super) struct Leaf<const D: usize> {
    known: Lanes<POINTS>,
    /// Lanes without a point repeat one: they are in the box.
    places: [[f32; POINTS]; D],
}

impl<const D: usize> Leaf<D> {
    /// A leaf of 1 to [`POINTS`] points, all this far from what is selected.
    pub fn new(points: &[([f32; D], u32)], squared: f64) -> Self {
        let mut leaf = Self { known: Lanes::EMPTY, places: points[0].0.map(|x| [x; POINTS]) };
        for (lane, &(place, index)) in points.iter().enumerate() {
            leaf.known.set(lane, Farthest { squared, index });
            (0..D).for_each(|axis| leaf.places[axis][lane] = place[axis]);
        }
        leaf
    }

    /// The farthest point.
    #[inline(always)]
    pub fn farthest(&self) -> Farthest {
        self.known.farthest()
    }

    /// Takes note of a selected place.
    #[inline(always)]
    pub fn select(&mut self, place: &[f64; D], nearer: Nearer) {
        let mut squared = [0.0; POINTS];
        for (xs, from) in self.places.iter().zip(place) {
            for (squared, &x) in squared.iter_mut().zip(xs) {
                let difference = f64::from(x) - from;
                *squared += difference * difference;
            }
        }
        for (known, squared) in self.known.squared.iter_mut().zip(squared) {
            let then = if nearer == Nearer::Distance { squared } else { 0.0 };
            *known = if squared < *known { then } else { *known };
        }
    }
}

/// Eight boxes of points, and the farthest point of each.
#[derive(Clone, Debug)]
pub(super) struct Node<const D: usize> {
    known: Lanes<BOXES>,
    low: [[f32; BOXES]; D],
    high: [[f32; BOXES]; D],
}

/// A box of points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent<const D: usize> {
    low: [f32; D],
    high: [f32; D],
}

impl<const D: usize> Extent<D> {
    /// The box around points, of which there is at least one.
    pub fn of(places: impl Iterator<Item = [f32; D]>) -> Self {
        places.map(|place| Self { low: place, high: place }).reduce(Self::around).expect("there is a point")
    }

    fn around(self, other: Self) -> Self {
        let low = std::array::from_fn(|axis| self.low[axis].min(other.low[axis]));
        Self { low, high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])) }
    }

    /// The axis along which it is longest.
    pub fn longest_axis(&self) -> usize {
        let length = |axis: usize| f64::from(self.high[axis]) - f64::from(self.low[axis]);
        (0..D).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0)
    }
}

impl<const D: usize> Node<D> {
    /// The node of 1 to [`BOXES`] boxes, and the box around all of them.
    pub fn new(boxes: &[(Extent<D>, Farthest)]) -> (Self, Extent<D>) {
        let mut node = Self { known: Lanes::EMPTY, low: [[0.0; BOXES]; D], high: [[0.0; BOXES]; D] };
        for (lane, &(extent, farthest)) in boxes.iter().enumerate() {
            node.known.set(lane, farthest);
            for axis in 0..D {
                (node.low[axis][lane], node.high[axis][lane]) = (extent.low[axis], extent.high[axis]);
            }
        }
        let around = boxes.iter().map(|&(extent, _)| extent).reduce(Extent::around).expect("there is a box");
        (node, around)
    }

    /// The farthest point.
    #[inline(always)]
    pub fn farthest(&self) -> Farthest {
        self.known.farthest()
    }

    /// Takes note of the farthest point of a box.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, farthest: Farthest) {
        self.known.set(lane, farthest);
    }

    /// The boxes that are nearer to a place than their farthest point to the selected ones, a bit each: in the others it is
    /// nearer to none. Differences, squares and sums are those of [`Leaf::select`], so they are rounded alike.
    #[inline(always)]
    pub fn reached(&self, place: &[f64; D]) -> u32 {
        let mut squared = [0.0; BOXES];
        for (from, (low, high)) in place.iter().zip(self.low.iter().zip(&self.high)) {
            for (squared, (&low, &high)) in squared.iter_mut().zip(low.iter().zip(high)) {
                let (below, above) = (f64::from(low) - from, from - f64::from(high));
                let outside = if below > above { below } else { above };
                let outside = if outside > 0.0 { outside } else { 0.0 };
                *squared += outside * outside;
            }
        }
        let mut reached = 0;
        for (lane, (squared, known)) in squared.into_iter().zip(self.known.squared).enumerate() {
            reached |= u32::from(squared < known) << lane;
        }
        reached
    }
}
