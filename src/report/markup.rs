//! Text inside HTML and SVG.

/// Text as it may stand between tags and in attributes.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_markup_is_made_of_is_written_by_name() {
        assert_eq!(escape("k < 5 & \"m\" > 1"), "k &lt; 5 &amp; &quot;m&quot; &gt; 1");
    }
}
