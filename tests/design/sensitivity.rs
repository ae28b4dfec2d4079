//! Sensitivity: the estimators on functions whose indices are known, then what the report says
//! matters to the prototype, and what does not.

use std::{
    collections::BTreeMap,
    f64::consts::PI,
    sync::atomic::{AtomicBool, AtomicUsize, Ordering},
};

use bogie::{
    design::sensitivity::{
        Effects, Factors, Method, Outcome, Output, Sensitivity, Settings, Watch,
        analysis::indices_of, morris, screen, sobol,
    },
    export,
    index::Index,
    optimize::{archive::Progress, problem::Failure},
    spec::Spec,
};

/// Ishigami and Homma (1990) with a = 7, b = 0.1 on −π…π.
fn ishigami(x: &[f64]) -> f64 {
    let [x, y, z] = [x[0], x[1], x[2]].map(|u| PI * (2.0 * u - 1.0));
    x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
}

fn one(value: f64) -> Vec<Outcome> {
    vec![Ok(value)]
}

fn decompose(
    function: &(dyn Fn(&[f64]) -> Vec<Outcome> + Sync),
    factors: usize,
    rows: usize,
    seed: u64,
) -> Output<sobol::Effect> {
    let settings = sobol::Settings { rows, seed };
    let found = sobol::decomposition(function, factors, 1, &settings, &Watch::default());
    assert_eq!(found.rows, rows);
    found.outputs.into_iter().next().unwrap()
}

/// 0.05: with 1024 rows of Ishigami's function the largest error over a hundred seeds is 0.037, and
/// no interval misses.
fn assert_near(output: &Output<sobol::Effect>, first: &[f64], total: &[f64]) {
    for (i, effect) in output.effects.iter().enumerate() {
        let effect = effect.unwrap();
        for (what, estimate, exact) in [
            ("S", effect.first, first[i]),
            ("ST", effect.total, total[i]),
        ] {
            let (value, [low, high]) = (estimate.value, estimate.interval);
            assert!((value - exact).abs() < 0.05, "{what} {i}: {value}, {exact}");
            assert!(
                low <= exact + 1e-12 && exact - 1e-12 <= high,
                "{what} {i}: {low} – {high}"
            );
        }
    }
}

#[test]
fn ishigami_function() {
    for seed in 1..=3 {
        let output = decompose(&|x| one(ishigami(x)), 3, 1024, seed);
        assert_near(&output, &[0.3139, 0.4424, 0.0], &[0.5576, 0.4424, 0.2437]);
        // a/2, and √(1/2 + a²/8 + bπ⁴/5 + b²π⁸/18).
        let [mean, deviation] = output.moments.unwrap();
        assert!((mean - 3.5).abs() < 0.05 && (deviation - 3.7208).abs() < 0.05);
    }
}

/// Sobol's g-function: f = Π (|4x_i − 2| + a_i)/(1 + a_i), V_i = 1/(3 (1 + a_i)²),
/// S_i = V_i/V, S_Ti = V_i Π_{j≠i} (1 + V_j)/V, V = Π (1 + V_i) − 1.
#[test]
fn g_function() {
    const A: [f64; 8] = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0];
    let g = |x: &[f64]| -> f64 {
        let pairs = x.iter().zip(A);
        pairs
            .map(|(x, a)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a))
            .product()
    };
    let part = A.map(|a| 1.0 / (3.0 * (1.0 + a).powi(2)));
    let product: f64 = part.iter().map(|v| 1.0 + v).product();
    let first = part.map(|v| v / (product - 1.0));
    let total = part.map(|v| v * product / (1.0 + v) / (product - 1.0));
    assert_near(&decompose(&|x| one(g(x)), 8, 1024, 1), &first, &total);
}

#[test]
fn of_a_linear_function_effects_are_exact() {
    const C: [f64; 5] = [3.0, -2.0, 1.0, 0.1, 0.0];
    let linear = |x: &[f64]| one(x.iter().zip(C).map(|(x, c)| c * x).sum());
    for levels in [2, 4, 10] {
        let settings = morris::Settings {
            trajectories: 8,
            levels,
            seed: 5,
        };
        let found = morris::screening(&linear, 5, 1, &settings, &Watch::default());
        let squares: f64 = C.iter().map(|c| c * c).sum();
        for (effect, c) in found.outputs[0].effects.iter().zip(C) {
            let effect = effect.unwrap();
            assert!((effect.mu - c).abs() < 1e-13 && (effect.mu_star - c.abs()).abs() < 1e-13);
            assert!(effect.sigma < 1e-13 && effect.count == 8);
            // The mean squares are then the shares of variance.
            assert!((effect.mean_square() - c * c).abs() < 1e-12 * squares);
        }
    }
    let shares = C.map(|c| c * c / C.iter().map(|c| c * c).sum::<f64>());
    assert_near(&decompose(&linear, 5, 1024, 1), &shares, &shares);
}

/// x (1 − x) has as much rise as fall: only μ* sees it. x y has effects that depend on one another.
#[test]
fn curvature_and_interaction() {
    let function = |x: &[f64]| vec![Ok((x[0] - 0.5).powi(2)), Ok(x[0] * x[1])];
    let settings = morris::Settings {
        trajectories: 1000,
        levels: 4,
        seed: 1,
    };
    let found = morris::screening(&function, 2, 2, &settings, &Watch::default());
    let curved = found.outputs[0].effects[0].unwrap();
    assert!((curved.mu_star - 1.0 / 3.0).abs() < 1e-12 && curved.mu.abs() < 0.05);
    // y is one of 0, 1/3, 2/3, 1: mean 1/2, standard deviation √5/6.
    let product = found.outputs[1].effects[0].unwrap();
    assert!((product.mu - 0.5).abs() < 0.05 && (product.sigma - 5_f64.sqrt() / 6.0).abs() < 0.03);
}

/// Where the function fails in a corner, rows are left out factor by factor.
#[test]
fn failures_are_counted_and_left_out() {
    let function = |x: &[f64]| {
        if x[0] < 0.1 {
            vec![Err(Failure::Unstable)]
        } else if x[0] > 0.95 {
            vec![Ok(f64::NAN)]
        } else {
            one(x[0] + x[1])
        }
    };
    let output = decompose(&function, 2, 256, 1);
    let [x, y] = [0, 1].map(|i| output.effects[i].unwrap());
    // A and B both succeed with 0.85²; AB_0 then has B's x, AB_1 has A's.
    assert_eq!(x.rows, y.rows);
    assert!(
        (x.rows as f64 / 256.0 - 0.85_f64.powi(2)).abs() < 0.05,
        "{}",
        x.rows
    );
    for (failure, share) in [(Failure::Unstable, 0.1), (Failure::NotFinite, 0.05)] {
        let found = output.failures[&failure] as f64 / (4.0 * 256.0);
        assert!((found - share).abs() < 0.02, "{failure}: {found}");
    }
    // What is left is x + y with variances 0.85² and 1 over 12.
    assert!(
        (x.total.value - 0.7225 / 1.7225).abs() < 0.1,
        "{:?}",
        x.total
    );

    let never = decompose(&|_| vec![Err(Failure::NoCurve)], 2, 8, 1);
    assert_eq!((never.effects, never.moments), (vec![None, None], None));
    assert_eq!(never.failures, BTreeMap::from([(Failure::NoCurve, 32)]));
    let settings = morris::Settings {
        trajectories: 50,
        levels: 4,
        seed: 1,
    };
    let found = morris::screening(&function, 2, 1, &settings, &Watch::default());
    // x starts or ends at 0 or 1 in every step; y moves while x is at 1/3 or 2/3 in half of them.
    assert_eq!(found.outputs[0].effects[0], None);
    let y = found.outputs[0].effects[1].unwrap();
    assert!((15..=35).contains(&y.count) && (y.mu - 1.0).abs() < 1e-12);
}

fn spec(design: &str) -> Spec {
    let source = format!("[vehicle]\nbase = \"prototype\"\n[design]\n{design}\n");
    Spec::parse(&source).unwrap_or_else(|m| panic!("{}", m.render("test", &source, false)))
}

/// Total indices by path, over the open parameters alone.
fn totals(design: &str, indices: &[Index], rows: usize) -> Vec<BTreeMap<&'static str, f64>> {
    let spec = spec(design);
    let factors = Factors::new(&spec.case, &spec.design, 0.0);
    let settings = Settings {
        method: Method::Sobol { rows },
        seed: 1,
    };
    let found = Sensitivity::new(&factors, indices, settings, &Watch::default());
    assert_eq!(found.evaluations(), rows * (found.factors.len() + 2));
    let by_path = |effects: &Effects| -> BTreeMap<&'static str, f64> {
        let Effects::Sobol(effects) = effects else {
            panic!("not Sobol' indices");
        };
        let pairs = found.factors.iter().zip(effects);
        pairs
            .map(|(factor, e)| {
                (
                    factor.path.trim_start_matches("design."),
                    e.unwrap().total.value,
                )
            })
            .collect()
    };
    found.indices.iter().map(|i| by_path(&i.effects)).collect()
}

/// Ranges of the report's parametric studies (4.5).
const PRIMARY: &str = "primary_bending_stiffness = [\"5e5 lbf ft/rad\", \"1e7 lbf ft/rad\"]\n\
    primary_lateral_stiffness = [\"2e5 lbf/ft\", \"5e6 lbf/ft\"]\n";

/// The lateral model has no primary vertical springs, as the truck's roll is prescribed. The
/// secondary ones carry the carbody's roll, in which hunting has little part. At zero cant deficiency
/// nothing rolls in a curve.
#[test]
fn stability_and_curving_do_not_depend_on_the_vertical_suspension() {
    let design = format!(
        "{PRIMARY}\
         primary_vertical_stiffness = [\"1e6 lbf/ft\", \"4e6 lbf/ft\"]\n\
         secondary_vertical_stiffness = [\"15000 lbf/ft\", \"40000 lbf/ft\"]\n\
         secondary_vertical_damping = [\"1000 lbf s/ft\", \"4000 lbf s/ft\"]"
    );
    let found = totals(&design, &[Index::CriticalSpeed, Index::DegreeCurve], 32);
    for (totals, hardly) in found.iter().zip([1e-6, 1e-20]) {
        assert!(totals["primary_vertical_stiffness"] <= 0.0, "{totals:?}");
        assert!(
            totals["secondary_vertical_stiffness"] < hardly,
            "{totals:?}"
        );
        assert!(totals["secondary_vertical_damping"] < hardly, "{totals:?}");
        assert!(totals["primary_bending_stiffness"] > 0.8, "{totals:?}");
    }
    // Degree curve: bending stiffness is what matters (4.5.2).
    assert!(found[1]["primary_lateral_stiffness"] < 0.01, "{found:?}");
}

/// Figure 4.5.10: the critical speed is relatively insensitive to yaw stiffnesses below
/// 5e6 ft-lb/rad, above which it rises.
#[test]
fn yaw_stiffness_matters_only_where_it_is_high() {
    let with = |greatest: &str| {
        // Stiff yaw elements hold hunting off beyond 600 mph, and an end of the range is no value.
        let yaw = format!(
            "secondary_yaw_stiffness = [\"1e5 lbf ft/rad\", \"{greatest}\"]\n\
             [model]\nspeed_range = [\"5 mph\", \"2000 mph\"]"
        );
        totals(&format!("{PRIMARY}{yaw}"), &[Index::CriticalSpeed], 64).remove(0)
    };
    let (low, high) = (with("5e6 lbf ft/rad"), with("5e7 lbf ft/rad"));
    let share = |totals: &BTreeMap<&str, f64>| {
        totals["secondary_yaw_stiffness"] / totals["primary_bending_stiffness"]
    };
    // A twentieth of what the bending stiffness does, against a third.
    assert!(share(&low) < 0.05 && share(&high) > 0.3, "{low:?} {high:?}");
}

/// Table 4.2.1: vertical ride and lateral dynamics are decoupled; secondary lateral stiffness and
/// damping dominate lateral ride and stroke, which depend on the primary suspension moderately.
#[test]
fn ride_depends_on_its_own_secondary_suspension() {
    let design = "conicity = [0.05, 0.10]\n\
         primary_bending_stiffness = [\"2e6 lbf ft/rad\", \"8e6 lbf ft/rad\"]\n\
         primary_lateral_stiffness = [\"2e5 lbf/ft\", \"2e6 lbf/ft\"]\n\
         secondary_lateral_frequency = [\"0.7 Hz\", \"1.5 Hz\"]\n\
         secondary_lateral_damping_ratio = [0.1, 0.6]\n\
         secondary_vertical_frequency = [\"0.7 Hz\", \"1.5 Hz\"]\n\
         secondary_vertical_damping_ratio = [0.1, 0.6]";
    let indices = [
        Index::LateralAcceleration,
        Index::SecondaryLateralStroke,
        Index::VerticalAcceleration,
        Index::SecondaryVerticalStroke,
    ];
    let found = totals(design, &indices, 64);
    let lateral = [
        "secondary_lateral_frequency",
        "secondary_lateral_damping_ratio",
    ];
    let vertical = [
        "secondary_vertical_frequency",
        "secondary_vertical_damping_ratio",
    ];
    for (i, totals) in found.iter().enumerate() {
        let own = if i < 2 { lateral } else { vertical };
        let (strong, weak): (Vec<_>, Vec<_>) =
            totals.iter().partition(|(path, _)| own.contains(path));
        let strong: f64 = strong.iter().map(|(_, total)| **total).sum();
        let weak: f64 = weak.iter().map(|(_, total)| **total).sum();
        if i < 2 {
            assert!(strong > 2.0 * weak, "{:?}: {totals:?}", indices[i]);
        } else {
            assert!(strong > 0.9 && weak <= 0.0, "{:?}: {totals:?}", indices[i]);
        }
    }
}

/// Counts evaluations and ends the run at one of them.
struct EndAt<'a> {
    count: AtomicUsize,
    last: usize,
    interrupt: &'a AtomicBool,
}

impl Progress for EndAt<'_> {
    fn stage(&self, _: &str) {}

    fn expected(&self, _: usize) {}

    fn evaluated(&self) {
        if self.count.fetch_add(1, Ordering::Relaxed) + 1 == self.last {
            self.interrupt.store(true, Ordering::Relaxed);
        }
    }
}

/// The degree curve is cheap; the acceleration fails where designs are unstable.
const CHEAP: [Index; 2] = [Index::DegreeCurve, Index::LateralAcceleration];
const OPEN: &str = "primary_bending_stiffness = [\"1e5 lbf ft/rad\", \"2e7 lbf ft/rad\"]\n\
    conicity = { choices = [0.05, 0.10, 0.25] }";

#[test]
fn an_interrupted_run_is_a_shorter_one() {
    let spec = spec(OPEN);
    let factors = Factors::new(&spec.case, &spec.design, 0.0);
    let run = |method, watch: &Watch| {
        Sensitivity::new(&factors, &CHEAP, Settings { method, seed: 4 }, watch)
    };
    let sobol = |rows| Method::Sobol { rows };
    let morris = |trajectories| Method::Morris { trajectories };
    for method in [sobol as fn(usize) -> Method, morris] {
        let interrupt = AtomicBool::new(false);
        let progress = EndAt {
            count: AtomicUsize::new(0),
            last: 100,
            interrupt: &interrupt,
        };
        let watch = Watch {
            interrupt: Some(&interrupt),
            progress: &progress,
        };
        let ended = run(method(1000), &watch);
        assert!(
            ended.interrupted() && (16..=34).contains(&ended.groups),
            "{}",
            ended.groups
        );
        let shorter = run(method(ended.groups), &Watch::default());
        assert!(!shorter.interrupted());
        assert_eq!(ended.indices, shorter.indices);
        // Nothing at all is no sensitivity, rather than none.
        let nothing = run(method(1000), &watch);
        assert_eq!(nothing.evaluations(), 0);
        assert_eq!(nothing.indices[0].ranking().unknown, [0, 1]);
        let text = export::sensitivity::text("nothing", &nothing);
        assert!(text.contains("0 of 1000 (interrupted)"), "{text}");
    }
}

#[test]
fn the_same_bits_on_any_number_of_threads() {
    let spec = spec(OPEN);
    let factors = Factors::new(&spec.case, &spec.design, 0.0);
    let run = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            [Method::Sobol { rows: 24 }, Method::MORRIS].map(|method| {
                let settings = Settings { method, seed };
                Sensitivity::new(&factors, &CHEAP, settings, &Watch::default())
            })
        })
    };
    let once = run(1, 3);
    assert_eq!(once, run(3, 3));
    assert_ne!(once[0].indices, run(3, 4)[0].indices);
    assert!(once[0].indices[1].failures.contains_key(&Failure::Unstable));
    assert!(once[0].indices[0].failures.is_empty());
}

/// Around the prototype primary damping does not significantly influence performance (4.1): each
/// damper explains less than 1 % of any index. Conicity and wheelbase are foremost in the excursion
/// that limits the degree curve (4.5-4, 4.5-5).
#[test]
fn screening_the_prototype() {
    let mut spec = spec("");
    let primary = &mut spec.case.vehicle.suspension.primary;
    primary.longitudinal_damping = Some(primary.c_px());
    primary.lateral_damping = Some(primary.c_py());
    primary.vertical_damping = Some(primary.c_pz());
    let found = screen(&spec.case, &indices_of(&spec), 1, &Watch::default());
    let number = |path: &str| found.factors.iter().position(|f| f.path == path).unwrap();
    for index in &found.indices {
        let Effects::Morris(effects) = &index.effects else {
            panic!("not elementary effects");
        };
        let square = |i: usize| effects[i].unwrap().mean_square();
        let all: f64 = (0..effects.len()).map(square).sum();
        for direction in ["longitudinal", "lateral", "vertical"] {
            let share = square(number(&format!("suspension.primary.{direction}_damping"))) / all;
            assert!(share < 0.01, "{:?} {direction}: {share}", index.index);
        }
    }
    let curve = found
        .indices
        .iter()
        .find(|i| i.index == Index::DegreeCurve)
        .unwrap();
    let matters = curve.ranking().matters;
    for path in ["wheel_rail.conicity", "vehicle.truck.half_wheelbase"] {
        assert!(matters.iter().take(5).any(|i| *i == number(path)), "{path}");
    }

    let text = export::sensitivity::text("prototype", &found);
    assert!(
        text.contains("Morris") && text.contains("do not matter"),
        "{text}"
    );
    let table = export::sensitivity::table(&found);
    assert_eq!(table.rows(), found.indices.len() * found.factors.len());
    assert!(
        table
            .csv()
            .starts_with("index,factor,path,verdict,mu_star,mu,sigma,effects\n")
    );
    let json = export::sensitivity::json("prototype", &found);
    assert_eq!(
        json["factors"].as_array().unwrap().len(),
        found.factors.len()
    );
    assert_eq!(json["indices"][0]["index"], "critical_speed");
    assert_eq!(json["evaluations"], found.evaluations());
    let summary = export::sensitivity::summary(&found, 3);
    assert_eq!(summary.len(), found.indices.len());
    assert!(
        summary.iter().all(|row| row[1].matches('%').count() == 3),
        "{summary:?}"
    );
}
