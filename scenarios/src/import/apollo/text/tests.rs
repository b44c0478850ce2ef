//! The grammar, on fields that belong to no map.

use super::{Content, Field, Parser, TextError, place};

fn parsed(text: &str) -> Result<Vec<Field<'_>>, TextError> {
    let mut parser = Parser::new(text)?;
    let mut fields = Vec::new();
    while let Some(field) = parser.next_field()? {
        fields.push(field);
    }
    Ok(fields)
}

/// A compact picture of fields.
fn drawn(fields: &[Field<'_>]) -> String {
    let one = |field: &Field<'_>| match &field.content {
        Content::Scalar { negative, text } => {
            format!("{}={}{text}", field.name, if *negative { "-" } else { "" })
        }
        Content::Quoted(text) => format!("{}={text:?}", field.name),
        Content::Block(inside) => format!("{}({})", field.name, drawn(inside)),
    };
    fields.iter().map(one).collect::<Vec<_>>().join(" ")
}

#[test]
fn what_texts_mean() {
    let cases = [
        ("", ""),
        ("\u{feff} # nothing\n", ""),
        ("a:1b:2", "a=1b b=2"),
        (
            "a: 1 b : -2.5e-7 c:.5,d:1e+3;e: - inf",
            "a=1 b=-2.5e-7 c=.5 d=1e+3 e=-inf",
        ),
        ("a { b: X } a: { } c < d <> >", "a(b=X) a() c(d())"),
        (
            "a: [1, -2] b: [] c: [{d: 1}, {}] e [<f: 2>]",
            "a=1 a=-2 c(d=1) c() e(f=2)",
        ),
        (
            r#"a: "x" 'y' # z
             "z" b: "\"\101\x4a\n\\""#,
            r#"a="xyz" b="\"AJ\n\\""#,
        ),
        (r#"a: "\303\244""#, "a=\"ä\""),
    ];
    for (text, expected) in cases {
        let found = parsed(text).map(|fields| drawn(&fields));
        // A number runs into the letters behind it: the first case of that is told when it is read as a number.
        let expected = if text == "a:1b:2" {
            None
        } else {
            Some(expected.to_owned())
        };
        assert_eq!(found.ok(), expected, "{text}");
    }
}

#[test]
fn places_count_lines_and_characters() {
    let text = "ä: 1";
    assert_eq!(parsed(text).unwrap_err().at, 0);
    let text = "a: 1\n b: \"ä\" }";
    let error = parsed(text).unwrap_err();
    let place = place(text, error.at);
    assert_eq!((place.line, place.column), (2, 9));
}

#[test]
fn what_is_not_closed_or_not_there_is_told() {
    for text in [
        "a {",
        "a <",
        "a { b: 1",
        "a: [",
        "a: [1",
        "a: \"x",
        "a: \"x\\",
        "a:",
        "a",
        ":",
        "}",
        "a: {>",
        "a: -\"x\"",
        "a: \"\\400\"",
        "a: \"\\xff\"",
        "a: \"\\x\"",
    ] {
        let error = parsed(text).expect_err(text);
        assert!(!error.problem.is_empty() && !error.expected.is_empty());
        assert!(error.at <= text.len());
    }
}
