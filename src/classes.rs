//! Classes of samples that keep different distances from each other: the matrix of these distances.
//!
//! Wei 2010, "Multi-class blue noise sampling", §3; the thesis names them as future work (§3.4.6, ch. 5).

use crate::check;
use crate::error::{Error, Result};
use crate::math::square;

/// The smallest distances between samples of two classes: a symmetric matrix r_ij. Where r_ij is 0 the two classes
/// ignore each other; r_ii is a class's *own* radius, above 0.
///
/// A set of several classes has no two samples of classes i and j nearer than r_ij, and no class can take another
/// sample: for each class i every place is within r_ij of some sample of some class j.
#[derive(Clone, Debug, PartialEq)]
pub struct Classes {
    count: usize,
    /// Row by row.
    radii: Vec<f64>,
}

impl Classes {
    /// The largest number of classes.
    pub const MOST: usize = 16;

    /// The classes of a matrix, row by row.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no classes or more than [`Classes::MOST`], and for a matrix that does not have
    /// `count` rows of `count` numbers, is not symmetric, or has entries that are negative, not finite, or on the
    /// diagonal 0.
    pub fn new(count: usize, radii: &[f64]) -> Result<Self> {
        check_count(count)?;
        if radii.len() != count * count {
            let reason = format!("{} numbers, but {count} classes have {}", radii.len(), count * count);
            return Err(Error::invalid("radii", reason));
        }
        for (index, &radius) in radii.iter().enumerate() {
            let (i, j) = (index / count, index % count);
            let fails = |what: String| Err(Error::invalid("radii", format!("[{i}][{j}] is {radius:?}, {what}")));
            if !(0.0..f64::INFINITY).contains(&radius) {
                return fails("not a finite number from 0 on".to_owned());
            }
            if i == j && radius == 0.0 {
                return fails("but a class keeps its own samples apart".to_owned());
            }
            let other = radii[j * count + i];
            if radius != other {
                return fails(format!("but [{j}][{i}] is {other:?}"));
            }
        }
        Ok(Self { count, radii: radii.to_vec() })
    }

    /// Classes of these own radii, with Wei's cross radii times a factor: two classes keep the distance that a set of
    /// all samples of both, and of all classes of larger radii, would have. Smaller factors leave each class nearer to
    /// the density that it has alone, and let samples of two classes come nearer.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no radii or more than [`Classes::MOST`], for one that is not positive and finite,
    /// and for a factor that is negative or not finite.
    pub fn of_radii(own: &[f64], factor: f64) -> Result<Self> {
        let count = own.len();
        check_count(count)?;
        if let Some(index) = own.iter().position(|radius| !(*radius > 0.0 && radius.is_finite())) {
            let reason = format!("[{index}] is {:?}, not a positive finite number", own[index]);
            return Err(Error::invalid("own", reason));
        }
        check::from_zero("factor", factor)?;
        // The density of all classes whose radii are no smaller, relative to that of the smallest radius: squares of
        // quotients stay in range.
        let smallest = own.iter().copied().fold(f64::INFINITY, f64::min);
        let density_down_to = |radius: f64| -> f64 {
            own.iter().filter(|&&other| other >= radius).map(|other| square(smallest / other)).sum()
        };
        let mut radii = Vec::with_capacity(count * count);
        for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
            let cross = || factor * smallest / density_down_to(own[i].min(own[j])).sqrt();
            radii.push(if i == j { own[i] } else { cross() });
        }
        Self::new(count, &radii)
    }

    /// The number of classes.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The smallest distance between samples of two classes; 0 if they ignore each other.
    pub fn radius(&self, i: usize, j: usize) -> f64 {
        self.radii[i * self.count + j]
    }

    /// The smallest distance between samples of one class.
    pub fn own(&self, class: usize) -> f64 {
        self.radius(class, class)
    }

    /// The matrix, row by row.
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// The classes by decreasing own radius; those of equal radii in one group, in their order.
    pub(crate) fn groups(&self) -> Vec<Vec<usize>> {
        let mut classes: Vec<usize> = (0..self.count).collect();
        classes.sort_by(|&a, &b| self.own(b).total_cmp(&self.own(a)));
        classes.chunk_by(|&a, &b| self.own(a) == self.own(b)).map(<[usize]>::to_vec).collect()
    }
}

fn check_count(count: usize) -> Result<()> {
    if (1..=Classes::MOST).contains(&count) {
        return Ok(());
    }
    Err(Error::invalid("count", format!("{count} classes; there are 1 to {}", Classes::MOST)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wei's construction as he writes it: group by group, adding up densities.
    fn by_wei(own: &[f64]) -> Vec<f64> {
        let mut groups: Vec<f64> = own.to_vec();
        groups.sort_by(|a, b| b.total_cmp(a));
        groups.dedup();
        let (mut matrix, mut density, mut processed) = (vec![0.0; own.len().pow(2)], 0.0, Vec::<usize>::new());
        for radius in groups {
            let group: Vec<usize> = (0..own.len()).filter(|&i| own[i] == radius).collect();
            processed.extend(&group);
            density += group.len() as f64 / radius.powi(2);
            for (&i, &j) in group.iter().flat_map(|i| processed.iter().map(move |j| (i, j))) {
                let cross = if i == j { radius } else { density.sqrt().recip() };
                matrix[i * own.len() + j] = cross;
                matrix[j * own.len() + i] = cross;
            }
        }
        matrix
    }

    #[test]
    fn cross_radii_are_those_of_wei() {
        for own in [&[1.0][..], &[1.0, 1.0], &[0.5, 1.0, 0.25], &[0.3, 0.3, 0.1, 0.7, 0.1, 0.3]] {
            let classes = Classes::of_radii(own, 1.0).unwrap();
            for (radius, expected) in classes.radii().iter().zip(by_wei(own)) {
                assert!((radius / expected - 1.0).abs() < 1e-14, "{own:?}: {radius} for {expected}");
            }
            let half = Classes::of_radii(own, 0.5).unwrap();
            let count = own.len();
            for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
                let expected = if i == j { own[i] } else { 0.5 * classes.radius(i, j) };
                assert_eq!(half.radius(i, j), expected);
            }
        }
        // Extreme radii neither overflow nor vanish.
        let extreme = Classes::of_radii(&[1e300, 1e-300], 1.0).unwrap();
        assert_eq!(extreme.radius(0, 1), 1e-300);
    }

    #[test]
    fn groups_are_by_falling_radius() {
        let classes = Classes::of_radii(&[0.25, 1.0, 0.5, 1.0, 0.25], 1.0).unwrap();
        assert_eq!(classes.groups(), [vec![1, 3], vec![2], vec![0, 4]]);
    }

    #[test]
    fn what_is_no_matrix_is_refused_by_its_entry() {
        let said = |count, radii: &[f64]| Classes::new(count, radii).unwrap_err().to_string();
        assert_eq!(said(0, &[]), "count: 0 classes; there are 1 to 16");
        assert_eq!(said(17, &[1.0; 289]), "count: 17 classes; there are 1 to 16");
        assert_eq!(said(2, &[1.0; 3]), "radii: 3 numbers, but 2 classes have 4");
        assert_eq!(said(2, &[1.0, 0.5, 0.25, 1.0]), "radii: [0][1] is 0.5, but [1][0] is 0.25");
        assert_eq!(said(1, &[0.0]), "radii: [0][0] is 0.0, but a class keeps its own samples apart");
        assert_eq!(said(2, &[1.0, -1.0, -1.0, 1.0]), "radii: [0][1] is -1.0, not a finite number from 0 on");
        assert_eq!(said(1, &[f64::NAN]), "radii: [0][0] is NaN, not a finite number from 0 on");
        let said = |own: &[f64], factor| Classes::of_radii(own, factor).unwrap_err().to_string();
        assert_eq!(said(&[1.0, 0.0], 1.0), "own: [1] is 0.0, not a positive finite number");
        assert_eq!(said(&[1.0], -0.5), "factor: -0.5 is not a finite number from 0 on");
        let zero = Classes::of_radii(&[1.0, 0.5], 0.0).unwrap();
        assert_eq!(zero.radius(0, 1), 0.0);
    }
}
