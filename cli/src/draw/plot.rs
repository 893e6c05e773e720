//! Panels with axes.

use super::canvas::{Align, Canvas, Rect, Style};
use super::palette::{GLAZE, INK, MIST, SLATE};
use crate::text::rounded;

/// The size of tick labels; axis labels and titles are larger.
const TICK_SIZE: f32 = 17.0;
const LABEL_SIZE: f32 = 19.0;
const TITLE_SIZE: f32 = 27.0;

/// One direction of a panel.
pub struct Axis<'a> {
    /// The quantity along it, and its unit.
    pub label: &'a str,
    /// The values at its ends.
    pub range: [f64; 2],
    /// The approximate number of ticks, where the scale leaves it open; 0 for none.
    pub ticks: usize,
    /// The placement of values along it.
    pub scale: Scale,
}

/// The placement of values along an axis.
#[derive(Clone, Copy, PartialEq)]
pub enum Scale {
    /// Equal steps at equal distances.
    Linear,
    /// Powers of ten at equal distances, with a tick at each.
    Logarithmic,
}

impl Scale {
    fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic => value.log10(),
        }
    }

    fn label(self, value: f64) -> String {
        match self {
            Self::Linear => tick_label(value),
            Self::Logarithmic => format!("10{}", superscript(value.log10().round() as i32)),
        }
    }
}

impl<'a> Axis<'a> {
    /// An axis of equal steps.
    pub fn linear(label: &'a str, range: [f64; 2], ticks: usize) -> Self {
        Self { label, range, ticks, scale: Scale::Linear }
    }

    /// An axis of powers of ten.
    pub fn logarithmic(label: &'a str, range: [f64; 2]) -> Self {
        Self { label, range, ticks: 0, scale: Scale::Logarithmic }
    }

    /// Round numbers in the range.
    fn tick_values(&self) -> Vec<f64> {
        let [low, high] = self.range;
        if self.scale == Scale::Logarithmic {
            let [first, last] = [(low.log10() - 1e-9).ceil(), (high.log10() + 1e-9).floor()].map(|power| power as i32);
            return (first..=last).map(|power| 10f64.powi(power)).collect();
        }
        if self.ticks == 0 {
            return Vec::new();
        }
        let step = round_step((high - low) / self.ticks as f64);
        let (first, last) = ((low / step - 1e-6).ceil() as i64, (high / step + 1e-6).floor() as i64);
        (first..=last).map(|k| k as f64 * step).collect()
    }

    fn share(&self, value: f64) -> f32 {
        let [value, low, high] = [value, self.range[0], self.range[1]].map(|value| self.scale.place(value));
        ((value - low) / (high - low)) as f32
    }
}

/// The nearest of 1, 2, 2.5 and 5 times a power of ten that is not below `step`.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let fits = |factor: &&f64| *factor * power >= step * (1.0 - 1e-9);
    [1.0, 2.0, 2.5, 5.0].iter().find(fits).unwrap_or(&10.0) * power
}

/// A rectangle of the page with two axes.
pub struct Panel<'a> {
    /// The rectangle of the panel on the page.
    pub rect: Rect,
    /// The axis from left to right.
    pub x: Axis<'a>,
    /// The axis from bottom to top.
    pub y: Axis<'a>,
}

impl Panel<'_> {
    /// The place of a value on the page.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f32; 2] {
        [self.rect.x + self.x.share(x) * self.rect.width, self.rect.bottom() - self.y.share(y) * self.rect.height]
    }

    /// The ground, before anything is drawn in the panel, with lines at the ticks of y if `ruled`.
    pub fn ground(&self, canvas: &mut Canvas, ruled: bool) {
        canvas.fill(self.rect, GLAZE);
        for value in self.y.tick_values().into_iter().filter(|_| ruled) {
            let [_, y] = self.place([self.x.range[0], value]);
            canvas.line([[self.rect.x, y], [self.rect.right(), y]], 1.0, MIST);
        }
    }

    /// The frame, the ticks and their labels, over what was drawn.
    pub fn axes(&self, canvas: &mut Canvas) {
        let Rect { x: left, .. } = self.rect;
        let bottom = self.rect.bottom();
        canvas.frame(self.rect, 1.5, SLATE);
        let label = |align, upwards| Style { size: LABEL_SIZE, colour: SLATE, align, upwards };
        let tick = |align| Style { size: TICK_SIZE, ..label(align, false) };
        for value in self.x.tick_values() {
            let [x, _] = self.place([value, self.y.range[0]]);
            canvas.line([[x, bottom], [x, bottom + 7.0]], 1.5, SLATE);
            canvas.text(&self.x.scale.label(value), [x, bottom + 25.0], tick(Align::Centre));
        }
        let mut widest: f32 = 0.0;
        for value in self.y.tick_values() {
            let [_, y] = self.place([self.x.range[0], value]);
            let text = self.y.scale.label(value);
            canvas.line([[left - 7.0, y], [left, y]], 1.5, SLATE);
            canvas.text(&text, [left - 12.0, y + 6.0], tick(Align::Right));
            widest = widest.max(canvas.length(&text, TICK_SIZE));
        }
        let [x, y] = self.rect.centre();
        canvas.text(self.x.label, [x, bottom + 51.0], label(Align::Centre, false));
        // Beside the longest of the tick's labels.
        let beside = (widest + 20.0).max(58.0);
        canvas.text(self.y.label, [left - beside, y], label(Align::Centre, true));
    }

    /// A title above the panel, and a remark at the right end of its line.
    pub fn title(&self, canvas: &mut Canvas, title: &str, remark: &str) {
        let y = self.rect.y - 16.0;
        let style = Style { size: TITLE_SIZE, colour: INK, align: Align::Left, upwards: false };
        canvas.text(title, [self.rect.x, y], style);
        let style = Style { size: LABEL_SIZE, colour: SLATE, align: Align::Right, ..style };
        canvas.text(remark, [self.rect.right(), y], style);
    }
}

fn tick_label(value: f64) -> String {
    rounded(value, 6).replace('-', "\u{2212}")
}

fn superscript(number: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |sign: char| sign.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_range() {
        let ticks = |low, high, ticks| Axis::linear("", [low, high], ticks).tick_values();
        assert_eq!(ticks(0.0, 1.0, 5), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(ticks(-2.5, 2.5, 5), [-2.0, -1.0, 0.0, 1.0, 2.0]);
        assert_eq!(ticks(103.0, 117.0, 3), [105.0, 110.0, 115.0]);
        assert_eq!(ticks(0.0, 0.03, 3), [0.0, 0.01, 0.02, 0.03]);
        assert_eq!(tick_label(-0.5), "−0.5");
    }

    #[test]
    fn a_logarithmic_axis_has_its_ticks_at_powers_of_ten() {
        let axis = Axis::logarithmic("", [0.001, 20.0]);
        let labels: Vec<_> = axis.tick_values().iter().map(|&value| axis.scale.label(value)).collect();
        assert_eq!(labels, ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"]);
        let axis = Axis::logarithmic("", [1e3, 1e7]);
        assert_eq!([1e3, 1e5, 1e7].map(|value| axis.share(value)), [0.0, 0.5, 1.0]);
    }

    #[test]
    fn a_panel_places_values_upwards() {
        let axis = |high| Axis::linear("", [0.0, high], 2);
        let panel = Panel { rect: Rect { x: 10.0, y: 20.0, width: 100.0, height: 50.0 }, x: axis(1.0), y: axis(5.0) };
        assert_eq!(panel.place([0.0, 0.0]), [10.0, 70.0]);
        assert_eq!(panel.place([0.5, 5.0]), [60.0, 20.0]);
    }
}
