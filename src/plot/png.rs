//! A drawing as a PNG picture, with an embedded font: no font needs to be installed.

use std::sync::{Arc, LazyLock};

use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree, fontdb::Database},
};

use super::{Drawing, Theme};

/// Pixels of the picture per pixel of the drawing: 288 per inch, enough for print.
const SCALE: f32 = 3.0;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The drawing is no SVG that the renderer reads.
    #[error("the drawing cannot be read: {0}")]
    Drawing(String),
    /// There is no memory for the picture, or it is empty.
    #[error("there is no room for a picture of {0} × {1} pixels")]
    Size(u32, u32),
    /// The picture cannot be encoded.
    #[error("the picture cannot be written: {0}")]
    Encoding(String),
}

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(dejavu::sans_condensed::regular().to_vec());
    fonts.load_font_data(dejavu::sans_condensed::bold().to_vec());
    // The condensed faces belong to the family without that word.
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// The picture's file.
///
/// # Errors
///
/// [`PngError`] if there is no room for it.
pub fn png(drawing: &Drawing) -> Result<Vec<u8>, PngError> {
    let options = Options {
        fontdb: Arc::clone(&FONTS),
        font_family: "DejaVu Sans".into(),
        ..Options::default()
    };
    let tree = Tree::from_str(&drawing.svg(Theme::Print), &options)
        .map_err(|error| PngError::Drawing(error.to_string()))?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(SCALE)
        .ok_or(PngError::Size(0, 0))?;
    let (width, height) = (size.width(), size.height());
    let mut pixels = Pixmap::new(width, height).ok_or(PngError::Size(width, height))?;
    resvg::render(
        &tree,
        Transform::from_scale(SCALE, SCALE),
        &mut pixels.as_mut(),
    );
    pixels
        .encode_png()
        .map_err(|error| PngError::Encoding(error.to_string()))
}
