//! Report pages for tests: a small study whose names try to break out of the page.
#![allow(dead_code)]

use std::sync::OnceLock;

use bogie::{
    chart::{Workbook, find},
    design::{pareto, procedure},
    evaluate::warnings::warnings,
    optimize::archive::{Archive, Progress},
    plot::System,
    report::{Report, page},
    spec::Spec,
};

/// Nobody looks.
struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str) {}
    fn expected(&self, _: usize) {}
    fn evaluated(&self) {}
}

/// A name that is markup, ends attributes, and is about as long as a name may be.
pub const HOSTILE: &str = "<img src=x onerror=alert(1)>&\"'unbroken-and-about-as-long-as";

/// A spec with hostile names, a further condition, a requirement out of reach, and a front.
pub fn source() -> String {
    let name = serde_json::to_string(HOSTILE).unwrap();
    format!(
        r#"# </script></pre><script>alert("comment")</script>
[service]
speed = "110 mph"
track = "fra-class-6"

[vehicle]
base = "prototype"

[design]
primary_bending_stiffness = ["1e5 lbf ft/rad", "2e7 lbf ft/rad"]
primary_lateral_stiffness = ["4e4 lbf/ft", "5e6 lbf/ft"]

[requirements]
critical_speed = "150 mph"
degree_curve = "6 deg"

[limits]
secondary_vertical_stroke = "10 in"

[conditions.{name}]
wheel_rail.conicity = 0.06

[pareto]
indices = ["critical_speed", "degree_curve"]
points = 4
bounds = {{ critical_speed = "100 mph" }}
"#
    )
}

/// The page of that study, made anew.
pub fn made() -> String {
    let source = source();
    let spec = Spec::parse(&source)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render("hostile", &source, false)));
    let archive = Archive::new(&Silent);
    let result = procedure::design(&spec, &archive).unwrap();
    let front = pareto::pareto(&spec, &Archive::new(&Silent));
    let designed = Spec {
        case: result.case.clone(),
        ..spec.clone()
    };
    let book = Workbook::new(&designed, HOSTILE, System::Si, &());
    // Charts of each kind: one panel with a family, several panels, steps and shades.
    let figures: Vec<_> = ["speed-bending-stiffness", "root-locus", "lateral-spectrum"]
        .into_iter()
        .map(|name| find(name).unwrap().draw(&book))
        .collect();
    page(&Report {
        name: HOSTILE,
        source: &source,
        digest: "0123456789abcdef",
        command: "bogie optimize hostile.toml --report hostile.html",
        spec: &spec,
        result: &result,
        designed: true,
        matters: None,
        front: Some(&front),
        figures: &figures,
        warnings: &warnings(&result.case, &result.evaluation),
    })
}

/// The page of that study, made once.
pub fn shared() -> &'static str {
    static PAGE: OnceLock<String> = OnceLock::new();
    PAGE.get_or_init(made)
}
