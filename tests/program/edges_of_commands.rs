//! Vehicles at the edges of the models, through the commands that evaluate many designs: each says what
//! is the matter, in its own exit code and words, and no number stands where there is none.

use std::{
    fs,
    io::Write,
    process::{Command, Stdio},
};

use tempfile::TempDir;

/// What is open in the primary suspension and the dampers, and asked for.
const DESIGN: &str = r#"
[design]
primary_bending_stiffness = ["1e5 lbf ft/rad", "2e7 lbf ft/rad"]
primary_lateral_stiffness = ["4e4 lbf/ft", "5e6 lbf/ft"]
[requirements]
critical_speed = "120 mph"
[limits]
secondary_lateral_stroke = "1.5 in"
"#;

/// Name, tables that differ from the prototype, exit codes of `optimize` and `pareto` (4: their budgets do
/// not reach), and what is said by one of the commands.
const EDGES: [(&str, &str, [i32; 2], &str); 7] = [
    (
        "springs so soft that the carbody overturns",
        "[suspension.secondary]\nvertical_stiffness = \"222 lbf/ft\"\n\
         lateral_stiffness = \"240 lbf/ft\"\n",
        [3, 3],
        "a static instability",
    ),
    (
        "wheelsets that diverge",
        "[wheel_rail]\nconicity = 1e-6\ncontact_angle_difference = -1000\n",
        [3, 3],
        "a static instability",
    ),
    (
        "dampers ten times critical",
        "[suspension.secondary]\nvertical_damping = \"200000 lbf s/ft\"\n\
         lateral_damping = \"120000 lbf s/ft\"\n",
        [0, 4],
        "above 1 the dampers hold carbody and trucks together",
    ),
    (
        "unstable at every speed",
        "[wheel_rail]\nconicity = 0.25\nlateral_spin_creep = \"0 N m\"\nspin_creep = \"0 N m^2\"\n\
         roll_coefficient = 0\ncontact_angle = \"0 deg\"\ncontact_angle_difference = 0\n\
         [service]\nspeed = \"500 mph\"\n",
        [3, 3],
        "unstable at the operating speed",
    ),
    (
        "stable at every speed",
        "[wheel_rail]\nconicity = 1e-6\n",
        [0, 0],
        "stable up to",
    ),
    (
        "nothing but springs",
        "[vehicle.carbody]\nbending.damping_ratio = 0\ntorsion_1.damping_ratio = 0\n\
         torsion_2.damping_ratio = 0\n\
         [suspension.primary]\nlongitudinal_damping = \"0 N s/m\"\nlateral_damping = \"0 N s/m\"\n\
         vertical_damping = \"0 N s/m\"\n\
         [suspension.secondary]\nlateral_damping = \"0 N s/m\"\nvertical_damping = \"0 N s/m\"\n\
         yaw_stiffness = \"0 N m/rad\"\nyaw_breakaway_torque = \"0 N m\"\n",
        [3, 3],
        "vertical_acceleration: unstable at the operating speed",
    ),
    (
        "a carbody that hardly anything holds in a curve",
        "[suspension.secondary]\nlateral_stiffness = \"0.01 N/m\"\nyaw_stiffness = \"0 N m/rad\"\n",
        [4, 3],
        "asked 38.10 mm (1.500 in), reached",
    ),
];

/// Exit code and all that is written.
fn bogie(args: &[&str], spec: &str) -> (i32, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_bogie"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(spec.as_bytes()).unwrap();
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code().unwrap(), text.concat())
}

/// No number that is none.
fn assert_numbers(what: &str, text: &str) {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    for word in words {
        let word = word.to_lowercase();
        assert!(
            !["nan", "inf", "infinity", "panicked"].contains(&word.as_str()),
            "{what}: {word} in {text}"
        );
    }
}

#[test]
fn each_says_what_is_the_matter() {
    for (name, tables, [optimize, pareto], words) in EDGES {
        let spec = format!("[vehicle]\nbase = \"prototype\"\n{tables}{DESIGN}");
        let mut said = String::new();
        for (args, code) in [
            (&["optimize", "-", "--budget", "600"][..], optimize),
            (&["pareto", "-", "--budget", "600", "--points", "2"], pareto),
            (
                &["pareto", "-", "--budget", "600", "--format", "csv"],
                pareto,
            ),
            (&["sweep", "-", "--designs", "6"], 0),
            (&["sweep", "-", "--designs", "6", "--format", "json"], 0),
            (&["sensitivity", "-", "--samples", "2"], 0),
            (
                &["sensitivity", "-", "--samples", "2", "--format", "csv"],
                0,
            ),
            (&["modes", "-"], 0),
            (&["curve", "-"], 0),
            (&["psd", "-", "--points", "20"], 0),
        ] {
            let what = format!("{name}: {}", args.join(" "));
            let (found, text) = bogie(args, &spec);
            assert_eq!(found, code, "{what}: {text}");
            assert_numbers(&what, &text);
            said += &text;
        }
        assert!(said.contains(words), "{name}: {said}");
    }
}

/// Charts of what there is, for a vehicle that has no ride or next to no curve.
#[test]
fn charts_have_numbers_only() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().to_str().unwrap();
    for (name, tables, ..) in [EDGES[1], EDGES[5], EDGES[6]] {
        let spec = format!("[vehicle]\nbase = \"prototype\"\n{tables}{DESIGN}");
        let args = [
            "4.4.1",
            "4.4.2",
            "4.5.6",
            "4.5.7",
            "--files",
            "svg,csv,json",
        ];
        let args = [&["chart", "-"][..], &args, &["--out", out]].concat();
        let (code, text) = bogie(&args, &spec);
        assert_eq!(code, 0, "{name}: {text}");
        for entry in fs::read_dir(folder.path()).unwrap() {
            let path = entry.unwrap().path();
            let what = format!("{name}: {}", path.display());
            assert_numbers(&what, &fs::read_to_string(&path).unwrap());
        }
    }
}
