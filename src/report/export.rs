//! Figures for print: PDF and PNG in the widths of a journal's column and page.
//!
//! The font is part of the program, so that machines without fonts draw the same. A PDF embeds the
//! letters that it shows: its words can be selected and searched.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};
use svg2pdf::{ConversionOptions, PageOptions};

use super::Print;
use super::error::ReportError;
use super::plots::{FONT, Figure};

/// The greatest height on a journal's page, millimetres.
const TALLEST: f64 = 230.0;
/// Dots per inch of PNG files: what journals ask for line drawings.
const DOTS: f64 = 600.0;
const INCH: f64 = 25.4;

/// Writes a figure in every width. A figure higher than a page becomes several files.
pub fn write(
    figure: &Figure,
    format: Print,
    directory: &Path,
) -> Result<Vec<PathBuf>, ReportError> {
    let mut paths = Vec::new();
    for (width, columns) in Print::WIDTHS {
        let (charts, most) = (figure.drawing.charts.len(), figure.drawing.layout.columns);
        let columns = columns.min(most);
        // One panel over the whole page would be far too large.
        if columns > 1 && charts == 1 {
            continue;
        }
        let pages = figure.drawing.pages(columns, TALLEST / width);
        let count = pages.len();
        for (index, (svg, pixels)) in pages.into_iter().enumerate() {
            let part = if count > 1 { format!("-{}", index + 1) } else { String::new() };
            let name = format!("{}-{width}mm{part}.{}", figure.name, format.ending());
            let bytes = draw(&svg, format, pixels / (width / INCH))
                .map_err(|reason| ReportError::Draw { figure: name.clone(), reason })?;
            let path = directory.join(name);
            super::save(&path, &bytes)?;
            paths.push(path);
        }
    }
    Ok(paths)
}

/// Turns a drawing with so many pixels per inch into a file.
fn draw(svg: &str, format: Print, pixels: f64) -> Result<Vec<u8>, String> {
    let tree = Tree::from_str(svg, &options()).map_err(|error| error.to_string())?;
    match format {
        Print::Pdf => {
            let page = PageOptions { dpi: pixels as f32 };
            let pdf = svg2pdf::to_pdf(&tree, ConversionOptions::default(), page);
            pdf.map(|pdf| in_order(&pdf)).map_err(|error| error.to_string())
        }
        Print::Png => png(&tree, DOTS / pixels),
    }
}

/// Sorts the entries of a PDF's dictionaries. `svg2pdf` writes entries that name other objects,
/// such as `/gs0 7 0 R`, in another order each time. Each is a line, so nothing else moves.
fn in_order(pdf: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = pdf.split(|byte| *byte == b'\n').collect();
    let entry = |line: &[u8]| line.trim_ascii().starts_with(b"/") && line.ends_with(b" 0 R");
    for entries in lines.chunk_by_mut(|a, b| entry(a) && entry(b)) {
        entries.sort_unstable();
    }
    lines.join(&b'\n')
}

fn options() -> Options<'static> {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    Options { fontdb: Arc::new(fonts), font_family: "DejaVu Sans".to_owned(), ..Options::default() }
}

fn png(tree: &Tree, scale: f64) -> Result<Vec<u8>, String> {
    let size = [tree.size().width(), tree.size().height()];
    let [wide, high] = size.map(|pixels| (f64::from(pixels) * scale).round() as u32);
    let mut pixmap = Pixmap::new(wide, high).ok_or("no room for its pixels")?;
    // The drawing may end within its last row of pixels. The rest of that row is white, too.
    pixmap.fill(Color::WHITE);
    resvg::render(tree, Transform::from_scale(scale as f32, scale as f32), &mut pixmap.as_mut());
    let colours: Vec<u8> = pixmap.data().chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, wide, high);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Best);
    let per_metre = (DOTS / INCH * 1000.0).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let written = encoder.write_header().and_then(|mut header| header.write_image_data(&colours));
    written.map_err(|error| error.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;
    use crate::report::load::Loaded;
    use crate::report::{fixture, plots};

    fn figure() -> Figure {
        let directory = fixture::movable(&[0.3, 0.5], &[10.0, 500.0, 1e5], &[50.0, 100.0, 250.0]);
        plots::all(&Loaded::read(directory.path()).unwrap()).unwrap().remove(0)
    }

    #[test]
    fn a_pdf_has_the_width_of_a_column_and_of_a_page() {
        let directory = tempfile::tempdir().unwrap();
        let paths = write(&figure(), Print::Pdf, directory.path()).unwrap();
        let widths: Vec<f64> = paths
            .iter()
            .map(|path| {
                let text = String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
                let frame = text.split("/MediaBox [").nth(1).unwrap().split(']').next().unwrap();
                frame.split_whitespace().nth(2).unwrap().parse::<f64>().unwrap() / 72.0 * INCH
            })
            .collect();
        assert_eq!(widths.len(), 2);
        assert!((widths[0] - 84.0).abs() < 0.01 && (widths[1] - 174.0).abs() < 0.01, "{widths:?}");
    }

    /// The texts of a PDF's streams.
    fn streams(pdf: &[u8]) -> Vec<String> {
        let find = |from: usize, word: &[u8]| {
            let at = pdf[from..].windows(word.len()).position(|window| window == word)?;
            Some(from + at)
        };
        let (mut from, mut streams) = (0, Vec::new());
        while let Some(start) = find(from, b"stream\n").map(|at| at + 7) {
            from = find(start, b"endstream").unwrap() + 9;
            let mut bytes = Vec::new();
            let stream = &pdf[start..from - 9];
            // The list of letters is not packed.
            if flate2::read::ZlibDecoder::new(stream).read_to_end(&mut bytes).is_err() {
                bytes = stream.to_vec();
            }
            streams.push(String::from_utf8_lossy(&bytes).into_owned());
        }
        streams
    }

    #[test]
    fn a_pdf_has_words_that_can_be_selected() {
        let svg = figure().svg();
        let pdf = draw(&svg, Print::Pdf, 93.0).unwrap();
        let streams = streams(&pdf);
        let count = |word: &str| {
            streams.iter().flat_map(|text| text.lines()).filter(|line| line.ends_with(word)).count()
        };
        let words = svg.matches("<text").count();
        assert!(
            words > 20 && count("TJ") + count("Tj") >= words,
            "{} of {words} words",
            count("TJ")
        );
        // Each letter by its number in Unicode.
        let letters = streams.iter().find(|text| text.contains("beginbfchar")).unwrap();
        let drawing = roxmltree::Document::parse(&svg).unwrap();
        let texts = drawing.descendants().filter(|node| node.has_tag_name("text"));
        for letter in texts.filter_map(|node| node.text()).flat_map(str::chars) {
            let number = format!("<{:04X}>", u32::from(letter));
            assert!(letter == ' ' || letters.contains(&number), "{letter} in {letters}");
        }
    }

    /// The story: each run wrote other bytes.
    #[test]
    fn a_figure_has_the_same_bytes_each_time() {
        let svg = figure().svg();
        let pdf = || draw(&svg, Print::Pdf, 93.0).unwrap();
        let first = pdf();
        assert!(String::from_utf8_lossy(&first).matches("/gs").count() > 1, "there is an order");
        assert!((0..9).all(|_| pdf() == first));
    }

    #[test]
    fn a_png_has_600_dots_in_an_inch_and_words() {
        let directory = tempfile::tempdir().unwrap();
        let path = write(&figure(), Print::Png, directory.path()).unwrap().remove(0);
        let decoder = png::Decoder::new(std::fs::File::open(path).unwrap());
        let mut reader = decoder.read_info().unwrap();
        let dots = reader.info().pixel_dims.unwrap();
        assert!((f64::from(dots.xppu) / 1000.0 * INCH - 600.0).abs() < 0.1);
        assert_eq!(reader.info().width, (84.0 / INCH * DOTS).round() as u32);
        let mut bytes = vec![0; reader.output_buffer_size()];
        reader.next_frame(&mut bytes).unwrap();
        // The title of the first vertical axis stands at the left edge, and nothing else does.
        let wide = reader.info().width as usize * 3;
        let dark = bytes.chunks(wide).flat_map(|row| &row[170..390]).filter(|c| **c < 90).count();
        assert!(dark > 500, "{dark}");
    }

    #[test]
    fn a_png_is_white_up_to_its_edges() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"10.7\">\
                   <rect width=\"10\" height=\"10.7\" fill=\"white\"/></svg>";
        let bytes = draw(svg, Print::Png, DOTS).unwrap();
        let mut reader = png::Decoder::new(&bytes[..]).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, [255; 10 * 11 * 3]);
    }

    #[test]
    fn what_is_higher_than_a_page_becomes_several_files() {
        let masses: Vec<f64> = (1..=6).map(|mass| 50.0 * f64::from(mass)).collect();
        let directory = fixture::movable(&[0.3], &[10.0, 500.0], &masses);
        let figure = plots::all(&Loaded::read(directory.path()).unwrap()).unwrap().remove(0);
        let paths = write(&figure, Print::Pdf, directory.path()).unwrap();
        let names: Vec<_> =
            paths.iter().map(|p| p.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(
            names,
            ["84mm-1", "84mm-2", "174mm"].map(|end| format!("response-force-{end}.pdf"))
        );
    }
}
