//! The colours of all pictures: cobalt on white glaze.

/// Red, green, blue.
pub type Colour = [u8; 3];

/// The page.
pub const PAPER: Colour = [251, 250, 247];
/// The ground of panels: a shade whiter than the page.
pub const GLAZE: Colour = [255, 255, 255];
/// Titles.
pub const INK: Colour = [32, 40, 52];
/// Labels and frames.
pub const SLATE: Colour = [104, 114, 128];
/// Lines that only guide the eye.
pub const MIST: Colour = [223, 228, 235];
/// The one accent.
pub const COBALT: Colour = [24, 72, 160];

/// Curves and bars beside each other, told apart by lightness too: cobalt, ochre, copper green, manganese, sky, iron.
pub const SERIES: [Colour; 6] = [COBALT, [217, 152, 35], [46, 125, 90], [122, 62, 130], [112, 164, 216], [170, 70, 48]];

/// From white glaze over cobalt to nearly black, evenly in lightness; `ink` in 0 to 1.
pub fn glaze_to_cobalt(ink: f64) -> Colour {
    const STOPS: [[f64; 3]; 5] =
        [[255.0, 255.0, 255.0], [190.0, 208.0, 236.0], [108.0, 146.0, 207.0], [28.0, 78.0, 164.0], [8.0, 22.0, 62.0]];
    let place = ink.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let left = (place as usize).min(STOPS.len() - 2);
    let right = place - left as f64;
    std::array::from_fn(|i| (STOPS[left][i] * (1.0 - right) + STOPS[left + 1][i] * right).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ink_only_darkens() {
        let light = |ink: i32| glaze_to_cobalt(ink as f64 / 100.0).map(i32::from).iter().sum::<i32>();
        assert!((0..100).all(|ink| light(ink) > light(ink + 1)));
        assert_eq!(glaze_to_cobalt(-1.0), GLAZE);
        assert_eq!(glaze_to_cobalt(2.0), glaze_to_cobalt(1.0));
    }
}
