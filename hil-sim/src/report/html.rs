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

const STYLE: &str = "
:root { color-scheme: light; }
body { margin: 0 auto; padding: 1rem; max-width: 50rem; background: #fff; color: #1a1a1a;
  font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.5rem 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; }
table { border-collapse: collapse; margin: 0.5rem 0; }
th, td { text-align: left; vertical-align: top; padding: 0.25rem 1rem 0.25rem 0; border-bottom: 1px solid #ccc; }
th { font-weight: 600; }
td { font-variant-numeric: tabular-nums; }
figure { margin: 0; }
figure svg { display: block; width: 100%; height: auto; margin-left: -0.25rem; }
figcaption { color: #333; margin-bottom: 0.5rem; }
.alarm { border-left: 0.4rem solid #c81e14; background: #fdecea; padding: 0.5rem 1rem; margin: 1rem 0; }
.note { border-left: 0.4rem solid #999; background: #f3f3f3; padding: 0.5rem 1rem; margin: 1rem 0; }
.alarm p, .note p, .alarm ul { margin: 0; }
@media print { body { max-width: none; } figure { break-inside: avoid; } }
";

/// A page being written. Every text given to it is escaped; only figures are taken as they are.
pub(super) struct Page {
    text: String,
    figures: u32,
}

impl Page {
    /// An empty page under this heading.
    pub(super) fn new(heading: &str) -> Self {
        let heading = escape(heading);
        let text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{heading}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{heading}</h1>\n"
        );
        Self { text, figures: 0 }
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
    pub(super) fn finish(self) -> String {
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
