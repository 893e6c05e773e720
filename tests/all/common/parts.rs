//! The cuts of a triangle by the checkers.

/// Four quarters of a triangle, or two halves where it is much longer than wide. Its sides are those opposite its corners.
pub fn parts<T: Copy>(corners: [T; 3], sides: [f64; 3], middle: impl Fn(T, T) -> T) -> Vec<[T; 3]> {
    let [a, b, c] = corners;
    let [d, e, f] = [middle(b, c), middle(c, a), middle(a, b)];
    let longest = sides.into_iter().fold(0.0, f64::max);
    let shortest = sides.into_iter().fold(longest, f64::min);
    if 3.0 * shortest > longest {
        vec![[a, f, e], [f, b, d], [e, d, c], [d, e, f]]
    } else if sides[0] == longest {
        vec![[a, b, d], [a, d, c]]
    } else if sides[1] == longest {
        vec![[b, c, e], [b, e, a]]
    } else {
        vec![[c, a, f], [c, f, b]]
    }
}
