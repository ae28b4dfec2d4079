//! The report page: what is on it, and that nothing in a spec can change what it is.

use std::{collections::HashSet, fs, process::Command};

use super::reports::{HOSTILE, made, shared};
use tempfile::TempDir;

const SECTIONS: [&str; 10] = [
    "glance",
    "requirement",
    "parameters",
    "performance",
    "charts",
    "front",
    "certificate",
    "form",
    "checks",
    "origin",
];

#[test]
fn every_section_is_there_once_and_in_the_contents() {
    let page = shared();
    assert!(page.starts_with("<!DOCTYPE html><html lang=\"en\">"));
    for id in SECTIONS {
        let section = format!(" id=\"{id}\" aria-labelledby=\"{id}-title\">");
        assert_eq!(page.matches(&section).count(), 1, "{id}");
        assert!(page.contains(&format!("<a href=\"#{id}\">")), "{id}");
        assert!(page.contains(&format!("<h2 id=\"{id}-title\">")), "{id}");
    }
    assert_eq!(page.matches("<h1>").count(), 1);
}

#[test]
fn identifiers_are_unique_and_references_lead_somewhere() {
    let page = shared();
    let values = |attribute: &str| -> Vec<String> {
        page.split(&format!(" {attribute}=\""))
            .skip(1)
            .filter_map(|rest| rest.split('"').next())
            .flat_map(|value| value.split(' ').map(str::to_owned).collect::<Vec<_>>())
            .collect()
    };
    let ids = values("id");
    let unique: HashSet<&String> = ids.iter().collect();
    assert_eq!(unique.len(), ids.len());
    for id in values("aria-labelledby") {
        assert!(unique.contains(&id), "{id}");
    }
}

/// One row per demand and condition: so tight a curve is out of reach, the stroke is not.
#[test]
fn every_requirement_has_its_row() {
    let page = shared();
    let table = between(
        page,
        "<caption>Requirements and limits</caption>",
        "</table>",
    );
    let rows: Vec<&str> = table.split("<tr>").skip(2).collect();
    assert_eq!(rows.len(), 6);
    for (words, asked, verdict) in [
        ("degree curve", "6.000°", "NOT MET"),
        ("secondary vertical stroke", "10.00 in", "met"),
    ] {
        let mine: Vec<&&str> = rows.iter().filter(|row| row.contains(words)).collect();
        assert_eq!(mine.len(), 2, "{words}");
        for row in mine {
            assert!(row.contains(asked), "{row}");
            assert!(row.contains(&format!(">{verdict}</td>")), "{row}");
        }
    }
    let unmet = table.matches(">NOT MET</td>").count();
    assert!(page.contains(&format!(
        "{unmet} of 6 requirements and limits are not met."
    )));
}

/// Every header cell says which way it heads; every table has a name.
#[test]
fn tables_have_heads_and_names() {
    let page = shared();
    let heads = page.matches("<th ").count() + page.matches("<th>").count();
    assert_eq!(page.matches(" scope=\"").count(), heads);
    for table in page.split("<table").skip(1) {
        assert!(
            table.starts_with("><caption>") || table.starts_with(" aria-label="),
            "{}",
            &table[..80]
        );
    }
    for figure in page.split("<svg ").skip(1) {
        assert!(figure.contains("role=\"img\"") && figure.contains("<desc id="));
    }
}

#[test]
fn names_in_a_spec_stay_text() {
    let page = shared();
    assert!(!page.contains("<img"));
    assert!(page.contains("&lt;img src=x onerror=alert(1)&gt;&amp;&quot;"));
    assert!(HOSTILE.contains('<'));
    // The program, and the data of three charts and the front: the comment opens and ends none.
    assert_eq!(page.matches("<script").count(), 5);
    assert_eq!(page.matches("</script").count(), 5);
    assert!(page.contains("&lt;/script&gt;&lt;/pre&gt;&lt;script&gt;"));
    for data in page.split("<script type=\"application/json\">").skip(1) {
        let data = data.split("</script>").next().unwrap();
        let value: serde_json::Value = serde_json::from_str(data).unwrap();
        assert!(!value["panels"].as_array().unwrap().is_empty());
    }
}

#[test]
fn nothing_comes_from_elsewhere() {
    let page = shared();
    let policy = between(page, "Content-Security-Policy\" content=\"", "\"");
    assert!(policy.starts_with("default-src 'none';") && !policy.contains("unsafe"));
    let rest = page.replace("http://www.w3.org/2000/svg", "");
    for scheme in ["http:", "https:", "url(\"", "@import", " src="] {
        let found = rest.find(scheme).filter(|_| scheme != " src=");
        assert!(found.is_none(), "{scheme}");
    }
    // Style attributes and handlers in the markup would be against the policy.
    let markup = page
        .split("<script")
        .map(|part| part.split_once("</script>"));
    for (_, markup) in markup.flatten() {
        assert!(!markup.contains(" style=\""));
        assert!(!markup.contains(" onclick") && !markup.contains(" onload"));
    }
}

#[test]
fn the_same_study_gives_the_same_page() {
    assert!(made() == *shared());
}

#[test]
fn the_command_writes_a_page_of_the_design_as_it_stands() {
    let folder = TempDir::new().unwrap();
    let page = folder.path().join("prototype.html");
    let bogie = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_bogie"));
        command.current_dir(env!("CARGO_MANIFEST_DIR"));
        command
    };
    let output = bogie()
        .args(["report", "problems/prototype.toml"])
        .arg(&page)
        .output()
        .unwrap();
    assert!(output.status.success());
    let text = fs::read_to_string(&page).unwrap();
    assert!(text.contains("Design as it stands: prototype"));
    assert_eq!(text.matches("<figure ").count(), 10);
    assert!(text.contains("bogie report prototype.toml prototype.html"));
    // A folder in the place of the page is a wrong call, said before any work.
    let output = bogie()
        .args(["optimize", "problems/prototype.toml", "--report"])
        .arg(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
}

fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap() + start.len();
    &text[from..from + text[from..].find(end).unwrap()]
}
