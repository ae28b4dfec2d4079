//! The gallery of the prototype's charts in the documentation.

use std::{fs, path::Path};

use bogie::chart::BOOK;

/// It shows every chart of the book once, in its order, and each picture is there.
#[test]
fn the_gallery_shows_the_whole_book() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/src");
    let text = fs::read_to_string(docs.join("gallery.md")).unwrap();
    let shown: Vec<&str> = text
        .lines()
        .filter_map(|line| line.strip_prefix("!["))
        .map(|line| line.split_once("](").unwrap().1.trim_end_matches(')'))
        .collect();
    let book: Vec<String> = BOOK
        .iter()
        .map(|entry| format!("gallery/{}-{}.svg", entry.numbers[0], entry.name))
        .collect();
    assert_eq!(shown, book);
    for entry in &BOOK {
        for number in entry.numbers {
            assert!(text.contains(&format!("Figure {number}")), "{number}");
        }
    }
    for file in shown {
        let svg = fs::read_to_string(docs.join(file)).unwrap();
        assert!(
            svg.starts_with("<svg") && svg.ends_with("</svg>\n"),
            "{file}"
        );
    }
    let files = fs::read_dir(docs.join("gallery")).unwrap().count();
    assert_eq!(files, BOOK.len());
}
