//! Whether a table is an earlier state of another one.

use std::io::{BufRead, Write};

use csv::StringRecord;

use crate::quantities::summary;

/// Takes the rows of a table as it should be. Meanwhile it looks for those of the older table: they
/// must all be there, in the same order. Error bars may be missing in the older one, because
/// companions end later than their case. So may the result of a case that had failed.
pub(super) struct Earlier<R> {
    there: R,
    /// The next row of the older table; `None` at its end.
    wanted: Option<StringRecord>,
    header: Option<StringRecord>,
    /// The bytes of a line that has not ended.
    begun: Vec<u8>,
}

impl<R: BufRead> Earlier<R> {
    pub(super) fn new(mut there: R) -> Earlier<R> {
        let wanted = next(&mut there);
        Earlier { there, wanted, header: None, begun: Vec::new() }
    }

    /// Whether all rows of the older table were found, and its columns first.
    pub(super) fn is_found(&self) -> bool {
        self.header.is_some() && self.wanted.is_none()
    }

    fn take(&mut self, line: &[u8]) {
        let (Some(wanted), Some(now)) = (&self.wanted, cells(line)) else { return };
        let found = match &self.header {
            Some(header) => is_earlier(header, wanted, &now),
            None => *wanted == now,
        };
        if found {
            self.header.get_or_insert(now);
            self.wanted = next(&mut self.there);
        }
    }
}

impl<R: BufRead> Write for Earlier<R> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        for piece in bytes.split_inclusive(|byte| *byte == b'\n') {
            self.begun.extend(piece);
            if piece.ends_with(b"\n") {
                let line = std::mem::take(&mut self.begun);
                self.take(&line);
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// The next row of a table. A line that is cut or no text is one that no table has.
fn next(from: &mut impl BufRead) -> Option<StringRecord> {
    let mut line = Vec::new();
    let is_cut = from.read_until(b'\n', &mut line).is_err() || !line.ends_with(b"\n");
    if line.is_empty() && is_cut {
        return None;
    }
    Some(cells(&line).filter(|_| !is_cut).unwrap_or_default())
}

fn cells(line: &[u8]) -> Option<StringRecord> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line);
    reader.records().next()?.ok()
}

/// Whether a row may have been that of the same case before.
fn is_earlier(header: &StringRecord, before: &StringRecord, now: &StringRecord) -> bool {
    let place = |name: &str| header.iter().position(|it| it == name);
    let is = |name: &str, row: &StringRecord, what: &str| {
        place(name).and_then(|at| row.get(at)).is_some_and(|cell| cell == what)
    };
    let same_case = place(summary::CASE_ID.name).is_some_and(|at| before.get(at) == now.get(at));
    let all = || header.iter().zip(before.iter().zip(now));
    let bars = |name: &str| summary::ALL.iter().any(|column| column.bar == Some(name));
    let cell = |(name, (before, now)): (&str, (&str, &str))| {
        before == now || before.is_empty() && bars(name)
    };
    let alike = before.len() == header.len() && all().all(cell);
    let had_failed = is(summary::STATUS.name, before, "failed");
    same_case && (alike || had_failed && !is(summary::STATUS.name, now, "failed"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(before: &str, now: &str) -> bool {
        let mut earlier = Earlier::new(before.as_bytes());
        // In pieces, as they come.
        now.as_bytes().chunks(3).for_each(|piece| earlier.write_all(piece).unwrap());
        earlier.is_found()
    }

    #[test]
    fn fewer_rows_are_an_earlier_state_and_other_rows_are_not() {
        let now = "case_id,status,force_max,force_error\na,ok,1,0.1\nb,ok,2,0.2\nc,failed,,\n";
        let head = "case_id,status,force_max,force_error\n";
        for before in ["", "b,ok,2,0.2\n", "a,ok,1,\nb,ok,2,\n", "a,failed,,\nc,failed,,\n"] {
            assert!(found(&format!("{head}{before}"), now), "{before:?}");
        }
        for other in [
            "b,ok,3,0.2\n",
            "b,ok,,0.2\n",
            "b,ok,2,0.3\n",
            "b,ok,2,0.2\na,ok,1,0.1\n",
            "d,ok,2,0.2\n",
            "d,failed,,\n",
            "b,ok,2,0.2",
            "b,ok\n",
            "b,ok,2,0.2\n\n",
        ] {
            assert!(!found(&format!("{head}{other}"), now), "{other:?}");
        }
        assert!(!found("", now) && !found("case_id,status\nb,ok\n", now));
    }
}
