#!/usr/bin/env python3
"""How often other methods come to the best known designs of ten of the bench's problems.

Every method asks `cargo bench --bench reliability -- --serve NAME` for the values of designs: the same
study that bogie searches, one process for a whole run. All see the unit box, logarithmic where bogie is,
the objective, and one value for each demand (not positive where it is met). Where a design has no
performance every value is 10. A design that a method asks for twice in a run counts once. Where there
are profiles to choose from, one more coordinate chooses: methods that expect continuous functions
are at a disadvantage there.

  bogie       its own search, as it is used
  SLSQP, COBYQA   SciPy, from the design of the spec and seven random ones, settings of
              benches/yardstick/compare.py
  DE, DE+SLSQP    SciPy's differential evolution with its constraints, and polished by SLSQP, likewise
  SHGO        SciPy; 128 Sobol points, SLSQP on its minima; up to five variables; no seed: one run counts
  annealing   SciPy's dual annealing on the objective and 20 times the largest violation
  GA, pymoo-DE, ISRES   pymoo with its default operators and handling of constraints
  CMA-ES      pymoo on the objective and 20 times the largest violation, with restarts

All but SLSQP, COBYQA, DE and SHGO, which end by themselves, have a budget of 3000 evaluations. A run has
reached the best known design if one of its evaluations is feasible within 1e-5 and within 0.001 of the
best known merit. Each cell: runs that reached it, and the median of all evaluations spent.

Runs of the other methods are kept in others.json and made again with --measure; bogie's are always new.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import threading
import types
import warnings
from pathlib import Path

# Matrices are small: more threads only wait for one another.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402
from scipy.optimize import dual_annealing, shgo  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benches/yardstick"))
import compare  # noqa: E402

PROBLEMS = ["A2", "A6", "B2s", "D3", "eight-decades", "manchester-forces",
            "prototype-damped-kinematic", "prototype-ten", "random-4", "zhai-ordinary-ride"]
KEPT = Path(__file__).with_name("others.json")
NEAR, BUDGET, PENALTY = 1e-3, 3000, 20.0
MARKS = ["<!-- others -->", "<!-- end of others -->"]
BENCH = ["cargo", "bench", "-q", "--bench", "reliability", "--"]


class Served:
    """A problem behind a pipe, in the form that the yardstick's methods expect of a case."""

    front = False

    def __init__(self, name):
        self.process = subprocess.Popen([*BENCH, "--serve", name], cwd=ROOT, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.lock = threading.Lock()
        self.head = json.loads(self.process.stdout.readline())
        self.continuous = len(self.head["variables"])
        self.n = self.continuous + (self.head["profiles"] > 1)

    def given(self):
        return np.array([*self.head["given"], *[0.0] * (self.n - self.continuous)])

    def design(self, x):
        return x

    def evaluate(self, x):
        return self.many([x])[0]

    def many(self, designs):
        with self.lock:
            self.process.stdin.write(json.dumps([list(x) for x in designs]) + "\n")
            self.process.stdin.flush()
            answers = json.loads(self.process.stdout.readline())
        return [([a["objective"]], a["constraints"], {}) for a in answers]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Spent(Exception):
    """The budget of a run."""


class Run(compare.Run):
    """As the yardstick's, with many designs in one question, and a budget if there is one."""

    budget = None

    def at(self, x):
        if self.budget and len(self.log) >= self.budget:
            raise Spent
        return super().at(x)

    def all(self, columns):
        points = np.clip(np.reshape(columns, (self.case.n, -1)).T, 0, 1)
        points = [tuple(map(float, x)) for x in points]
        new = list(dict.fromkeys(x for x in points if x not in self.known))
        for x, values in zip(new, self.case.many(new) if new else []):
            self.known[x] = values
            self.log.append(compare.entry(*values, x, x))
        return [self.known[x] for x in points]

    def penalised(self, x):
        return self.objective(x) + PENALTY * max([0.0, *self.constraints(x)])


def budgeted(case, search):
    run = Run(case)
    run.budget = BUDGET
    try:
        search(run)
    except Spent:
        pass
    return run.result()


def annealing(case, seed):
    yield "annealing", budgeted(case, lambda run: dual_annealing(
        run.penalised, [(0, 1)] * case.n, rng=seed, maxfun=BUDGET))


def simplicial(case, seed):
    if seed > 1 or case.n > 5:
        return

    def search(run):
        shgo(run.objective, [(0, 1)] * case.n, n=128, sampling_method="sobol",
             constraints={"type": "ineq", "fun": lambda x: -run.constraints(x)})

    yield "SHGO", budgeted(case, search)


def pymoo(case, seed):
    from pymoo.algorithms.soo.nonconvex.cmaes import CMAES
    from pymoo.algorithms.soo.nonconvex.de import DE
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.algorithms.soo.nonconvex.isres import ISRES
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize

    class Study(Problem):
        def __init__(self, run, penalised):
            demands = 0 if penalised else case.head["demands"]
            super().__init__(n_var=case.n, n_obj=1, n_ieq_constr=demands, xl=0.0, xu=1.0)
            self.run, self.penalised = run, penalised

        def _evaluate(self, x, out, *_, **__):
            values = self.run.all(np.atleast_2d(x).T)
            if self.penalised:
                out["F"] = np.array([f[0] + PENALTY * max([0.0, *g]) for f, g, _ in values])
            else:
                out["F"] = np.array([f[0] for f, _, _ in values])
                if case.head["demands"]:
                    out["G"] = np.array([g for _, g, _ in values])

    methods = {
        "GA": lambda: GA(), "pymoo-DE": lambda: DE(), "ISRES": lambda: ISRES(),
        "CMA-ES": lambda: CMAES(x0=case.given(), restarts=9),
    }
    for name, method in methods.items():
        run = Run(case)
        minimize(Study(run, name == "CMA-ES"), method(), ("n_eval", BUDGET), seed=seed)
        yield name, run.result()


def starts(case, seed):
    """Several starts as one method."""
    for name, search in (("SLSQP", compare.slsqp), ("COBYQA", compare.cobyqa)):
        for label, result in compare.local(case, seed, name, search):
            if label.endswith("8 starts"):
                yield name, result


def bogie(names):
    """Runs of bogie itself, by problem: (reached, evaluations)."""
    file = Path(OPTIONS.scratch) / "bogie.json"
    subprocess.run([*BENCH, "--seeds", str(OPTIONS.seeds), *names, "--json", str(file)], cwd=ROOT,
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    runs = {own["name"]: own["seeds"] for own in json.loads(file.read_text())}
    return {name: [(run["reached"], run["evaluations"]) for run in runs[name]] for name in names}


def measure(name):
    """Runs of the other methods: the best feasible objective, or None, and the evaluations."""
    methods = {}
    case = Served(name)
    for seed in range(1, OPTIONS.seeds + 1):
        for method in (starts, compare.evolution, simplicial, annealing, pymoo):
            for label, result in method(case, seed):
                found = compare.best(result["log"])
                run = [found and found["objective"], result["evaluations"]]
                methods.setdefault(label, []).append(run)
                print(f"{name}, seed {seed}, {label}: {run}", file=sys.stderr)
    case.close()
    return methods


def results():
    """Of each problem and method the runs as (reached, evaluations)."""
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    for name in OPTIONS.names:
        if OPTIONS.measure or name not in kept:
            kept[name] = measure(name)
            KEPT.write_text(json.dumps(kept, indent=1) + "\n")
    known = json.loads(KEPT.with_name("best.json").read_text())
    own = bogie(OPTIONS.names)
    return {
        name: {"bogie": own[name]} | {
            label: [(merit is not None and merit <= known[name]["merit"] + NEAR, count)
                    for merit, count in runs]
            for label, runs in kept[name].items()}
        for name in OPTIONS.names
    }


def table(results):
    """Problems by methods."""
    labels = list(dict.fromkeys(label for methods in results.values() for label in methods))
    lines = [["problem", *labels], ["---"] * (len(labels) + 1)]
    reached = {label: [0, 0] for label in labels}
    for name, methods in results.items():
        line = [name]
        for label in labels:
            runs = methods.get(label)
            if not runs:
                line.append("–")
                continue
            hits = sum(hit for hit, _ in runs)
            reached[label][0] += hits
            reached[label][1] += len(runs)
            spent = statistics.median_low([count for _, count in runs])
            line.append(f"{hits} of {len(runs)}, {spent}")
        lines.append(line)
    lines.append(["all"] + [f"{hits} of {count}" for hits, count in reached.values()])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def options():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=PROBLEMS, help="problems (ten)")
    parser.add_argument("--seeds", type=int, default=5, metavar="N", help="runs of each (5)")
    parser.add_argument("--into", metavar="FILE", help="page that takes the table between its marks")
    parser.add_argument("--measure", action="store_true", help="run the other methods again")
    parser.add_argument("--scratch", default="/tmp", help="folder for bogie's runs")
    return parser.parse_args()


if __name__ == "__main__":
    OPTIONS = options()
    # The yardstick's methods, on the problems of this bench.
    compare.OPTIONS = types.SimpleNamespace(quick=False, starts=8)
    compare.Run = Run
    warnings.simplefilter("ignore")
    text = table(results())
    print(text)
    if OPTIONS.into:
        page = Path(OPTIONS.into)
        head, rest = page.read_text().split(MARKS[0])
        page.write_text(f"{head}{MARKS[0]}\n\n{text}\n\n{MARKS[1]}{rest.split(MARKS[1])[1]}")
