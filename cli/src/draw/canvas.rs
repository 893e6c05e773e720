//! A page to draw on: antialiased shapes, images, and text in an embedded font, so that no font must be installed.

use ab_glyph::{Font, FontRef, OutlineCurve, Point};
use azulejo::Result;
use tiny_skia::{
    Color, FillRule, FilterQuality, IntSize, LineCap, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, PixmapPaint,
    Stroke, Transform,
};

use super::indexed::write_png;
use super::palette::{Colour, PAPER};
use crate::output::Output;

/// An axis-aligned rectangle in units of the page, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// The left edge.
    pub x: f32,
    /// The upper edge.
    pub y: f32,
    /// The length from the left to the right edge.
    pub width: f32,
    /// The length from the upper to the lower edge.
    pub height: f32,
}

impl Rect {
    /// The right edge.
    pub fn right(&self) -> f32 {
        self.x + self.width
    }

    /// The lower edge.
    pub fn bottom(&self) -> f32 {
        self.y + self.height
    }

    /// The middle.
    pub fn centre(&self) -> [f32; 2] {
        [self.x + 0.5 * self.width, self.y + 0.5 * self.height]
    }

    fn path(&self) -> Path {
        let rect = tiny_skia::Rect::from_xywh(self.x, self.y, self.width, self.height);
        PathBuilder::from_rect(rect.expect("page rectangles are not empty"))
    }
}

/// The part of a text that is aligned with its place.
#[derive(Clone, Copy)]
pub enum Align {
    /// Its beginning.
    Left,
    /// Its middle.
    Centre,
    /// Its end.
    Right,
}

/// The style of a text.
#[derive(Clone, Copy)]
pub struct Style {
    /// The size of the em.
    pub size: f32,
    /// The colour of the letters.
    pub colour: Colour,
    /// The part of it that is aligned with its place.
    pub align: Align,
    /// True if it reads upwards, as beside a vertical axis.
    pub upwards: bool,
}

/// A page. Places and lengths are in units of the page, whatever its size in pixels.
pub struct Canvas {
    pixmap: Pixmap,
    scale: f32,
    font: FontRef<'static>,
}

impl Canvas {
    /// An empty page of `width` by `height` units, and `pixels` pixels wide.
    pub fn new(width: f32, height: f32, pixels: u32) -> Self {
        let scale = pixels as f32 / width;
        let rows = (height * scale).round().max(1.0) as u32;
        let mut pixmap = Pixmap::new(pixels, rows).expect("the size of a picture is checked by the command line");
        pixmap.fill(solid(PAPER));
        let font = FontRef::try_from_slice(dejavu::sans_condensed::regular()).expect("the embedded font is a font");
        Self { pixmap, scale, font }
    }

    /// Pixels per unit.
    pub fn scale(&self) -> f32 {
        self.scale
    }

    fn transform(&self) -> Transform {
        Transform::from_scale(self.scale, self.scale)
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, rect: Rect, colour: Colour) {
        self.fill_path(&rect.path(), colour, None);
    }

    fn fill_path(&mut self, path: &Path, colour: Colour, mask: Option<&Mask>) {
        let transform = self.transform();
        self.pixmap.fill_path(path, &paint(colour), FillRule::Winding, transform, mask);
    }

    /// The outline of a rectangle.
    pub fn frame(&mut self, rect: Rect, width: f32, colour: Colour) {
        self.stroke(&rect.path(), width, colour, None);
    }

    /// A line through all places.
    pub fn line(&mut self, places: impl IntoIterator<Item = [f32; 2]>, width: f32, colour: Colour) {
        self.clipped_line(places, width, colour, None);
    }

    /// A line, of which only the part inside of `clip` is drawn.
    pub fn clipped_line(
        &mut self,
        places: impl IntoIterator<Item = [f32; 2]>,
        width: f32,
        colour: Colour,
        clip: Option<Rect>,
    ) {
        let mut builder = PathBuilder::new();
        for [x, y] in places {
            if builder.is_empty() { builder.move_to(x, y) } else { builder.line_to(x, y) }
        }
        if let Some(path) = builder.finish() {
            self.stroke(&path, width, colour, clip);
        }
    }

    fn stroke(&mut self, path: &Path, width: f32, colour: Colour, clip: Option<Rect>) {
        let stroke = Stroke { width, line_cap: LineCap::Butt, line_join: LineJoin::Round, ..Stroke::default() };
        let mask = clip.map(|rect| self.mask(rect));
        let transform = self.transform();
        self.pixmap.stroke_path(path, &paint(colour), &stroke, transform, mask.as_ref());
    }

    /// Discs, of which only the parts inside of `clip` are drawn.
    pub fn discs(&mut self, centres: impl Iterator<Item = [f32; 2]>, radius: f32, colour: Colour, clip: Rect) {
        let mask = self.mask(clip);
        let mut builder = PathBuilder::new();
        centres.for_each(|[x, y]| builder.push_circle(x, y, radius));
        if let Some(path) = builder.finish() {
            self.fill_path(&path, colour, Some(&mask));
        }
    }

    /// Triangles, of which only the parts inside of `clip` are drawn.
    pub fn triangles(&mut self, triangles: impl Iterator<Item = [[f32; 2]; 3]>, colour: Colour, clip: Rect) {
        let mask = self.mask(clip);
        let mut builder = PathBuilder::new();
        for [[x, y], rest @ ..] in triangles {
            builder.move_to(x, y);
            rest.into_iter().for_each(|[x, y]| builder.line_to(x, y));
            builder.close();
        }
        if let Some(path) = builder.finish() {
            self.fill_path(&path, colour, Some(&mask));
        }
    }

    /// Lines between two places each, of which only the parts inside of `clip` are drawn.
    pub fn segments(&mut self, segments: impl Iterator<Item = [[f32; 2]; 2]>, width: f32, colour: Colour, clip: Rect) {
        let mut builder = PathBuilder::new();
        for [[x, y], [to_x, to_y]] in segments {
            builder.move_to(x, y);
            builder.line_to(to_x, to_y);
        }
        if let Some(path) = builder.finish() {
            self.stroke(&path, width, colour, Some(clip));
        }
    }

    fn mask(&self, rect: Rect) -> Mask {
        let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height()).expect("as large as the page");
        mask.fill_path(&rect.path(), FillRule::Winding, true, self.transform());
        mask
    }

    /// An image of `columns` pixels a row, stretched over `rect`.
    pub fn image(&mut self, pixels: &[Colour], columns: usize, rect: Rect) {
        let rows = pixels.len() / columns;
        let data: Vec<u8> = pixels.iter().flat_map(|&[r, g, b]| [r, g, b, u8::MAX]).collect();
        let size = IntSize::from_wh(columns as u32, rows as u32).expect("the image is not empty");
        let image = Pixmap::from_vec(data, size).expect("four bytes per pixel");
        let stretch = [rect.width / columns as f32, rect.height / rows as f32].map(|s| s * self.scale);
        let place = Transform::from_row(stretch[0], 0.0, 0.0, stretch[1], rect.x * self.scale, rect.y * self.scale);
        let quality = if stretch == [1.0; 2] { FilterQuality::Nearest } else { FilterQuality::Bicubic };
        let paint = PixmapPaint { quality, ..PixmapPaint::default() };
        self.pixmap.draw_pixmap(0, 0, image.as_ref(), &paint, place, None);
    }

    /// The length of a line of text.
    pub fn length(&self, text: &str, size: f32) -> f32 {
        outline(&self.font, text).1 * size / self.em()
    }

    /// The text if it is no longer than `length`, otherwise as much of its beginning as leaves space for an ellipsis.
    pub fn shortened(&self, text: &str, size: f32, length: f32) -> String {
        let mut shown = text.to_owned();
        let mut kept: Vec<char> = text.chars().collect();
        while self.length(&shown, size) > length && kept.pop().is_some() {
            shown = kept.iter().chain(&['…']).collect();
        }
        shown
    }

    fn em(&self) -> f32 {
        self.font.units_per_em().expect("the embedded font has an em")
    }

    /// A line of text; `place` is on its base line.
    pub fn text(&mut self, text: &str, place: [f32; 2], style: Style) {
        let em = self.em();
        let (path, length) = outline(&self.font, text);
        let Some(path) = path else { return };
        let start = match style.align {
            Align::Left => 0.0,
            Align::Centre => -0.5 * length,
            Align::Right => -length,
        };
        let turn = if style.upwards { -90.0 } else { 0.0 };
        let transform = self
            .transform()
            .pre_translate(place[0], place[1])
            .pre_rotate(turn)
            .pre_scale(style.size / em, -style.size / em)
            .pre_translate(start, 0.0);
        self.pixmap.fill_path(&path, &paint(style.colour), FillRule::Winding, transform, None);
    }

    /// Writes the page as a PNG file with a palette.
    pub fn write(&self, output: &Output) -> Result<()> {
        let pixels: Vec<Colour> = self.pixmap.pixels().iter().map(|p| [p.red(), p.green(), p.blue()]).collect();
        output.write(|writer| write_png(writer, &pixels, self.pixmap.width()))
    }
}

/// The outline of a line of text in font units, y up, and its length.
fn outline(font: &FontRef, text: &str) -> (Option<Path>, f32) {
    let mut builder = PathBuilder::new();
    let (mut x, mut previous) = (0.0, None);
    for glyph in text.chars().map(|character| font.glyph_id(character)) {
        x += previous.map_or(0.0, |previous| font.kern_unscaled(previous, glyph));
        let mut pen = None;
        for curve in font.outline(glyph).into_iter().flat_map(|outline| outline.curves) {
            pen = Some(add_curve(&mut builder, x, pen, curve));
        }
        x += font.h_advance_unscaled(glyph);
        previous = Some(glyph);
    }
    (builder.finish(), x)
}

/// Adds a curve that starts where the `pen` is, or begins a new contour; returns its end.
fn add_curve(builder: &mut PathBuilder, x: f32, pen: Option<Point>, curve: OutlineCurve) -> Point {
    let (OutlineCurve::Line(start, end) | OutlineCurve::Quad(start, _, end) | OutlineCurve::Cubic(start, _, _, end)) =
        curve;
    if pen != Some(start) {
        builder.move_to(x + start.x, start.y);
    }
    match curve {
        OutlineCurve::Line(..) => builder.line_to(x + end.x, end.y),
        OutlineCurve::Quad(_, c, _) => builder.quad_to(x + c.x, c.y, x + end.x, end.y),
        OutlineCurve::Cubic(_, c, d, _) => builder.cubic_to(x + c.x, c.y, x + d.x, d.y, x + end.x, end.y),
    }
    end
}

fn solid([r, g, b]: Colour) -> Color {
    Color::from_rgba8(r, g, b, u8::MAX)
}

fn paint(colour: Colour) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(solid(colour));
    paint
}
