//! The figures' sections. A page is three panels wide. Single-panel figures in succession stand
//! side by side. A lone one stands beside its caption.

use super::section;
use crate::report::plots::{Figure, Place};

/// All sections, in the figures' order.
pub fn sections(figures: &[Figure]) -> String {
    let alike = |a: &Figure, b: &Figure| a.is_single() && b.is_single();
    figures.chunk_by(alike).map(row).collect()
}

/// One figure, or several of one panel.
fn row(figures: &[Figure]) -> String {
    let (across, place) = match figures.len() {
        1 if figures[0].is_single() => (1, Place::Alone),
        1 => (1, Place::Usual),
        2 | 4 => (2, Place::Half),
        _ => (3, Place::Usual),
    };
    let mut sections = String::new();
    for figure in figures {
        section(&mut sections, &figure.title, &figure.inline(place));
    }
    if across == 1 {
        return sections;
    }
    format!("<div class=\"beside\" style=\"--across: {across}\">\n{sections}</div>\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::load::Loaded;
    use crate::report::{fixture, plots};

    fn of(waves: &[f64], stiffnesses: &[f64], masses: &[f64]) -> Vec<Figure> {
        let directory = fixture::movable(waves, stiffnesses, masses);
        plots::all(&Loaded::read(directory.path()).unwrap()).unwrap()
    }

    #[test]
    fn single_panels_stand_side_by_side_and_a_lone_one_beside_its_caption() {
        let mut figures = of(&[0.3, 0.5], &[10.0, 500.0], &[50.0]);
        let single = figures.iter().take_while(|figure| figure.is_single()).count();
        assert_eq!(single, 3, "displacement, force and runup of one mass");
        let classes = |figures: &[Figure]| {
            let page = sections(figures);
            let counts = ["class=\"beside\"", "--across: 2", "--across: 3", "class=\"alone\""];
            counts.map(|word| page.matches(word).count())
        };
        assert_eq!(classes(&figures), [1, 0, 1, 0]);
        figures.remove(0);
        assert_eq!(classes(&figures), [1, 1, 0, 0]);
        figures.remove(0);
        assert_eq!(classes(&figures), [0, 0, 0, 1]);
        assert_eq!(classes(&of(&[0.3], &[10.0, 500.0], &[50.0, 250.0])), [0; 4]);
    }

    #[test]
    fn every_figure_has_its_section() {
        let figures = of(&[0.3, 0.5], &[10.0, 500.0], &[50.0]);
        let page = sections(&figures);
        assert_eq!(page.matches("<section").count(), figures.len());
        for figure in &figures {
            assert!(page.contains(&format!("figures/{}.svg", figure.name)), "{}", figure.name);
        }
    }
}
