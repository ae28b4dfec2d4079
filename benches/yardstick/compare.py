#!/usr/bin/env python3
"""Compares bogie's optimiser with general ones on the same problems and the same evaluator.

Every other method calls `bogie evaluate - --format json`, one process per design; a design that a
method asks for twice in a run is evaluated and counted once. `bogie optimize` counts its own
evaluations, which compute only the models that a trade-off needs and start no process: compare
evaluations rather than seconds.

Cases (bounds, requirements and limits are those of the specs):
  1  problems/conicity-0.10.toml: K_b, K_py for the highest degree curve at 150 mph or more
  2  problems/intercity-130mph.toml, conicity 0.05: the same at 200 mph, within the primary stroke
  3  intercity: lateral f_n, ξ for the least average acceleration within the secondary stroke
  4  intercity: all four for the highest degree curve over acceleration, within all of these
  5  conicity-0.10: the front of critical speed against degree curve over K_b, K_py

All methods see a unit box, logarithmic in every variable, and dimensionless functions:
objective −ln D, ln a or their sum; constraints ln(required/reached) and ln(3σ/limit), one per
wheelset or truck. Where a design has no performance (an unstable vehicle has no ride), each value
that it lacks is a penalty of 10. A design is feasible within 1e-5, for every method.

  SLSQP       SciPy; ftol 1e-8, forward differences of 1e-4, 100 iterations (default)
  SLSQP-minimax  the same, with flange- and slip-limited curve as two functions below a bound t
  COBYQA      SciPy; first trust radius 0.1, final 1e-6 (default), 500 n evaluations (default)
  DE          SciPy differential_evolution; popsize 15, tol 0.01, no polish; minimises exp of the
              objective, so that tol is a share of it; a generation is evaluated at a time
  DE+SLSQP    the same run, polished by SLSQP as above (SciPy's own polish, trust-constr, spends
              hundreds of evaluations on case 1)
  NSGA-II     pymoo; population 100, 100 generations, its default operators

“1 start” are random starts (Latin hypercube), “8 starts” are seven of them and the design of the
spec. What a run found is the best feasible design among its evaluations, whatever it returned. “To
0.1 %” counts the evaluations until a run came that near to the best known design; “best known” is
over all methods and runs. For fronts, the objective is the area (ln mph × ln °) above 75 mph and
0.25° below the front, with neighbouring designs joined by lines: a front of few designs loses
nothing by that.
"""

import argparse
import copy
import json
import math
import statistics
import subprocess
import sys
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, differential_evolution, minimize
from scipy.stats import qmc

ROOT = Path(__file__).resolve().parents[2]
MPH, INCH, GRAVITY = 0.44704, 0.0254, 9.80665
D_P = 2.0  # ft, prototype
PENALTY, FEASIBLE, NEAR = 10.0, 1e-5, 1e-3
MAX_DEGREE = 25.0  # bogie looks no further
CORNER = (75.0, 0.25)  # mph, °: where the area below a front begins
POOL = ThreadPoolExecutor(2)
PRIMARY = ["primary_bending_stiffness", "primary_lateral_stiffness"]
LATERAL = ["secondary_lateral_frequency", "secondary_lateral_damping_ratio"]


def number(value):
    """Of "150 mph" or 150."""
    return float(str(value).split()[0])


def toml(table, path=()):
    """A spec as text."""
    plain = {k: v for k, v in table.items() if not isinstance(v, dict)}
    lines = [f"[{'.'.join(path)}]"] if path and plain else []
    lines += [f"{key} = {json.dumps(value)}" for key, value in plain.items()]
    for key, value in table.items():
        if isinstance(value, dict):
            lines.append(toml(value, (*path, key)))
    return "\n".join(lines)


def call(command, spec):
    """What a bogie command says about a spec; its exit code 3 is a result too."""
    done = subprocess.run(
        [OPTIONS.bogie, command, "-", "--format", "json"],
        input=toml(spec), capture_output=True, text=True,
    )
    if done.returncode not in (0, 3):
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


class Case:
    """A problem: a spec reduced to the variables, requirements and limits of the trade-off."""

    def __init__(self, title, file, variables, limits, speed=True, front=False):
        self.title, self.variables, self.front = title, variables, front
        self.spec = tomllib.loads((ROOT / "problems" / file).read_text())
        self.spec["design"] = {key: self.spec["design"][key] for key in variables}
        if not speed:
            del self.spec["requirements"]
        self.limits = {key: self.spec["limits"][key] for key in limits}
        self.spec["limits"] = self.limits
        self.bounds = [[number(b) for b in pair] for pair in self.spec["design"].values()]
        self.speed = number(self.spec["requirements"]["critical_speed"]) if speed else None
        self.n = len(variables)

    def mass(self):
        """Of the carbody, slug: lbf/ft, slug and seconds are consistent units."""
        return number(self.spec["vehicle"]["carbody"]["mass"])

    def given(self):
        """Coordinates of the design of the spec."""
        primary, secondary = (self.spec["suspension"].get(k, {}) for k in ("primary", "secondary"))
        values = {}
        if PRIMARY[0] in self.variables:
            values[PRIMARY[0]] = number(primary["longitudinal_stiffness"]) * D_P**2
            values[PRIMARY[1]] = number(primary["lateral_stiffness"])
        if LATERAL[0] in self.variables:
            k, c = (number(secondary[f"lateral_{name}"]) for name in ("stiffness", "damping"))
            values[LATERAL[0]] = math.sqrt(k / self.mass()) / math.pi
            values[LATERAL[1]] = c / math.sqrt(k * self.mass())
        scaled = [
            math.log(values[key] / low) / math.log(high / low)
            for key, (low, high) in zip(self.variables, self.bounds)
        ]
        return np.clip(scaled, 0, 1)

    def design(self, x):
        """Suspension at coordinates x."""
        values = dict(zip(
            self.variables, (low * (high / low) ** u for u, (low, high) in zip(x, self.bounds))
        ))
        suspension = {"primary": {}, "secondary": {}}
        if PRIMARY[0] in values:
            suspension["primary"] = {
                "longitudinal_stiffness": f"{values[PRIMARY[0]] / D_P**2!r} lbf/ft",
                "lateral_stiffness": f"{values[PRIMARY[1]]!r} lbf/ft",
            }
        if LATERAL[0] in values:
            k = (math.pi * values[LATERAL[0]]) ** 2 * self.mass()
            suspension["secondary"] = {
                "lateral_stiffness": f"{k!r} lbf/ft",
                "lateral_damping": f"{values[LATERAL[1]] * math.sqrt(k * self.mass())!r} lbf s/ft",
            }
        return suspension

    def evaluate(self, suspension):
        """Functions of a design, whose maxima are objective and violation; and its indices."""
        spec = copy.deepcopy(self.spec)
        for table, values in suspension.items():
            spec["suspension"].setdefault(table, {}).update(values)
        result = call("evaluate", spec)
        degrees = [result[f"{limit}_limited_curve_deg"] for limit in ("flange", "slip")]
        degrees = [MAX_DEGREE if d is None else max(d, 1e-9) for d in degrees]
        solved = result["curving_status"] == "solved"
        speed = result["critical_speed_m_per_s"] or result["stability"]["speeds_searched_m_per_s"][1]
        ride = result["lateral"] if (result["lateral"] or {}).get("converged") else None
        acceleration = ride["acceleration_average_m_per_s2"] / GRAVITY if ride else None
        objective = [0.0]
        if PRIMARY[0] in self.variables:
            objective = [-math.log(d) if solved else PENALTY for d in degrees]
        if LATERAL[0] in self.variables:
            objective = [f + (math.log(acceleration) if ride else PENALTY) for f in objective]
        constraints = [math.log(self.speed * MPH / speed)] if self.speed else []
        for key, limit in self.limits.items():
            name = "primary" if "primary" in key else "secondary"
            rms = ride[f"{name}_stroke_rms_m"] if ride else [None] * (4 if name == "primary" else 2)
            reach = number(limit) * INCH
            constraints += [math.log(3 * r / reach) if ride else PENALTY for r in rms]
        indices = {"mph": speed / MPH, "degree": min(degrees) if solved else 0.0, "g": acceleration}
        return objective, constraints, indices

    def show(self, found):
        """The objective of a run in engineering units."""
        if found is None:
            return "none feasible"
        if self.front:
            return f"area {-found['objective']:.4f}, {found['designs']} designs"
        degree, g = f"{found['degree']:.4f}°", f"{found['g'] or 0:.5f} g"
        parts = [(PRIMARY[0], degree), (LATERAL[0], g)]
        return ", ".join(text for key, text in parts if key in self.variables)


class Run:
    """One run of a method: evaluates designs at points of the unit box and keeps a log."""

    def __init__(self, case):
        self.case, self.known, self.log, self.began = case, {}, [], time.monotonic()

    def at(self, x):
        x = tuple(float(u) for u in np.clip(x, 0, 1))
        if x not in self.known:
            design = self.case.design(x)
            self.known[x] = self.case.evaluate(design)
            self.log.append(entry(*self.known[x], design, x))
        return self.known[x]

    def objective(self, x):
        return max(self.at(x)[0])

    def constraints(self, x):
        return np.array(self.at(x)[1])

    def all(self, columns):
        """Evaluates the columns of an array, two at a time."""
        return list(POOL.map(self.at, np.reshape(columns, (self.case.n, -1)).T))

    def result(self):
        return record(self.log, time.monotonic() - self.began)


def entry(objective, constraints, indices, design, x=None):
    """Of a log."""
    return {"objective": max(objective), "violation": max([0.0, *constraints]), **indices,
            "design": design, "x": x}


def record(log, seconds):
    return {"log": log, "evaluations": len(log), "seconds": seconds}


def slsqp(run, start, minimax=False):
    """From one start."""
    bounds = [(0, 1)] * run.case.n
    options = {"ftol": 1e-8, "eps": 1e-4}
    if not minimax:
        minimize(run.objective, start, method="SLSQP", bounds=bounds, options=options,
                 constraints={"type": "ineq", "fun": lambda x: -run.constraints(x)})
        return

    def below(y):
        objective, constraints, _ = run.at(y[:-1])
        return np.array([y[-1] - f for f in objective] + [-g for g in constraints])

    minimize(lambda y: y[-1], [*start, run.objective(start)], method="SLSQP", options=options,
             bounds=[*bounds, (None, None)], constraints={"type": "ineq", "fun": below})


def cobyqa(run, start):
    minimize(run.objective, start, method="COBYQA", bounds=Bounds([0] * run.case.n, 1),
             constraints=NonlinearConstraint(run.constraints, -np.inf, 0),
             options={"initial_tr_radius": 0.1})


def local(case, seed, name, search):
    """One run of several starts, and every random start by itself."""
    starts = qmc.LatinHypercube(case.n, rng=seed).random(OPTIONS.starts - 1)
    results = []
    for start in [case.given(), *starts]:
        run = Run(case)
        search(run, start)
        results.append(run.result())
    for result in results[1:]:
        yield f"{name}, 1 start", result
    log = [e for result in results for e in result["log"]]
    yield f"{name}, {len(results)} starts", record(log, sum(r["seconds"] for r in results))


def evolution(case, seed):
    """One run, as it is and polished."""
    run = Run(case)
    differential_evolution(
        lambda x: np.array([math.exp(max(f)) for f, _, _ in run.all(x)]),
        [(0, 1)] * case.n,
        constraints=NonlinearConstraint(
            lambda x: np.array([g for _, g, _ in run.all(x)]).T, -np.inf, 0),
        polish=False, rng=seed, vectorized=True, updating="deferred",
        maxiter=5 if OPTIONS.quick else 1000,
    )
    result = run.result()
    yield "DE", {**result, "log": list(run.log)}
    found = best(result["log"])
    if found:
        slsqp(run, found["x"])
    yield "DE+SLSQP", run.result()


def nsga2(case, seed):
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize as evolve

    run = Run(case)

    class Front(Problem):
        def _evaluate(self, x, out, *_, **__):
            indices = [i for _, _, i in run.all(x.T)]
            out["F"] = np.array([[-i["mph"], -i["degree"]] for i in indices])

    generations = 10 if OPTIONS.quick else 100
    final = evolve(Front(n_var=case.n, n_obj=2, xl=0.0, xu=1.0), NSGA2(pop_size=100),
                   ("n_gen", generations), seed=seed)
    chosen = {tuple(x) for x in np.atleast_2d(final.X).tolist()}
    result = run.result()
    yield "NSGA-II", {**result, "log": [e for e in result["log"] if e["x"] in chosen]}


def front(points):
    """Points (mph, °) that no other excels in both; the highest speed first."""
    kept = []
    for speed, degree in sorted(map(tuple, points), reverse=True):
        if not kept or degree > kept[-1][1]:
            kept.append((float(speed), float(degree)))
    return kept


def area(points):
    """Below a front, in logarithms from CORNER."""
    inside = [p for p in points if p[0] > CORNER[0] and p[1] > CORNER[1]]
    if not inside:
        return 0.0
    x, y = np.log(np.array(inside[::-1]) / CORNER).T
    return float(x[0] * y[0] + np.trapezoid(y, x))


def bogie(case, seed):
    """bogie's own way: (designs, evaluations, seconds), one design or those of a front. The designs
    then go through the evaluator like all others.
    """
    spec = copy.deepcopy(case.spec)
    spec["design"]["seed"] = seed
    if len(case.variables) > 2:
        spec["objective"] = {"maximize": "degree_curve", "minimize": "lateral_acceleration"}
    if case.front:
        spec["pareto"] = {"bounds": {"critical_speed": f"{CORNER[0]} mph"}}
    began = time.monotonic()
    result = call("pareto" if case.front else "optimize", spec)
    seconds = time.monotonic() - began
    if case.front:
        designs = [
            {"primary": {
                "longitudinal_stiffness":
                    f"{p['primary_bending_stiffness_n_m_per_rad'] / (D_P * 0.3048)**2!r} N/m",
                "lateral_stiffness": f"{p['primary_lateral_stiffness_n_per_m']!r} N/m"}}
            for p in result["points"]
        ]
    else:
        designs = [suspension(result["design_si"])]
    return designs, result["evaluations"], seconds


def suspension(si):
    """What may vary, from a design in SI units."""
    def value(key, unit):
        return f"{si['suspension.' + key]!r} {unit}"

    return {
        "primary": {f"{way}_stiffness": value(f"primary.{way}_stiffness", "N/m")
                    for way in ("longitudinal", "lateral")},
        "secondary": {"lateral_stiffness": value("secondary.lateral_stiffness", "N/m"),
                      "lateral_damping": value("secondary.lateral_damping", "N s/m")},
    }


def own(case, seed):
    """A run of bogie, in the form of the others."""
    designs, evaluations, seconds = bogie(case, seed)
    log = [entry(*case.evaluate(design), design) for design in designs]
    yield "bogie", {"log": log, "evaluations": evaluations, "seconds": seconds, "own": True}


def best(log):
    """Its best feasible design, or `None`."""
    feasible = [e for e in log if e["violation"] <= FEASIBLE]
    return min(feasible, key=lambda e: e["objective"], default=None)


def runs(case, seed):
    """All methods on a case."""
    yield from own(case, seed)
    if case.front:
        yield from nsga2(case, seed)
        return
    yield from local(case, seed, "SLSQP", slsqp)
    if PRIMARY[0] in case.variables:
        yield from local(case, seed, "SLSQP-minimax", lambda r, s: slsqp(r, s, minimax=True))
    yield from local(case, seed, "COBYQA", cobyqa)
    yield from evolution(case, seed)


def spread(values, digits=0):
    """Median and range."""
    median = f"{statistics.median(values):.{digits}f}"
    if min(values) == max(values):
        return median
    return f"{median} ({min(values):.{digits}f}–{max(values):.{digits}f})"


def compare(case):
    """Rows of the table, and the raw results."""
    methods = {}
    for seed in range(1, OPTIONS.runs + 1):
        print(f"{case.title}: run {seed} of {OPTIONS.runs}", file=sys.stderr)
        for method, result in runs(case, seed):
            if case.front:
                result["front"] = points = front((e["mph"], e["degree"]) for e in result["log"])
                result["found"] = {"objective": -area(points), "designs": len(points)}
            else:
                result["found"] = best(result["log"])
            methods.setdefault(method, []).append(result)
    found = [r["found"] for results in methods.values() for r in results if r["found"]]
    known = min((f["objective"] for f in found), default=math.inf)
    # Within 0.1 % of D or a, or of the area.
    goal = known + NEAR * (abs(known) if case.front else 1.0)
    rows, raw = [], []
    for method, results in methods.items():
        order = sorted(results, key=lambda r: r["found"]["objective"] if r["found"] else math.inf)
        for r in results:
            hits = (i + 1 for i, e in enumerate(r["log"])
                    if e["violation"] <= FEASIBLE and e["objective"] <= goal)
            # bogie's log holds nothing but the result, a front's nothing but the front.
            r["needed"] = None if r.get("own") or case.front else next(hits, None)
        reached = sum(bool(r["found"]) and r["found"]["objective"] <= goal for r in results)
        needed = [r["needed"] for r in results if r["needed"]]
        rows.append([
            method, str(len(results)), spread([r["evaluations"] for r in results]),
            spread(needed) if needed else "—", case.show(order[0]["found"]),
            case.show(order[(len(order) - 1) // 2]["found"]),
            f"{100 * reached / len(results):.0f} %", spread([r["seconds"] for r in results], 1),
        ])
        raw += [{"case": case.title, "method": method,
                 **{k: v for k, v in r.items() if k not in ("log", "own")}} for r in results]
    return rows, raw


def table(rows):
    head = ["method", "runs", "evaluations", "to 0.1 %", "best run", "median run", "reached",
            "seconds"]
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]
    lines = [head, ["-" * w for w in widths], *rows]
    return "\n".join(
        "| " + " | ".join(c.ljust(w) for c, w in zip(line, widths)) + " |" for line in lines)


def main():
    conicity, intercity = "conicity-0.10.toml", "intercity-130mph.toml"
    primary, secondary = "primary_lateral_stroke", "secondary_lateral_stroke"
    cases = {
        1: lambda: Case("1 Stability–curving, conicity 0.10", conicity, PRIMARY, []),
        2: lambda: Case("2 Stability–curving, intercity", intercity, PRIMARY, [primary]),
        3: lambda: Case("3 Lateral ride–stroke, intercity", intercity, LATERAL, [secondary], False),
        4: lambda: Case("4 Joint, intercity", intercity, PRIMARY + LATERAL, [primary, secondary]),
        5: lambda: Case("5 Front, conicity 0.10", conicity, PRIMARY, [], False, front=True),
    }
    raw = []
    for key in map(int, OPTIONS.cases.split(",")):
        case = cases[key]()
        rows, results = compare(case)
        raw += results
        print(f"### {case.title}\n\n{table(rows)}\n", flush=True)
    if OPTIONS.json:
        Path(OPTIONS.json).write_text(json.dumps(raw, indent=1))


def options():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bogie", default=str(ROOT / "target/release/bogie"), metavar="PATH")
    parser.add_argument("--runs", type=int, default=5, metavar="N", help="seeds (5)")
    parser.add_argument("--cases", default="1,2,3,4,5", metavar="1,2")
    parser.add_argument("--quick", action="store_true", help="2 starts, 5 or 10 generations")
    parser.add_argument("--json", metavar="FILE", help="write raw results")
    chosen = parser.parse_args()
    chosen.starts = 2 if chosen.quick else 8
    return chosen


if __name__ == "__main__":
    OPTIONS = options()
    main()
