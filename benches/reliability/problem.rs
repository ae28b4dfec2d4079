//! A problem of the bench: a spec, and the worth of designs to it.

use std::{fs, path::PathBuf};

use bogie::{
    case::Case,
    design::{compromise::shortfall, study::Study, tasks::Tasks},
    index::MET,
    optimize::problem::{Failure, Problem as _},
    parameter::Parameter,
    spec::{Freedom, Spec},
};

/// Folder of the bench.
pub fn folder() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "benches", "reliability"]
        .iter()
        .collect()
}

/// A spec with all of its parameters, goals and demands as one study for each profile.
pub struct Problem {
    /// Name of the file in `problems/`.
    pub name: String,
    /// Origin: the comment in its first line.
    pub origin: String,
    /// The spec.
    pub spec: Spec,
    /// Studies, each with the shortfall of its demands as an objective, by profile.
    pub profiles: Vec<Profile>,
}

/// The study of one wheel profile.
pub struct Profile {
    /// λ.
    pub conicity: f64,
    /// Objective and demands.
    pub study: Study,
    /// The largest shortfall of a demand as the only objective.
    pub shortfall: Study,
}

/// Worth of a design, which an independent evaluation gives whatever the search reports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worth {
    /// Largest relative shortfall of a demand, as a logarithm; at most 0 where all are met.
    pub violation: f64,
    /// Objective, a cost.
    pub merit: f64,
}

impl Worth {
    /// Worth of a design without a performance.
    pub const NONE: Self = Self {
        violation: f64::INFINITY,
        merit: f64::INFINITY,
    };

    /// Whether all demands are met, within the tolerance of the program's verdicts.
    pub fn met(self) -> bool {
        self.violation <= MET
    }

    /// What the best known design is ahead by: in merit, or in violation where that misses demands.
    pub fn behind(self, best: Self) -> f64 {
        match (self.met(), best.met()) {
            (true, true) => self.merit - best.merit,
            (false, false) => self.violation - best.violation,
            (true, false) => f64::NEG_INFINITY,
            (false, true) => f64::INFINITY,
        }
    }
}

impl Problem {
    /// Problems whose name contains one of `names`; all if there is none.
    pub fn all(names: &[String]) -> Vec<Self> {
        let files = fs::read_dir(folder().join("problems")).expect("folder of problems");
        let mut files: Vec<PathBuf> = files.map(|file| file.expect("a file").path()).collect();
        files.sort();
        let stem = |file: &PathBuf| file.file_stem().unwrap().to_string_lossy().into_owned();
        let chosen = files.iter().filter(|file| {
            let name = stem(file);
            names.is_empty() || names.iter().any(|part| name.contains(part.as_str()))
        });
        chosen
            .map(|file| {
                let source = fs::read_to_string(file).expect("a readable file");
                Self::new(stem(file), &source)
            })
            .collect()
    }

    fn new(name: String, source: &str) -> Self {
        let spec = match Spec::parse(source) {
            Ok(spec) => spec,
            Err(mistakes) => panic!("{}", mistakes.render(&name, source, false)),
        };
        let origin = source.lines().next().unwrap_or_default();
        let tasks = Tasks::new(&spec);
        let given = tasks.admissible(&spec.case);
        let profiles = tasks.profiles(&given).into_iter();
        let profiles = profiles.map(|conicity| {
            let mut case = given.clone();
            case.wheel_rail.conicity = conicity;
            let study = tasks.joint(&case).study;
            Profile {
                conicity,
                shortfall: shortfall(&study),
                study,
            }
        });
        Self {
            origin: origin.trim_start_matches("# ").into(),
            profiles: profiles.collect(),
            name,
            spec,
        }
    }

    /// Number of variables, choices not counted.
    pub fn variables(&self) -> usize {
        self.profiles[0].study.parameters().len()
    }

    /// Number of conditions, the nominal one included.
    pub fn conditions(&self) -> usize {
        self.profiles[0].study.conditions()
    }

    /// Worth of a case, which has one of the profiles.
    pub fn worth(&self, case: &Case) -> Worth {
        let conicity = case.wheel_rail.conicity;
        let far = |profile: &&Profile| (profile.conicity - conicity).abs();
        let profile = self
            .profiles
            .iter()
            .min_by(|a, b| far(a).total_cmp(&far(b)))
            .expect("a profile");
        let x = profile.study.coordinates(case);
        profile.worth(&x).unwrap_or(Worth::NONE)
    }

    /// The case with such values of the open parameters, SI, by name.
    ///
    /// # Panics
    ///
    /// If a value is missing: the record belongs to another problem.
    pub fn case(&self, value: impl Fn(&str) -> Option<f64>) -> Case {
        let mut case = Tasks::new(&self.spec).admissible(&self.spec.case);
        // Twice: a frequency depends on masses and on what is set after it.
        for _ in 0..2 {
            for parameter in self.open() {
                let value = value(parameter.name());
                let value =
                    value.unwrap_or_else(|| panic!("{}: no {}", self.name, parameter.name()));
                parameter.set(&mut case, value);
            }
        }
        Tasks::new(&self.spec).admissible(&case)
    }

    /// Parameters with bounds or choices.
    pub fn open(&self) -> impl Iterator<Item = Parameter> + '_ {
        let parameters = self.spec.design.parameters.iter();
        let open = parameters
            .filter(|(_, freedom)| matches!(freedom, Freedom::Between(_) | Freedom::Choices(_)));
        open.map(|(parameter, _)| *parameter)
    }
}

impl Profile {
    /// Worth of the design at scaled coordinates.
    ///
    /// # Errors
    ///
    /// [`Failure`] where it has no performance.
    pub fn worth(&self, x: &[f64]) -> Result<Worth, Failure> {
        let merit = self.study.evaluate(x)?.objective();
        let short = self.shortfall.evaluate(x)?;
        let violation = if short.objectives.is_empty() {
            0.0
        } else {
            short.objective()
        };
        Ok(Worth { violation, merit })
    }
}
