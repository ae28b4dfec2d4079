use bogie::{
    case::*,
    dynamics::*,
    evaluate::{critical_speed::*, curving::*, integration::*, lateral_modes::*, response::*},
    track::Track,
    vehicle::*,
};
use std::time::Instant;
fn main() {
    let cases: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string("tests/data/cases.json").unwrap()).unwrap();
    for c in cases.as_array().unwrap() {
        let i = &c["inputs_si"];
        let g = |k: &str| i[k].as_f64().unwrap_or_else(|| panic!("{k}"));
        let mut case = Case::prototype();
        case.service.speed = c["speed_m_per_s"].as_f64().unwrap();
        let v = &mut case.vehicle;
        v.wheelset.half_contact_distance = g("vehicle.wheelset.half_contact_distance");
        v.wheelset.mass = g("vehicle.wheelset.mass");
        v.wheelset.spin_inertia = g("vehicle.wheelset.spin_inertia");
        v.wheelset.yaw_inertia = g("vehicle.wheelset.yaw_inertia");
        v.wheelset.rolling_radius = g("vehicle.wheelset.rolling_radius");
        v.truck.half_wheelbase = g("vehicle.truck.half_wheelbase");
        v.truck.half_primary_spacing = g("vehicle.truck.half_primary_spacing");
        v.truck.half_secondary_spacing = g("vehicle.truck.half_secondary_spacing");
        v.truck.height_above_primary = g("vehicle.truck.height_above_primary");
        v.truck.depth_below_secondary = g("vehicle.truck.depth_below_secondary");
        v.truck.mass = g("vehicle.truck.mass");
        v.truck.roll_inertia = g("vehicle.truck.roll_inertia");
        v.truck.pitch_inertia = g("vehicle.truck.pitch_inertia");
        v.truck.yaw_inertia = g("vehicle.truck.yaw_inertia");
        v.carbody.height_above_secondary = g("vehicle.carbody.height_above_secondary");
        v.carbody.half_truck_spacing = g("vehicle.carbody.half_truck_spacing");
        v.carbody.length = g("vehicle.carbody.length");
        v.carbody.mass = g("vehicle.carbody.mass");
        v.carbody.roll_inertia = g("vehicle.carbody.roll_inertia");
        v.carbody.pitch_inertia = g("vehicle.carbody.pitch_inertia");
        v.carbody.yaw_inertia = g("vehicle.carbody.yaw_inertia");
        v.carbody.bending.frequency = g("vehicle.carbody.bending.frequency");
        v.carbody.bending.damping_ratio = g("vehicle.carbody.bending.damping_ratio");
        v.carbody.torsion_1.frequency = g("vehicle.carbody.torsion_1.frequency");
        v.carbody.torsion_2.frequency = g("vehicle.carbody.torsion_2.frequency");
        let s = &mut v.suspension;
        s.primary.longitudinal_stiffness = g("suspension.primary.longitudinal_stiffness");
        s.primary.lateral_stiffness = g("suspension.primary.lateral_stiffness");
        s.primary.vertical_stiffness = g("suspension.primary.vertical_stiffness");
        s.secondary.lateral_stiffness = g("suspension.secondary.lateral_stiffness");
        s.secondary.lateral_damping = g("suspension.secondary.lateral_damping");
        s.secondary.vertical_stiffness = g("suspension.secondary.vertical_stiffness");
        s.secondary.vertical_damping = g("suspension.secondary.vertical_damping");
        s.secondary.yaw_stiffness = g("suspension.secondary.yaw_stiffness");
        s.secondary.yaw_breakaway_torque = g("suspension.secondary.yaw_breakaway_torque");
        v.passenger.longitudinal_offset = g("passenger.longitudinal_offset");
        v.passenger.lateral_offset = g("passenger.lateral_offset");
        v.passenger.height_above_carbody_cg = g("passenger.height_above_carbody_cg");
        let w = &mut case.wheel_rail;
        w.friction = g("wheel_rail.friction");
        w.conicity = g("wheel_rail.conicity");
        w.lateral_creep = Some(g("wheel_rail.lateral_creep"));
        w.lateral_spin_creep = Some(g("wheel_rail.lateral_spin_creep"));
        w.spin_creep = Some(g("wheel_rail.spin_creep"));
        w.longitudinal_creep = Some(g("wheel_rail.longitudinal_creep"));
        w.roll_coefficient = Some(g("wheel_rail.roll_coefficient"));
        w.contact_angle = Some(g("wheel_rail.contact_angle"));
        w.contact_angle_difference = Some(g("wheel_rail.contact_angle_difference"));
        if i["model.truck_roll"] == "dynamic" {
            case.model.truck_roll = TruckRoll::Dynamic;
        }
        let o = &c["outputs_si"];
        println!("== {}", c["name"]);
        let t = Instant::now();
        let model = LateralModel::new(&case);
        println!("  build {:?}", t.elapsed());
        let t = Instant::now();
        let st = Stability::search(&model, case.model.speed_range).unwrap();
        let el = t.elapsed();
        println!(
            "  Vc {:?} ref {} start {} ({el:?})",
            st.onsets
                .iter()
                .map(|x| (x.speed, x.frequency, x.kind))
                .collect::<Vec<_>>(),
            o["critical_speed_m_per_s"],
            st.unstable_at_start
        );
        let t = Instant::now();
        let l = CurvingLimits::new(&case, 0.0);
        let el = t.elapsed();
        match l {
            Ok(l) => println!(
                "  flange {:?} ref {}  slip {:?} ref {} ({el:?})",
                l.flange, o["flange_limited_curve_deg"], l.slip, o["slip_limited_curve_deg"]
            ),
            Err(e) => println!("  curving {e}"),
        }
        let t = Instant::now();
        let m = LateralModes::new(
            &model,
            case.service.speed,
            KinematicBand::new(
                &case.vehicle,
                &case.wheel_rail.contact(),
                case.service.speed,
            ),
        )
        .unwrap();
        let el = t.elapsed();
        if c["name"].as_str().unwrap().len() < 10 {
            for x in &m.oscillatory {
                println!(
                    "    {:.3} {:.4} {} {:.3}",
                    x.frequency, x.damping_ratio, x.shape, x.carbody_share
                );
            }
            println!("   ({el:?})");
        }
        let t = Instant::now();
        let mut n = 0;
        let mut r = Response::new(&model.forced, &case.service.track, case.service.speed);
        let edges = [
            0.02, 0.1, 0.2, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0, 6.3, 8.0,
            10.0, 15.0, 20.0, 30.0, 50.0,
        ];
        let k = model.forced.outputs.len();
        let res = integrate(&edges, k, 1e-6, |f, v| {
            n += 1;
            r.densities(f, v)
        });
        let el = t.elapsed();
        let rel = |a: f64, b: &serde_json::Value| {
            b.as_f64()
                .map(|b| format!("{:.1e}", a / b - 1.0))
                .unwrap_or_default()
        };
        for (name, range) in [
            ("acceleration_rms_m_per_s2", 0..3),
            ("secondary_stroke_rms_m", 4..6),
            ("primary_stroke_rms_m", 6..10),
            ("wheelset_excursion_rms_m", 10..14),
        ] {
            println!(
                "  {name} {:?}",
                range
                    .clone()
                    .enumerate()
                    .map(|(j, q)| rel(res.total(q).sqrt(), &o["lateral"][name][j]))
                    .collect::<Vec<_>>()
            );
        }
        println!("  lateral {el:?} n={n} {}", res.converged);
        let vm = VerticalModel::new(&case);
        let t = Instant::now();
        let mut n = 0;
        let mut r = Response::new(&vm.forced, &case.service.track, case.service.speed);
        let k = vm.forced.outputs.len();
        let res = integrate(&edges, k, 1e-6, |f, v| {
            n += 1;
            r.densities(f, v)
        });
        let el = t.elapsed();
        for (name, range) in [
            ("acceleration_rms_m_per_s2", 0..3),
            ("secondary_stroke_rms_m", 4..6),
        ] {
            println!(
                "  {name} {:?}",
                range
                    .clone()
                    .enumerate()
                    .map(|(j, q)| rel(res.total(q).sqrt(), &o["vertical"][name][j]))
                    .collect::<Vec<_>>()
            );
        }
        println!("  vertical {el:?} n={n} {}", res.converged);
        // rss
    }
}
