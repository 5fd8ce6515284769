//! VTU files for ParaView, PyVista and meshio: arrays in binary, zlib-compressed, as base64.
//!
//! An array is a header of 32-bit numbers and then its blocks. The header has the number of blocks,
//! the bytes of a full block and of a last, shorter one, and the compressed length of each (VTK
//! File Formats, `vtkZLibDataCompressor`). Numbers have seven digits.

use std::fmt::Write as _;
use std::io::Write as _;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Bytes that are compressed together.
const BLOCK: usize = 1 << 16;
const HEAD: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
    byte_order=\"LittleEndian\" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n\
    <UnstructuredGrid>\n<FieldData>\n";

/// How points are connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cells {
    /// Not connected.
    Vertices,
    /// Each connected to the next by a line.
    Lines,
}

/// Numbers, one at every point or place.
#[derive(Debug, Clone)]
pub(super) enum Values {
    Scalars(Vec<f64>),
    Vectors(Vec<[f64; 2]>),
    Whole(Vec<u32>),
}

/// Points in the plane, metres, and the values there.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    pub cells: Cells,
    pub points: Vec<[f64; 2]>,
    pub values: Vec<(&'static str, Values)>,
}

impl Grid {
    /// The file's text, at a simulated time in seconds.
    pub fn text(self, time_s: f64) -> String {
        let Grid { cells, points, values } = self;
        let n = points.len();
        let (kind, corners, ends) = connected(cells, n as u32);
        let count = ends.len();
        let mut text = HEAD.to_owned();
        let time = "type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"";
        array(&mut text, time, &time_s.to_le_bytes());
        let _ = writeln!(
            text,
            "</FieldData>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{count}\">\n<PointData>"
        );
        for (name, values) in &values {
            values.write(&mut text, name);
        }
        text.push_str("</PointData>\n<Points>\n");
        Values::Vectors(points).write(&mut text, "Points");
        text.push_str("</Points>\n<Cells>\n");
        let cells = [("connectivity", corners), ("offsets", ends)];
        for (name, numbers) in cells {
            array(&mut text, &format!("type=\"Int32\" Name=\"{name}\""), &bytes(&numbers));
        }
        array(&mut text, "type=\"UInt8\" Name=\"types\"", &vec![kind; count]);
        text.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
        text
    }
}

/// VTK's number for a kind of cell, the points of all cells, and the end of each cell.
fn connected(cells: Cells, points: u32) -> (u8, Vec<u32>, Vec<u32>) {
    match cells {
        Cells::Vertices => (1, (0..points).collect(), (1..=points).collect()),
        Cells::Lines => {
            let ends = (1..points).map(|line| 2 * line).collect();
            (3, (1..points).flat_map(|point| [point - 1, point]).collect(), ends)
        }
    }
}

impl Values {
    /// Appends the array; vectors have three components in VTK.
    fn write(&self, text: &mut String, name: &str) {
        let (kind, bytes) = match self {
            Values::Scalars(all) => ("Float32\"", singles(all.iter().copied())),
            Values::Vectors(all) => (
                "Float32\" NumberOfComponents=\"3\"",
                singles(all.iter().flat_map(|&[x, y]| [x, y, 0.0])),
            ),
            Values::Whole(all) => ("UInt32\"", bytes(all)),
        };
        array(text, &format!("type=\"{kind} Name=\"{name}\""), &bytes);
    }
}

fn singles(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(|value| (value as f32).to_le_bytes()).collect()
}

fn bytes(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

fn array(text: &mut String, attributes: &str, bytes: &[u8]) {
    let _ = writeln!(text, "<DataArray {attributes} format=\"binary\">");
    let blocks: Vec<_> = bytes.chunks(BLOCK).map(compressed).collect();
    let rest = bytes.len() % BLOCK;
    let lengths = blocks.iter().map(Vec::len);
    let header: Vec<_> = [blocks.len(), BLOCK, rest]
        .into_iter()
        .chain(lengths)
        .map(|number| number as u32)
        .collect();
    STANDARD.encode_string(self::bytes(&header), text);
    STANDARD.encode_string(blocks.concat(), text);
    text.push_str("\n</DataArray>\n");
}

fn compressed(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    let written = encoder.write_all(block).and_then(|()| encoder.finish());
    written.expect("memory takes it all")
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::ZlibDecoder;

    use super::*;

    /// The bytes of an array, as a reader of the format finds them.
    fn read(text: &str, name: &str) -> Vec<u8> {
        let text = &text[text.find(&format!("Name=\"{name}\"")).unwrap()..];
        let line = text.lines().nth(1).unwrap();
        let number = |bytes: &[u8], at: usize| {
            u32::from_le_bytes(bytes[4 * at..4 * at + 4].try_into().unwrap()) as usize
        };
        // The first four numbers, then the whole header, which is padded by itself.
        let blocks = number(&STANDARD.decode(&line[..16]).unwrap(), 0);
        let (head, body) = line.split_at((4 * (3 + blocks)).div_ceil(3) * 4);
        let (head, mut body) =
            (STANDARD.decode(head).unwrap(), &STANDARD.decode(body).unwrap()[..]);
        let mut all = Vec::new();
        for block in 0..blocks {
            let (packed, rest) = body.split_at(number(&head, 3 + block));
            let before = all.len();
            ZlibDecoder::new(packed).read_to_end(&mut all).unwrap();
            let last = block + 1 == blocks && number(&head, 2) > 0;
            let length = number(&head, if last { 2 } else { 1 });
            assert_eq!(all.len() - before, length);
            body = rest;
        }
        assert!(body.is_empty());
        all
    }

    fn grid(cells: Cells, points: usize) -> Grid {
        let points: Vec<_> = (0..points).map(|k| [k as f64, 0.5]).collect();
        let height = points.iter().map(|[x, _]| x.sin()).collect();
        Grid { cells, points, values: vec![("height", Values::Scalars(height))] }
    }

    #[test]
    fn arrays_read_back_over_several_blocks() {
        // 4 bytes each: less than a block, two whole blocks, and three blocks with a rest.
        for points in [5, 2 * BLOCK / 4, 3 * BLOCK / 4 + 7] {
            let grid = grid(Cells::Vertices, points);
            let whole = Values::Whole((0..points as u32).rev().collect());
            let values = [grid.values.clone(), vec![("id", whole)]].concat();
            let text = Grid { values, ..grid }.text(0.25);
            let floats: Vec<_> = read(&text, "height").chunks(4).map(<[u8]>::to_vec).collect();
            assert_eq!(floats.len(), points);
            assert_eq!(floats[4], (4.0_f64.sin() as f32).to_le_bytes());
            assert_eq!(read(&text, "Points").len(), 12 * points);
            assert_eq!(read(&text, "id")[..4], (points as u32 - 1).to_le_bytes());
            assert_eq!(read(&text, "TimeValue"), 0.25_f64.to_le_bytes());
        }
    }

    #[test]
    fn lines_join_neighbours() {
        let text = grid(Cells::Lines, 3).text(0.0);
        assert!(text.contains("NumberOfPoints=\"3\" NumberOfCells=\"2\""), "{text}");
        assert_eq!(read(&text, "connectivity"), bytes(&[0, 1, 1, 2]));
        assert_eq!(read(&text, "offsets"), bytes(&[2, 4]));
        assert_eq!(read(&text, "types"), [3, 3]);
    }
}
