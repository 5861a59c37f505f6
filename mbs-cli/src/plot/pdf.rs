//! Pictures as PDF: one page, in the font Helvetica, which every PDF reader contains.
//!
//! Pixels of plotters become points of PDF, whose y axis points upwards: X = k x, Y = k (height - y).

use core::convert::Infallible;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};

/// Size of a pixel [pt]: 96 of them are an inch, as in SVG.
const PIXEL: f32 = 0.75;
/// Height of the letter M relative to the font size of plotters [-]: the same as in its SVG pictures.
const SIZE: f32 = 1.0 / 1.24;
/// Distances to the foot of the letters, from the top and from the middle of a line of text, relative to the font size [-]: as in SVG.
const FOOT: [f32; 2] = [0.76, 0.26];
/// Widths of the letters of Helvetica from the blank to the tilde, in thousandths of the font size [-].
#[rustfmt::skip]
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];
/// Width of all other letters, in thousandths of the font size [-]: that of most letters.
const WIDTH: u16 = 556;
/// The name of the font in the file.
const FONT: Name<'static> = Name(b"F");

/// A picture of one page. The file is complete when the picture is presented.
pub(super) struct PdfBackend<'a> {
    bytes: &'a mut Vec<u8>,
    size: (u32, u32),
    content: Content,
    /// The used opacities below one.
    opacities: Vec<f32>,
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl<'a> PdfBackend<'a> {
    /// A backend of a size [px], which writes the file to `bytes`.
    pub(super) fn new(bytes: &'a mut Vec<u8>, size: (u32, u32)) -> Self {
        Self { bytes, size, content: Content::new(), opacities: Vec::new() }
    }

    fn at(&self, (x, y): BackendCoord) -> [f32; 2] {
        [PIXEL * x as f32, PIXEL * (self.size.1 as f32 - y as f32)]
    }

    /// Draws in a colour; a transparent colour draws nothing.
    fn paint(&mut self, color: BackendColor, draw: impl FnOnce(&mut Content)) -> Drawn {
        if color.alpha <= 0.0 {
            return Ok(());
        }
        self.content.save_state();
        if color.alpha < 1.0 {
            let opacity = color.alpha as f32;
            let known = self.opacities.iter().position(|x| x.to_bits() == opacity.to_bits());
            let place = known.unwrap_or_else(|| {
                self.opacities.push(opacity);
                self.opacities.len() - 1
            });
            self.content.set_parameters(Name(opacity_name(place).as_bytes()));
        }
        let [r, g, b] = <[u8; 3]>::from(color.rgb).map(|x| f32::from(x) / 255.0);
        self.content.set_fill_rgb(r, g, b).set_stroke_rgb(r, g, b);
        draw(&mut self.content);
        self.content.restore_state();
        Ok(())
    }

    /// Draws a line through points. Without a width it fills the enclosed area.
    fn trace(
        &mut self,
        color: BackendColor,
        points: impl IntoIterator<Item = BackendCoord>,
        width: Option<u32>,
    ) -> Drawn {
        let points: Vec<[f32; 2]> = points.into_iter().map(|point| self.at(point)).collect();
        let Some(([x, y], rest)) = points.split_first() else { return Ok(()) };
        self.paint(color, |content| {
            content.move_to(*x, *y);
            rest.iter().for_each(|[x, y]| {
                content.line_to(*x, *y);
            });
            match width {
                None => content.fill_nonzero(),
                Some(width) => content.set_line_width(PIXEL * width as f32).stroke(),
            };
        })
    }
}

fn opacity_name(place: usize) -> String {
    format!("G{place}")
}

impl DrawingBackend for PdfBackend<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        if self.content.len() == 0 {
            // lines with many points get round corners
            self.content
                .set_line_cap(LineCapStyle::ButtCap)
                .set_line_join(LineJoinStyle::RoundJoin);
        }
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        let [catalog, pages, page, font, content] = [1, 2, 3, 4, 5].map(Ref::new);
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let [width, height] = [self.size.0, self.size.1].map(|x| PIXEL * x as f32);
        let mut writer = pdf.page(page);
        writer.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content);
        let mut resources = writer.resources();
        resources.fonts().pair(FONT, font);
        let mut states = resources.ext_g_states();
        for (place, opacity) in self.opacities.iter().enumerate() {
            let mut state = states.insert(Name(opacity_name(place).as_bytes())).dict();
            state.pair(Name(b"CA"), *opacity).pair(Name(b"ca"), *opacity);
        }
        states.finish();
        resources.finish();
        writer.finish();
        pdf.type1_font(font)
            .base_font(Name(b"Helvetica"))
            .encoding_predefined(Name(b"WinAnsiEncoding"));
        pdf.stream(content, &core::mem::replace(&mut self.content, Content::new()).finish());
        *self.bytes = pdf.finish();
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        self.trace(color, [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)], None)
    }

    fn draw_line<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S) -> Drawn {
        self.trace(style.color(), [a, b], Some(style.stroke_width()))
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.trace(style.color(), corners, (!fill).then(|| style.stroke_width()))
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        self.trace(style.color(), path, Some(style.stroke_width()))
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Drawn {
        self.trace(style.color(), corners, None)
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let size = SIZE * style.size() as f32;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "sizes in pixels"
        )]
        let pixels = [size * width(&letters(text)), size].map(|x| x.ceil() as u32);
        Ok((pixels[0], pixels[1]))
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        let letters = letters(text);
        let size = PIXEL * SIZE * style.size() as f32;
        let along = match style.anchor().h_pos {
            HPos::Left => 0.0,
            HPos::Center => -0.5,
            HPos::Right => -1.0,
        } * size
            * width(&letters);
        let down = match style.anchor().v_pos {
            VPos::Top => FOOT[0],
            VPos::Center => FOOT[1],
            VPos::Bottom => -FOOT[1],
        } * size;
        // cosine and sine of the rotation, anticlockwise
        let [c, s] = match style.transform() {
            FontTransform::None => [1.0, 0.0],
            FontTransform::Rotate90 => [0.0, -1.0],
            FontTransform::Rotate180 => [-1.0, 0.0],
            FontTransform::Rotate270 => [0.0, 1.0],
        };
        let [x, y] = self.at(at);
        let origin = [x + c * along + s * down, y + s * along - c * down];
        self.paint(style.color(), |content| {
            content.begin_text().set_font(FONT, size);
            content.set_text_matrix([c, s, -s, c, origin[0], origin[1]]);
            content.show(Str(&letters)).end_text();
        })
    }
}

/// A text in the encoding of the file. Characters that the encoding lacks become question marks.
fn letters(text: &str) -> Vec<u8> {
    let letter = |c: char| match c {
        ' '..='~' => c as u8,
        '\u{a0}'..='\u{ff}' => u8::try_from(u32::from(c)).unwrap_or(b'?'),
        '\u{2013}' | '\u{2212}' => b'-',
        '\u{2026}' => 0x85,
        '\u{2022}' => 0x95,
        '\u{20ac}' => 0x80,
        _ => b'?',
    };
    text.chars().map(letter).collect()
}

/// The width of a text, relative to the font size.
fn width(letters: &[u8]) -> f32 {
    let one = |letter: &u8| {
        let place = usize::from(*letter).checked_sub(usize::from(b' '));
        place.and_then(|place| WIDTHS.get(place)).copied().unwrap_or(WIDTH)
    };
    letters.iter().map(one).map(f32::from).sum::<f32>() / 1000.0
}
