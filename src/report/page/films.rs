//! The films of a study: stills of each and a link to its page. The film itself is inside this page
//! as long as the page stays small.

use std::collections::HashMap;
use std::path::Path;

use serde_json::Value;

use crate::disk::names::{
    FILM_PAGE, FURTHEST, HIGHEST, HIGHEST_RUNUP, LARGEST_FORCE, REASONS, STILL,
};
use crate::report::load::Loaded;
use crate::report::markup::escape;
use crate::report::row::Row;

/// The content of the section on films, with as many films inside as `room` allows, bytes; `None`
/// where there are none.
pub fn films(data: &Loaded, mut room: usize) -> Option<String> {
    let filmed: Vec<_> = data.finished().filter(|row| data.has_film(row)).collect();
    if filmed.is_empty() {
        return None;
    }
    let reasons = reasons(&data.directory);
    let mut one = |row: &&Row| figure(data, row, reasons.get(row.id()), &mut room);
    let figures: String = filmed.iter().map(&mut one).collect();
    Some(format!(
        "<p>The water under the largest force, or at the highest runup where it was filmed for that, and, where \
         the wall went on, at its largest displacement. \
         <span class=\"scripted\">Press Play to see it move; the arrow keys then go from frame to \
         frame.</span></p>\n<div class=\"films\">{figures}</div>"
    ))
}

/// Why cases were filmed, by id, if a sweep chose them. A page can do without the reasons.
fn reasons(directory: &Path) -> HashMap<String, String> {
    let reader = csv::Reader::from_path(directory.join(REASONS));
    reader.into_iter().flat_map(csv::Reader::into_deserialize).flatten().collect()
}

/// The stills, the case, the reason for the film, and the film for the script.
fn figure(data: &Loaded, row: &Row, reason: Option<&String>, room: &mut usize) -> String {
    let id = escape(row.id());
    let words = escape(&row.title());
    let why = reason.map_or_else(String::new, |reason| format!(" ({})", escape(reason)));
    let page = data.film(row, FILM_PAGE).unwrap_or_default();
    let film = embedded(&page, &id, room);
    // The stills show what the case was filmed for.
    let is_for = |what: &str| reason.is_some_and(|reason| reason.contains(what));
    let first = match data.film(row, HIGHEST) {
        Some(_) if is_for(HIGHEST_RUNUP) && is_for(LARGEST_FORCE) => &[STILL, HIGHEST][..],
        Some(_) if is_for(HIGHEST_RUNUP) => &[HIGHEST],
        _ => &[STILL],
    };
    let stills: String = first
        .iter()
        .chain(&[FURTHEST])
        .filter_map(|ending| data.film(row, ending))
        .map(|still| still.find("<svg").map_or(String::new(), |start| still[start..].to_owned()))
        .collect();
    format!(
        "<figure class=\"film\" data-film=\"{id}\"><div class=\"poster\">{stills}</div>\
         <figcaption>{words}{why} <a href=\"films/{id}.html\">films/{id}.html</a></figcaption>\
         {film}</figure>\n"
    )
}

/// A film's page as data, without the still that is shown where scripts are off. Empty where there
/// is no room.
fn embedded(page: &str, id: &str, room: &mut usize) -> String {
    let page = match (page.find("<noscript>"), page.find("</noscript>")) {
        (Some(start), Some(end)) if start < end => page[..start].to_owned() + &page[end + 11..],
        _ => page.to_owned(),
    };
    let text = Value::String(page.clone()).to_string().replace('<', "\\u003c");
    if page.is_empty() || text.len() > *room {
        return String::new();
    }
    *room -= text.len();
    format!("<script type=\"application/json\" id=\"film-{id}\">{text}</script>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_is_inside_the_page_as_long_as_there_is_room() {
        let page = "<p>a</p><noscript><svg/></noscript><script>x < \"1\"</script>";
        let mut room = 100;
        let text = embedded(page, "7", &mut room);
        let data = text.strip_prefix("<script type=\"application/json\" id=\"film-7\">").unwrap();
        let data = data.strip_suffix("</script>").unwrap();
        assert!(!data.contains('<'), "{data}");
        let read: String = serde_json::from_str(data).unwrap();
        assert_eq!(read, "<p>a</p><script>x < \"1\"</script>");
        assert_eq!(room, 100 - data.len());
        assert_eq!(embedded(page, "8", &mut room), "");
        assert_eq!(embedded("", "9", &mut room), "");
    }
}
