//! Lenient XML: what precedes the document is cut off, and every element knows its line and column.

use crate::import::{ImportError, TextPlace};
use roxmltree::{Document, Node};

/// Most attributes of one element. The formats know about twenty; the XML reader compares each with each.
const MAX_ATTRIBUTES: usize = 1000;

/// Starts of lines, to turn byte offsets into places for people.
pub(crate) struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
    /// Bytes before the document that the XML reader never saw.
    cut: usize,
}

/// A byte offset in the document, cheap to carry along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place(usize);

impl<'a> Lines<'a> {
    /// Finds the document with the root element `root` inside `text`: a byte order mark, blank lines and comments may precede the XML
    /// declaration in real files although XML forbids it.
    pub(crate) fn new(text: &'a str, root: &str) -> Self {
        let cut = text
            .find("<?xml")
            .or_else(|| text.find(&format!("<{root}")))
            .unwrap_or(0);
        let starts = std::iter::once(0)
            .chain(text.match_indices('\n').map(|(at, _)| at + 1))
            .collect();
        Self { text, starts, cut }
    }

    /// The document without what precedes it, parsed.
    pub(crate) fn parse(&self) -> Result<Document<'a>, ImportError> {
        self.check_attribute_counts()?;
        Document::parse(&self.text[self.cut..]).map_err(|error| {
            let first = self.place(Place(0));
            let at = error.pos();
            let (row, column) = (at.row as usize, at.col as usize);
            let place = TextPlace {
                line: first.line + row.max(1) - 1,
                column: if row <= 1 {
                    first.column + column.max(1) - 1
                } else {
                    column
                },
            };
            ImportError::Xml {
                place,
                problem: error.to_string(),
            }
        })
    }

    /// Refuses elements that would keep the XML reader busy for ever.
    fn check_attribute_counts(&self) -> Result<(), ImportError> {
        let document = &self.text.as_bytes()[self.cut..];
        let (mut start, mut attributes) = (0, 0);
        for (at, byte) in document.iter().enumerate() {
            match byte {
                b'<' => (start, attributes) = (at, 0),
                b'=' => attributes += 1,
                _ => continue,
            }
            // Comments and declarations may hold any text.
            let free = matches!(document.get(start + 1), Some(b'!' | b'?'));
            if attributes > MAX_ATTRIBUTES && !free {
                let place = self.place(Place(start));
                let problem = format!("an element of more than {MAX_ATTRIBUTES} attributes");
                return Err(ImportError::Xml { place, problem });
            }
        }
        Ok(())
    }

    /// Line and column of a place.
    pub(crate) fn place(&self, at: Place) -> TextPlace {
        let offset = (at.0 + self.cut).min(self.text.len());
        let line = self.starts.partition_point(|start| *start <= offset);
        let start = self.starts[line - 1];
        let column = self
            .text
            .get(start..offset)
            .map_or(1, |before| before.chars().count() + 1);
        TextPlace { line, column }
    }
}

/// An XML element that can complain.
#[derive(Clone, Copy)]
pub(crate) struct Element<'a> {
    node: Node<'a, 'a>,
    lines: &'a Lines<'a>,
}

impl<'a> Element<'a> {
    /// The root of a document, which must be called `name`.
    pub(crate) fn root(
        document: &'a Document<'a>,
        lines: &'a Lines<'a>,
        name: &str,
    ) -> Result<Self, ImportError> {
        let root = Self {
            node: document.root_element(),
            lines,
        };
        if root.name() == name {
            return Ok(root);
        }
        Err(root.error("is the root of the file", format!("<{name}>")))
    }

    /// Name without namespace.
    pub(crate) fn name(self) -> &'a str {
        self.node.tag_name().name()
    }

    pub(crate) fn place(self) -> Place {
        Place(self.node.range().start)
    }

    /// Line and column of the element.
    pub(crate) fn text_place(self) -> TextPlace {
        self.lines.place(self.place())
    }

    /// An error at this element.
    pub(crate) fn error(self, problem: impl Into<String>, expected: impl Into<String>) -> ImportError {
        ImportError::Element {
            place: self.lines.place(self.place()),
            element: self.name().to_owned(),
            problem: problem.into(),
            expected: expected.into(),
        }
    }

    pub(crate) fn elements(self) -> impl Iterator<Item = Element<'a>> {
        let lines = self.lines;
        let children = self.node.children().filter(Node::is_element);
        children.map(move |node| Element { node, lines })
    }

    pub(crate) fn children(self, name: &'static str) -> impl Iterator<Item = Element<'a>> {
        self.elements().filter(move |child| child.name() == name)
    }

    pub(crate) fn child(self, name: &'static str) -> Option<Element<'a>> {
        self.children(name).next()
    }

    pub(crate) fn required_child(self, name: &'static str) -> Result<Element<'a>, ImportError> {
        self.child(name)
            .ok_or_else(|| self.error(format!("has no <{name}> inside"), format!("one <{name}>")))
    }

    /// The trimmed text of an attribute, `None` when absent or empty.
    pub(crate) fn text(self, attribute: &str) -> Option<&'a str> {
        self.node
            .attribute(attribute)
            .map(str::trim)
            .filter(|text| !text.is_empty())
    }

    /// The trimmed text inside the element, `None` when empty.
    pub(crate) fn content(self) -> Option<&'a str> {
        self.node.text().map(str::trim).filter(|text| !text.is_empty())
    }

    pub(crate) fn required_text(self, attribute: &str) -> Result<&'a str, ImportError> {
        self.text(attribute).ok_or_else(|| {
            self.error(
                format!("has no `{attribute}`"),
                format!("a value, as in {attribute}=\"1\""),
            )
        })
    }

    /// A finite number; anything else is an error.
    pub(crate) fn number(self, attribute: &str) -> Result<f64, ImportError> {
        let text = self.required_text(attribute)?;
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(self.error(
                format!("has {attribute}=\"{}\"", shortened(text)),
                "a finite number",
            )),
        }
    }

    /// A finite number, or `default` when the attribute is absent.
    pub(crate) fn number_or(self, attribute: &str, default: f64) -> Result<f64, ImportError> {
        match self.text(attribute) {
            None => Ok(default),
            Some(_) => self.number(attribute),
        }
    }

    /// A number of which NaN and infinity are let through, for values that real files spoil.
    pub(crate) fn any_number(self, attribute: &str) -> Result<f64, ImportError> {
        let text = self.required_text(attribute)?;
        text.parse::<f64>()
            .map_err(|_| self.error(format!("has {attribute}=\"{}\"", shortened(text)), "a number"))
    }

    /// A number that names an element: whole, of 64 bits, negative too.
    pub(crate) fn id(self, attribute: &str) -> Result<i64, ImportError> {
        let text = self.required_text(attribute)?;
        text.parse::<i64>().map_err(|_| {
            self.error(
                format!("has {attribute}=\"{}\"", shortened(text)),
                "a whole number of at most 64 bits",
            )
        })
    }

    /// A whole number, such as a lane id.
    pub(crate) fn integer(self, attribute: &str) -> Result<i32, ImportError> {
        let text = self.required_text(attribute)?;
        text.parse::<i32>().map_err(|_| {
            self.error(
                format!("has {attribute}=\"{}\"", shortened(text)),
                "a whole number",
            )
        })
    }
}

/// Enough of a bad value to recognise it.
pub(crate) fn shortened(text: &str) -> String {
    const SHOWN: usize = 40;
    if text.chars().count() <= SHOWN {
        return text.to_owned();
    }
    text.chars().take(SHOWN).chain("...".chars()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_what_was_cut_off() {
        let text =
            "\u{feff}\n<!-- ä -->\n  <?xml version=\"1.0\"?>\n<OpenDRIVE>\n <road length='x'/></OpenDRIVE>";
        let lines = Lines::new(text, "OpenDRIVE");
        let document = lines.parse().unwrap();
        let root = Element::root(&document, &lines, "OpenDRIVE").unwrap();
        let error = root.child("road").unwrap().number("length").unwrap_err();
        let message = error.to_string();
        assert_eq!(message, "5:2: <road> has length=\"x\"; expected a finite number");
    }

    #[test]
    fn malformed_xml_is_placed_in_the_whole_file() {
        let lines = Lines::new(
            "<!-- licence -->\n<?xml version=\"1.0\"?>\n<OpenDRIVE><road></OpenDRIVE>",
            "OpenDRIVE",
        );
        let place = lines.parse().unwrap_err().place().unwrap();
        assert_eq!(place.line, 3);
    }
}
