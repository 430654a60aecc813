//! The page: one file, nothing loaded from elsewhere.

use std::fmt::{Display, Write};

/// Text as it may stand in HTML, in attributes too.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            c => out.push(c),
        }
    }
    out
}

const STYLE: &str = include_str!("page.css");
/// The browser itself keeps the page from loading anything.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// A page being written. Every text given to it is escaped; only figures are taken as they are.
pub(super) struct Page {
    text: String,
    figures: u32,
    beside: Option<&'static str>,
}

impl Page {
    /// An empty page under this heading.
    pub(super) fn new(heading: &str) -> Self {
        let heading = escape(heading);
        let text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{heading}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{heading}</h1>\n"
        );
        Self { text, figures: 0, beside: None }
    }

    fn line(&mut self, line: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    /// A paragraph.
    pub(super) fn paragraph(&mut self, text: &str) {
        self.line(format_args!("<p>{}</p>", escape(text)));
    }

    /// A remark that sets itself apart.
    pub(super) fn note(&mut self, text: &str) {
        self.line(format_args!("<div class=\"note\"><p>{}</p></div>", escape(text)));
    }

    /// What must not be overlooked; nothing for no items.
    pub(super) fn alarm(&mut self, title: &str, items: &[String]) {
        if items.is_empty() {
            return;
        }
        let items: String = items.iter().map(|item| format!("<li>{}</li>", escape(item))).collect();
        let title = escape(title);
        self.line(format_args!("<div class=\"alarm\" role=\"alert\"><p><b>{title}</b></p><ul>{items}</ul></div>"));
    }

    /// An element that stays in sight beside everything that follows, moved by a script; both are taken as they are.
    pub(super) fn beside(&mut self, element: &str, script: &'static str) {
        self.line(format_args!("<div class=\"run\">\n{element}<div class=\"figures\">"));
        self.beside = Some(script);
    }

    /// Names and values.
    pub(super) fn facts(&mut self, facts: &[(&str, String)]) {
        self.line("<table>");
        for (name, value) in facts {
            self.line(format_args!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escape(name), escape(value)));
        }
        self.line("</table>");
    }

    /// A table under a header.
    pub(super) fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        let header: String = header.iter().map(|cell| format!("<th scope=\"col\">{}</th>", escape(cell))).collect();
        self.line(format_args!("<table>\n<tr>{header}</tr>"));
        for row in rows {
            let cells: String = row.iter().map(|cell| format!("<td>{}</td>", escape(cell))).collect();
            self.line(format_args!("<tr>{cells}</tr>"));
        }
        self.line("</table>");
    }

    /// A figure, an SVG element, with its number, heading and caption.
    pub(super) fn figure(&mut self, title: &str, caption: &str, svg: &str) {
        self.figures += 1;
        let (number, title, caption) = (self.figures, escape(title), escape(caption));
        self.line(format_args!(
            "<h2>{number}. {title}</h2>\n<figure>\n<figcaption>{caption}</figcaption>\n{svg}</figure>"
        ));
    }

    /// The whole page.
    pub(super) fn finish(mut self) -> String {
        if let Some(script) = self.beside {
            self.line(format_args!("</div>\n</div>\n<script>\n{script}</script>"));
        }
        self.text + "</body>\n</html>\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_from_files_cannot_become_markup() {
        let nasty = "<script>alert(\"a & 'b'\")</script>";
        let safe = "&lt;script&gt;alert(&quot;a &amp; &#39;b&#39;&quot;)&lt;/script&gt;";
        assert_eq!(escape(nasty), safe);

        let mut page = Page::new(nasty);
        page.paragraph(nasty);
        page.note(nasty);
        page.alarm(nasty, &[nasty.to_owned()]);
        page.facts(&[(nasty, nasty.to_owned())]);
        page.table(&[nasty], &[vec![nasty.to_owned()]]);
        page.figure(nasty, nasty, "");
        let page = page.finish();
        assert!(!page.contains("<script"));
        assert_eq!(page.matches(safe).count(), 12);
    }
}
