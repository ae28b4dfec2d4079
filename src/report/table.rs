//! Tables with heads, and the blocks of the text pages as HTML.

use maud::{Markup, html};

use super::typeset::{symbol, typeset};
use crate::export::sheet::{Block, Sheet};

/// Kind of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// The head of its row.
    Head,
    /// Words.
    Text,
    /// A symbol, with subscripts as in `K_py`.
    Symbol,
    /// Words that fill lines.
    Wide,
    /// Numbers with their units.
    Number,
    /// `met`, `ok`, or otherwise.
    Verdict,
}

/// A table in a box of its own that scrolls where it is wider than the page.
pub fn table(caption: &str, columns: &[(&str, Column)], rows: &[Vec<String>]) -> Markup {
    html! {
        div.table {
            table {
                caption { (caption) }
                (head(columns))
                tbody { @for row in rows { tr { (cells(columns, row)) } } }
            }
        }
    }
}

fn head(columns: &[(&str, Column)]) -> Markup {
    html! {
        @if columns.iter().any(|(head, _)| !head.is_empty()) {
            thead {
                tr {
                    @for (head, column) in columns {
                        @if head.is_empty() { td {} }
                        @else { th scope="col" class=[class(*column)] { (typeset(head)) } }
                    }
                }
            }
        }
    }
}

/// Cells of a row; the first column of kind [`Column::Head`] names it.
pub fn cells(columns: &[(&str, Column)], row: &[String]) -> Markup {
    html! {
        @for ((_, column), cell) in columns.iter().zip(row) {
            @match column {
                Column::Head => th scope="row" { (typeset(cell)) },
                Column::Symbol => td { (symbol(cell)) },
                Column::Verdict => td class=(verdict(cell)) { (cell) },
                _ => td class=[class(*column)] { (typeset(cell)) },
            }
        }
    }
}

/// Class of the cells of a column.
pub fn class(column: Column) -> Option<&'static str> {
    match column {
        Column::Number => Some("number"),
        Column::Wide => Some("wide"),
        _ => None,
    }
}

fn verdict(cell: &str) -> &'static str {
    match cell {
        "met" | "ok" => "met-cell",
        "" => "",
        "not-assessed" => "open-cell",
        _ => "unmet-cell",
    }
}

/// A text page as HTML. `caption` names its tables.
pub fn blocks(sheet: &Sheet, caption: &str) -> Markup {
    // A table is named by the heading above it.
    let named = sheet.blocks().iter().scan(caption, |section, block| {
        if let Block::Heading(heading) = block {
            *section = heading;
        }
        Some((*section, block))
    });
    html! {
        @for (section, block) in named {
            @match block {
                Block::Heading(heading) => h3 { (typeset(heading)) },
                Block::Line(line) => p { (typeset(line)) },
                Block::Table { header, left, rows } => (plain(section, header, left, rows)),
            }
        }
    }
}

fn plain(caption: &str, header: &[String], left: &[usize], rows: &[Vec<String>]) -> Markup {
    let width = rows.iter().map(Vec::len).max().unwrap_or(0);
    let columns: Vec<(&str, Column)> = (0..width)
        .map(|i| {
            let kind = match i {
                0 => Column::Head,
                _ if left.contains(&i) => Column::Text,
                _ => Column::Number,
            };
            (header.get(i).map_or("", String::as_str), kind)
        })
        .collect();
    html! {
        div.table {
            table aria-label=(caption) {
                (head(&columns))
                tbody { @for row in rows { tr { (cells(&columns, row)) } } }
            }
        }
    }
}
