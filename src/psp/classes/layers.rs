//! The balls that keep the samples of a group of classes apart.
//!
//! A *layer* holds the samples of some classes, all with balls of one radius: a grid of the fill. A dart of a class is
//! tested in the layers of its class. There is one for each of its radii to others, but layers are shared where
//! possible: a ball that is smaller than the radius of two classes changes nothing. Classes of equal own radii with
//! Wei's cross radii have a layer each, of their own samples, and one for all of them and all earlier classes. Two such
//! classes have instead a layer each of the other's samples: no more balls for a sample, and half as many to test.

use crate::classes::Classes;

/// Balls of one radius around the samples of some classes.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    pub radius: f64,
    /// A bit for each class whose samples have balls.
    pub of: u32,
    /// A bit for each class that the balls keep out.
    users: u32,
}

/// The layers of a group of classes that have one own radius.
#[derive(Debug)]
pub struct Layers {
    pub all: Vec<Layer>,
    /// The layers of each class of the group, by the number of the class. The first one has the own radius and is of
    /// this class alone; the others follow by decreasing radius.
    pub of_class: Vec<Vec<usize>>,
}

impl Layers {
    /// The layers that a group needs if its own radius and those between its classes are multiplied by `scale`. Classes
    /// that come later have no samples yet.
    pub fn new(classes: &Classes, group: &[usize], scale: f64) -> Self {
        let is_there = |&i: &usize| classes.own(i) >= classes.own(group[0]);
        let own = classes.own(group[0]) * scale;
        let radius = |i: usize, j: usize| classes.radius(i, j) * if group.contains(&i) { scale } else { 1.0 };
        let among = |j: usize, holds: &dyn Fn(f64) -> bool| {
            (0..classes.count()).filter(is_there).filter(|&i| holds(radius(i, j))).fold(0, |of, i| of | 1 << i)
        };
        let own_layer = |&j: &usize| Layer { radius: own, of: among(j, &|radius| radius == own), users: 1 << j };
        let mut all: Vec<Layer> = group.iter().map(own_layer).collect();
        let mut of_class = vec![Vec::new(); classes.count()];
        (0..).zip(group).for_each(|(layer, &j)| of_class[j].push(layer));
        for &j in group {
            let mut radii: Vec<f64> = (0..classes.count()).filter(is_there).map(|i| radius(i, j)).collect();
            radii.retain(|&radius| radius > 0.0 && radius != own);
            radii.sort_by(|a, b| b.total_cmp(a));
            radii.dedup();
            for radius in radii {
                let of = among(j, &|other| other == radius);
                // The classes whose samples may have balls of the radius: they change nothing for these users, or are
                // required.
                let harmless = |users: u32| {
                    (0..classes.count())
                        .filter(|user| users >> user & 1 == 1)
                        .fold(u32::MAX, |all, user| all & among(user, &|other| other >= radius))
                };
                let is_harmless =
                    |layer: &Layer| group.len() > 2 && (layer.of | of) & !harmless(layer.users | 1 << j) == 0;
                let fits = |layer: &Layer| layer.radius == radius && (layer.of == of || is_harmless(layer));
                let shared = (group.len()..all.len()).find(|&layer| fits(&all[layer])).unwrap_or_else(|| {
                    all.push(Layer { radius, of: 0, users: 0 });
                    all.len() - 1
                });
                all[shared].of |= of;
                all[shared].users |= 1 << j;
                of_class[j].push(shared);
            }
        }
        Self { all, of_class }
    }

    /// The largest radius of all layers.
    pub fn largest(&self) -> f64 {
        self.all.iter().map(|layer| layer.radius).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// For any matrix, each class is kept out by each earlier class and its own group at their radius, and by none at a
    /// larger one.
    #[test]
    fn layers_say_what_the_matrix_says() {
        let mut shared = 0;
        for case in 0..500 {
            let mut rng = Rng::at(case, Draw::Probe, &[]);
            let count = 1 + rng.below(7) as usize;
            let mut radii = vec![0.0; count * count];
            for i in 0..count {
                for j in 0..=i {
                    let radius = [0.0, 0.5, 0.7, 1.0, 2.0][rng.below(5) as usize];
                    radii[i * count + j] = if i == j { f64::max(radius, 0.5) } else { radius };
                    radii[j * count + i] = radii[i * count + j];
                }
            }
            let classes = Classes::new(count, &radii).unwrap();
            for group in classes.groups() {
                let layers = Layers::new(&classes, &group, 1.0);
                shared += layers.all.iter().filter(|layer| layer.users.count_ones() > 1).count();
                for &j in &group {
                    let first = &layers.all[layers.of_class[j][0]];
                    assert_eq!((first.radius, first.users), (classes.own(j), 1 << j));
                    for i in 0..count {
                        let mine = layers.of_class[j].iter().map(|&layer| &layers.all[layer]);
                        let largest = mine.filter(|layer| layer.of >> i & 1 == 1).map(|layer| layer.radius);
                        let expected = if classes.own(i) >= classes.own(j) { classes.radius(i, j) } else { 0.0 };
                        assert_eq!(largest.fold(0.0, f64::max), expected, "{classes:?} {i} {j}");
                    }
                }
            }
        }
        assert!(shared > 100);
    }

    #[test]
    fn with_cross_radii_of_wei_a_group_shares_one_layer() {
        for factor in [1.0, 0.7] {
            let classes = Classes::of_radii(&[1.0, 0.5, 0.5, 0.5], factor).unwrap();
            let layers = Layers::new(&classes, &[1, 2, 3], 1.0);
            assert_eq!(layers.all.len(), 4);
            assert_eq!(layers.all[3].of, 0b1111);
            assert_eq!(layers.of_class, [vec![], vec![0, 3], vec![1, 3], vec![2, 3]]);
            let layers = Layers::new(&Classes::of_radii(&[1.0, 0.5], factor).unwrap(), &[1], 1.0);
            assert_eq!(layers.all[1].of, 0b01, "own samples are covered by the own layer");
        }
        let pair = Layers::new(&Classes::of_radii(&[1.0; 2], 1.0).unwrap(), &[0, 1], 1.0);
        assert_eq!(pair.all.iter().map(|layer| layer.of).collect::<Vec<_>>(), [0b01, 0b10, 0b10, 0b01]);
        assert_eq!(Layers::new(&Classes::of_radii(&[1.0; 3], 0.0).unwrap(), &[0, 1, 2], 1.0).all.len(), 3);
    }
}
