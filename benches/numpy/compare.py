#!/usr/bin/env python3
"""One evaluation of the prototype by bogie and by NumPy, side by side, on one core.

Both solve the equations of the report's full models for the same numbers to the same accuracy:
the critical speed over 5–600 mph, the flange- and the slip-limited curve, and RMS accelerations
and strokes at 110 mph to 1e-6. The Python side (models.py, evaluation.py) calls LAPACK for whole
arrays at a time and shares no code with bogie. First the results, then the times:

    taskset -c 1 python benches/numpy/compare.py

bogie is timed by `cargo bench --bench evaluate` on the same core in the same run.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import argparse
import json
import re
import statistics
import subprocess
import time
from pathlib import Path

import numpy as np
import scipy
import scipy.linalg

import evaluation
import models

ROOT = Path(__file__).resolve().parents[2]
MICROSECONDS = {"ns": 1e-3, "µs": 1.0, "ms": 1e3, "s": 1e6}


def bogie_results():
    command = ["cargo", "run", "--release", "--quiet", "--", "evaluate", "problems/prototype.toml"]
    run = subprocess.run(command + ["--format", "json"], cwd=ROOT, capture_output=True, check=True)
    return json.loads(run.stdout)


def evaluate(p):
    """What is compared: models, critical speed, curves, both rides."""
    lateral, vertical = models.lateral(p), models.vertical(p)
    return (
        evaluation.critical_speed(lateral, p.speeds),
        evaluation.degree_curves(p),
        evaluation.ride_modal(p, lateral),
        evaluation.ride_modal(p, vertical),
    )


def rows(p, bogie):
    """Name, bogie's value, NumPy's value."""
    speed, (flange, slip), lateral, vertical = evaluate(p)
    yield "critical speed, m/s", bogie["critical_speed_m_per_s"], speed
    yield "flange-limited curve, °", bogie["flange_limited_curve_deg"], flange
    yield "slip-limited curve, °", bogie["slip_limited_curve_deg"], slip
    groups = {
        "lateral": (
            "secondary_stroke_rms_m",
            "primary_stroke_rms_m",
            "wheelset_excursion_rms_m",
            "primary_longitudinal_stroke_rms_m",
            "acceleration_rms_m_per_s2",
        ),
        "vertical": ("secondary_stroke_rms_m", "primary_stroke_rms_m", "acceleration_rms_m_per_s2"),
    }
    for kind, values in (("lateral", lateral), ("vertical", vertical)):
        position = 0
        for group in groups[kind]:
            for i, value in enumerate(bogie[kind][group]):
                yield f"{kind} {group} {i + 1}", value, values[position]
                position += 1
        yield f"{kind} roll acceleration", bogie[kind]["roll_acceleration_rms_rad_per_s2"], values[
            -1
        ]


def bogie_times():
    """Fastest and median of each bench, µs."""
    command = ["cargo", "bench", "--quiet", "--bench", "evaluate", "--"]
    options = ["--skip", "grid", "--skip", "peak", "--sample-count", "300", "--min-time", "1"]
    run = subprocess.run(command + options, cwd=ROOT, capture_output=True, text=True, check=True)
    time = r"([\d.]+) (\S+)\s+│\s+"
    row = re.compile(rf"[├╰]─ (\w+)\s+{time}[\d.]+ \S+\s+│\s+{time}")
    found = {}
    for m in filter(None, map(row.search, run.stdout.split("\n"))):
        found[m[1]] = [float(m[k]) * MICROSECONDS[m[k + 1]] for k in (2, 4)]
    if not found:
        raise SystemExit(f"no times in the output of the bench:\n{run.stdout}")
    return found


def numpy_times(p, runs):
    """Fastest and median of each part, µs. They take turns, so that each sees the same machine."""
    lateral, vertical = models.lateral(p), models.vertical(p)
    parts = {
        "lateral_model": lambda: models.lateral(p),
        "vertical_model": lambda: models.vertical(p),
        "lateral_poles": lambda: np.linalg.eigvals(lateral.state_matrix(p.speed)),
        "vertical_poles": lambda: np.linalg.eigvals(vertical.state_matrix(p.speed)),
        "critical_speed": lambda: evaluation.critical_speed(models.lateral(p), p.speeds),
        "degree_curves": lambda: evaluation.degree_curves(p),
        "lateral_ride": lambda: evaluation.ride_modal(p, lateral),
        "vertical_ride": lambda: evaluation.ride_modal(p, vertical),
        "compared_indices": lambda: evaluate(p),
        "lateral_direct": lambda: evaluation.ride_direct(p, lateral),
        "vertical_direct": lambda: evaluation.ride_direct(p, vertical),
    }
    times = {name: [] for name in parts}
    for _ in range(runs):
        for name, part in parts.items():
            start = time.perf_counter()
            part()
            times[name].append(1e6 * (time.perf_counter() - start))
    return {name: [min(t), statistics.median(t)] for name, t in times.items()}


PARTS = {
    "lateral_model": "lateral model built",
    "vertical_model": "vertical model built",
    "lateral_poles": "eigenvalues of the lateral model at one speed",
    "vertical_poles": "eigenvalues of the vertical model",
    "critical_speed": "critical speed, model included",
    "degree_curves": "both degree curves, model included",
    "lateral_ride": "lateral ride, eigenvalues included",
    "vertical_ride": "vertical ride, eigenvalues included",
    "compared_indices": "all of it, models and eigenvalues shared",
}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--runs", type=int, default=300, help="runs that the median is of")
    runs = arguments.parse_args().runs
    p = models.Prototype()
    worst = 0.0
    print(f"NumPy {np.__version__}, SciPy {scipy.__version__}\n")
    print("| result | bogie | NumPy | relative difference |\n|---|---|---|---|")
    for name, bogie, own in rows(p, bogie_results()):
        difference = own / bogie - 1
        worst = max(worst, abs(difference))
        print(f"| {name.replace('_', ' ')} | {bogie:.9g} | {own:.9g} | {difference:.1e} |")
    if worst > 1e-6:
        raise SystemExit(
            f"\nThe results differ by {worst:.1e}: the times would not compare like with like."
        )
    lateral, vertical = models.lateral(p), models.vertical(p)
    for kind, system in (("lateral", lateral), ("vertical", vertical)):
        values = scipy.linalg.eigvals(system.state_matrix(p.speed))
        edges = evaluation.panels(p, values)
        points = (len(edges) - 1) * evaluation.POINTS
        direct, modal = (f(p, system) for f in (evaluation.ride_direct, evaluation.ride_modal))
        apart = np.abs(direct / modal - 1).max()
        print(
            f"\n{kind}: {len(values)} eigenvalues, {np.sum(values.imag > 0)} oscillatory modes; "
            f"ride at {points} frequencies; by modes and by solution at each alike to {apart:.0e}",
            end="",
        )
    own, bogie = numpy_times(p, runs), bogie_times()
    print("\n\nMedian and fastest, µs:\n")
    print("| part | bogie | NumPy | ratio | bogie, fastest | NumPy, fastest | ratio |")
    print("|---|---|---|---|---|---|---|")
    for key, part in PARTS.items():
        (least, median), (own_least, own_median) = bogie[key], own[key]
        print(
            f"| {part} | {median:.1f} | {own_median:.0f} | {own_median / median:.1f} "
            f"| {least:.1f} | {own_least:.0f} | {own_least / least:.1f} |"
        )
    direct = [own[f"{kind}_direct"] for kind in ("lateral", "vertical")]
    print(
        "\nNumPy's ride by a solution at each frequency: "
        + ", ".join(f"median {m:.0f} µs, fastest {f:.0f} µs" for f, m in direct)
        + " (lateral, vertical)."
    )


if __name__ == "__main__":
    main()
