//! Data for the page's script, beside the tables that it reads from the page: each case's values of
//! swept keys, its history as a drawing, and its scene as a file.

use std::borrow::Cow;
use std::collections::HashMap;

use serde_json::{Value, json};

use super::thin;
use crate::keys::read_value;
use crate::quantities::{heading, named};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::row::PLACE;
use crate::report::scene_file::{are_there, template};
use crate::report::study::Key;

/// The size of all histories together, bytes.
const ROOM: usize = 1_400_000;

/// The data as JSON that may stand inside script tags.
pub fn data(loaded: &Loaded) -> Result<String, ReportError> {
    let ids: Vec<_> = loaded.rows.iter().map(|row| row.id()).collect();
    let keys: Vec<Value> = swept(loaded).iter().map(key).collect();
    let (histories, cut) = histories(loaded)?;
    let value = json!({
        "ids": ids,
        "keys": keys,
        "scenes": scenes(loaded),
        "histories": histories,
        "cut": cut,
    });
    Ok(value.to_string().replace('<', "\\u003c"))
}

/// The swept keys; without a manifest wave, stiffness and mass.
pub fn swept(loaded: &Loaded) -> Cow<'_, [Key]> {
    if !loaded.keys.is_empty() {
        return Cow::from(&loaded.keys);
    }
    let cells = |column| loaded.rows.iter().map(move |row| row.text(column));
    let keys = PLACE.iter().map(|column| Key::new(column.name, cells(column)));
    keys.filter(|key| key.cells.different().any(|cell| !cell.is_empty())).collect()
}

/// A key: its name, its heading, its values as in a file and as shown, and the place of each row's
/// value among them. -1 stands for no value.
fn key(key: &Key) -> Value {
    let mut values: Vec<_> = key.cells.different().filter(|cell| !cell.is_empty()).collect();
    let rising = |cell: &&str| cell.parse::<f64>().unwrap_or(f64::INFINITY);
    values.sort_by(|a, b| rising(a).total_cmp(&rising(b)));
    let places: HashMap<_, _> = values.iter().enumerate().map(|(at, value)| (*value, at)).collect();
    let at = |cell: &str| places.get(cell).map_or(-1, |&place| place as i64);
    let shown = |cell: &&str| cell.parse().map_or((*cell).to_owned(), number::as_typed);
    let symbol = named(&key.name).map_or("", |column| column.symbol);
    json!({
        "name": key.name,
        "heading": heading(&key.name),
        "symbol": if symbol.is_empty() { heading(&key.name) } else { symbol.to_owned() },
        "literals": values.iter().map(|cell| read_value(cell).to_string()).collect::<Vec<_>>(),
        "shown": values.iter().map(shown).collect::<Vec<_>>(),
        "at": key.cells.iter().map(at).collect::<Vec<_>>(),
    })
}

/// The different texts of scene files, and which one each row has; -1 where it has none.
fn scenes(loaded: &Loaded) -> Value {
    if !are_there(loaded) {
        return Value::Null;
    }
    let mut texts: Vec<String> = Vec::new();
    let mut of = |index: usize| {
        let Some(text) = template(loaded, index) else { return -1 };
        let known = texts.iter().position(|known| *known == text);
        known.unwrap_or_else(|| {
            texts.push(text);
            texts.len() - 1
        }) as i64
    };
    let at: Vec<_> = (0..loaded.rows.len()).map(&mut of).collect();
    json!({ "texts": texts, "at": at })
}

/// The histories of finished cases while there is room, filmed cases first, and whether there was
/// too little room.
fn histories(loaded: &Loaded) -> Result<(Value, bool), ReportError> {
    let mut histories = serde_json::Map::new();
    let mut room = ROOM;
    let filmed = loaded.finished().filter(|row| loaded.has_film(row));
    for row in filmed.chain(loaded.finished()) {
        let id = row.id();
        if histories.contains_key(id) {
            continue;
        }
        let text = thin::history(&loaded.history(id)?);
        if text.len() > room {
            return Ok((histories.into(), true));
        }
        room -= text.len();
        if !text.is_empty() {
            histories.insert(id.to_owned(), Value::String(text));
        }
    }
    Ok((histories.into(), false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn keys_hold_their_values_once_and_rows_their_places() {
        let (_directory, loaded) = fixture::read(fixture::sweep());
        let text = data(&loaded).unwrap();
        assert!(!text.contains('<'));
        let read: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read["ids"].as_array().unwrap().len(), 12);
        let stiffness = &read["keys"][1];
        assert_eq!(stiffness["literals"], json!(["10", "500", "100000"]));
        assert_eq!(stiffness["shown"], json!(["10", "500", "100000"]));
        assert_eq!(stiffness["at"].as_array().unwrap()[..4], [0, 0, 1, 1]);
        assert_eq!(read["histories"].as_object().unwrap().len(), 11, "a failed case has none");
        assert!(read["scenes"].is_null() && read["cut"] == json!(false));
    }
}
