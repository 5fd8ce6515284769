//! Rows of a table, made by all cores and written in order.

use std::io::{self, Write};

use rayon::prelude::*;

/// Number of rows made at once.
const PIECE: usize = 512;
/// Number of rows in memory at once. The table of a large study is never in memory as a whole.
const HELD: usize = 32 * PIECE;

/// Writes rows; `text` makes each row from its data.
pub(super) fn write<T: Send + Sync>(
    mut into: impl Write,
    mut rows: impl Iterator<Item = T>,
    text: impl Fn(&[T]) -> Vec<u8> + Sync,
) -> io::Result<()> {
    loop {
        let some: Vec<T> = rows.by_ref().take(HELD).collect();
        match &some[..] {
            [] => return Ok(()),
            few if few.len() <= PIECE => into.write_all(&text(few))?,
            many => {
                let texts: Vec<_> = many.par_chunks(PIECE).map(&text).collect();
                texts.iter().try_for_each(|text| into.write_all(text))?;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_order() {
        let line = |number: &usize| format!("{number}\n");
        for count in [0, 1, PIECE, PIECE + 1, 2 * HELD + 3] {
            let mut written = Vec::new();
            let text = |rows: &[usize]| rows.iter().map(line).collect::<String>().into_bytes();
            write(&mut written, 0..count, text).unwrap();
            let whole: String = (0..count).map(|number| line(&number)).collect();
            assert!(written == whole.as_bytes(), "{count}");
        }
    }
}
