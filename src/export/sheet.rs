//! A page of headed, aligned tables.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

/// A piece of a page.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A section heading.
    Heading(String),
    /// A line of prose.
    Line(String),
    /// A table.
    Table {
        /// Heads of the columns; may be empty.
        header: Vec<String>,
        /// Columns that are left-aligned beside the first.
        left: Vec<usize>,
        /// Its cells.
        rows: Vec<Vec<String>>,
    },
}

/// A page being built.
#[derive(Debug, Default)]
pub struct Sheet {
    title: String,
    blocks: Vec<Block>,
}

impl Sheet {
    /// A page with a title.
    pub fn new(title: &str) -> Self {
        Self {
            title: title.into(),
            blocks: Vec::new(),
        }
    }

    /// A section heading.
    pub fn heading(&mut self, heading: &str) {
        self.blocks.push(Block::Heading(heading.into()));
    }

    /// A line of prose.
    pub fn line(&mut self, line: &str) {
        self.blocks.push(Block::Line(line.into()));
    }

    /// A table; the first column and those in `left` are left-aligned, the rest right-aligned.
    /// An empty header is left out.
    pub fn table(&mut self, header: &[&str], left: &[usize], rows: &[Vec<String>]) {
        self.blocks.push(Block::Table {
            header: header.iter().map(|head| (*head).to_owned()).collect(),
            left: left.to_vec(),
            rows: rows.to_vec(),
        });
    }

    /// Body of the page, below its title.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The finished page as text.
    pub fn finish(self) -> String {
        let mut text = format!("{}\n", self.title);
        for block in &self.blocks {
            let _ = match block {
                Block::Heading(heading) => writeln!(text, "\n{heading}"),
                Block::Line(line) => writeln!(text, "  {line}"),
                Block::Table { header, left, rows } => {
                    write_table(&mut text, header, left, rows);
                    Ok(())
                }
            };
        }
        text
    }
}

fn write_table(text: &mut String, header: &[String], left: &[usize], rows: &[Vec<String>]) {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_content_arrangement(ContentArrangement::Disabled);
    if !header.is_empty() {
        table.set_header(header);
    }
    for row in rows {
        table.add_row(row);
    }
    for (i, column) in table.column_iter_mut().enumerate() {
        if i > 0 && !left.contains(&i) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    for line in table.lines() {
        let _ = writeln!(text, " {}", line.trim_end());
    }
}
