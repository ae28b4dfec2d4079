//! `docs/src/spec-tables.md` is written from the tables that the reader uses. After a change of them
//! `BOGIE_UPDATE=1 cargo test --test spec_reference` writes it anew.

use std::{fmt::Write, fs};

use bogie::{
    case::Case,
    index::{Index, Sense},
    parameter::Parameter,
    spec::keys::{self, ENTRIES, Need, TABLES},
    units::{Quantity, Range, number::both},
};

/// What a value is, with examples in both unit systems.
fn kind(quantity: Quantity) -> String {
    let name = quantity.with_article();
    let name = name.split_once(' ').map_or(name, |(_, name)| name);
    match (quantity, quantity.examples()) {
        (Quantity::Dimensionless, _) => "–".into(),
        (_, [si, us]) if si == us => format!("{name}: `{si}`"),
        (_, [si, us]) => format!("{name}: `{si}`, `{us}`"),
    }
}

fn symbol(symbol: &str) -> &str {
    match symbol {
        "" => "–",
        symbol => symbol,
    }
}

fn prototype(quantity: Quantity, si: Option<f64>) -> String {
    match si.map(|si| both(quantity, si)) {
        None => "–".into(),
        Some([si, us]) if us.is_empty() => si,
        Some([si, us]) => format!("{si}, {us}"),
    }
}

fn allowed(range: Range, quantity: Quantity) -> String {
    range
        .in_words(quantity)
        .replace("of any size", "any")
        .replace("of 0", "0")
}

fn default(need: Need) -> String {
    match need {
        Need::Required => "required".into(),
        Need::Optional(words) => words.into(),
    }
}

/// The numeric keys of a table.
fn numbers(page: &mut String, table: &keys::Table) {
    let case = Case::prototype();
    let rows: Vec<_> = keys::case().filter(|key| table.holds(key.path)).collect();
    if rows.is_empty() {
        return;
    }
    *page += "| key | symbol | meaning | prototype | allowed | without it |\n|---|---|---|---|---|---|\n";
    for key in rows {
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | {} | {} | {} |",
            key.name(),
            symbol(key.symbol),
            key.meaning,
            prototype(key.quantity, (key.get)(&case)),
            allowed(key.range, key.quantity),
            default(key.need),
        );
    }
    *page += "\n";
}

/// Entries of their own form.
fn entries(page: &mut String, table: &keys::Table) {
    let rows: Vec<_> = ENTRIES
        .iter()
        .filter(|entry| table.holds(entry.path))
        .collect();
    if rows.is_empty() {
        return;
    }
    *page += "| key | meaning | form | without it |\n|---|---|---|---|\n";
    for entry in rows {
        let name = match entry.path.rsplit_once('.') {
            Some((_, name)) => name.to_owned(),
            None => format!("{}.NAME", entry.path),
        };
        let _ = writeln!(
            page,
            "| `{name}` | {} | {} | {} |",
            entry.meaning, entry.form, entry.default
        );
    }
    *page += "\n";
}

fn model(page: &mut String) {
    *page += "| key | meaning | values | without it |\n|---|---|---|---|\n";
    for option in keys::OPTIONS {
        let names: Vec<String> = option
            .names
            .iter()
            .map(|name| format!("`\"{name}\"`"))
            .collect();
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | `\"{}\"` |",
            option.path.trim_start_matches("model."),
            option.meaning,
            names.join(", "),
            option.names[0],
        );
    }
    for key in keys::RANGES {
        let _ = writeln!(
            page,
            "| `{}` | {} | [lowest, highest], each {} {} | `{}` |",
            key.name(),
            key.meaning,
            key.quantity.with_article(),
            allowed(key.range, key.quantity),
            default(key.need),
        );
    }
    *page += "\n";
}

fn design(page: &mut String) {
    let case = Case::prototype();
    *page +=
        "| key | symbol | meaning | prototype | allowed | relation |\n|---|---|---|---|---|---|\n";
    for parameter in Parameter::ALL {
        let quantity = parameter.quantity();
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | {} | {} | {} |",
            parameter.name(),
            parameter.symbol(),
            parameter.words(),
            prototype(quantity, Some(parameter.get(&case))),
            allowed(parameter.range(), quantity),
            parameter.relation().unwrap_or("–"),
        );
    }
    *page += "\n";
}

fn demands(page: &mut String, table: &keys::Table) {
    *page += "| key | | meaning | value | allowed |\n|---|---|---|---|---|\n";
    for index in Index::ALL
        .into_iter()
        .filter(|index| table.holds(index.path()))
    {
        let quantity = index.quantity();
        let sense = match index.sense() {
            Sense::AtLeast => "≥",
            Sense::AtMost => "≤",
        };
        let _ = writeln!(
            page,
            "| `{}` | {sense} | {} | {} | {} |",
            index.name(),
            index.words(),
            kind(quantity),
            allowed(index.range(), quantity),
        );
    }
    *page += "\n";
}

fn quantities() -> String {
    let mut page = "## Quantities\n\n| quantity | SI | US customary |\n|---|---|---|\n".to_owned();
    for quantity in Quantity::ALL {
        if quantity != Quantity::Dimensionless && quantity != Quantity::Stroke {
            let [si, us] = quantity.examples();
            let name = quantity.with_article();
            let name = name.split_once(' ').map_or(name, |(_, name)| name);
            let _ = writeln!(page, "| {name} | `\"{si}\"` | `\"{us}\"` |");
        }
    }
    page + "\n"
}

fn reference() -> String {
    let mut page = quantities();
    for table in TABLES {
        let _ = writeln!(page, "## `[{}]`\n\n{}\n", table.path, table.meaning);
        numbers(&mut page, table);
        match table.path {
            "model" => model(&mut page),
            "design" => design(&mut page),
            "requirements" | "limits" => demands(&mut page, table),
            _ => {}
        }
        entries(&mut page, table);
    }
    page.trim_end().to_owned() + "\n"
}

#[test]
fn the_page_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/src/spec-tables.md");
    let page = reference();
    if std::env::var_os("BOGIE_UPDATE").is_some() {
        fs::write(path, &page).unwrap();
    }
    assert!(
        fs::read_to_string(path).unwrap() == page,
        "run with BOGIE_UPDATE=1"
    );
}

/// Every entry of a spec stands in the page once, under its table.
#[test]
fn the_page_is_complete() {
    let page = reference();
    for path in keys::paths() {
        let (table, name) = match path.rsplit_once('.') {
            Some((table, name)) => (table, name.to_owned()),
            None => (path, format!("{path}.NAME")),
        };
        let start = page.find(&format!("## `[{table}]`")).expect(path);
        let section = &page[start..];
        let end = section[3..]
            .find("\n## ")
            .map_or(section.len(), |end| end + 3);
        assert_eq!(
            section[..end].matches(&format!("| `{name}` |")).count(),
            1,
            "{path}"
        );
    }
}
