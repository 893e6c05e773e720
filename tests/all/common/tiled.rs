//! Domains that KDRT tiles.

use azulejo::Domain;

/// The radius with which a domain is the smallest that KDRT tiles with such leaves, or nearly: the domain is as large as
/// the pattern, and wide enough for two leaves (100:1 rectangles have to be longer for that).
pub fn tiled_radius(domain: &Domain, leaf_size: f64) -> f64 {
    let side = (10.0 * leaf_size).clamp(108.0, 200.0).max(4.0 * leaf_size) + 1.0;
    let [width, height] = domain.extent();
    (domain.area().sqrt() / side).min(width.min(height) / 13.1)
}
