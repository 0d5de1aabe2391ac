"""Many trajectories at once: the library beside heyoka's batch mode with terminal events.

The ensemble is elliptic from states and with constants around the problem's own, until T = 100.
The exact states are heyoka's at its tightest tolerance, one trajectory at a time. A row is an
integrator at the loosest tolerance whose median error is at most the level.
"""

import argparse
import csv
import pathlib
import statistics
import tempfile
import time

import heyoka as hy
import numpy as np

from formulas import Formulas
from program import Program

PROBLEM, T_END, SPREAD, LANES = "elliptic", 100.0, 0.02, 8
LEVELS = [1e-6, 1e-9]
TOLERANCES = [10 ** (-k / 2) for k in range(8, 31)]
ROUNDS = 5


class Ensemble:
    """Initial states, and the constants of both sides, of each trajectory."""

    def __init__(self, description, count):
        random = np.random.default_rng(1)
        self.names = description["states"]
        self.parameters = dict(map(tuple, description["parameters"]))
        vary = lambda values: values * (1 + SPREAD * random.uniform(-1, 1, (count, len(values))))
        self.initial = vary(np.array(description["initial"]))
        self.values = vary(np.array(list(self.parameters.values())))

    def write(self, path):
        with open(path, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow([*self.names, *self.parameters])
            writer.writerows(np.hstack([self.initial, self.values]).tolist())


class Batch:
    """heyoka on `lanes` trajectories at once, or on one after another."""

    def __init__(self, description, ensemble, tolerance, lanes):
        formulas = Formulas(description)
        system = list(zip(formulas.states, formulas.field(description["regions"])))
        g = formulas.one(description["interfaces"][0])
        # the one constant that differs, by its value on each side
        (pair,) = formulas.switched
        defaults = list(ensemble.parameters.values())
        self.constants = ensemble.values[:, [defaults.index(value) for value in pair]]
        signs = hy.cfunc([g], list(formulas.states))(np.ascontiguousarray(ensemble.initial.T))[0]
        self.at_start = np.where(signs > 0, *self.constants.T)
        self.initial, self.lanes, self.now = ensemble.initial, lanes, []
        if lanes == 1:
            self.integrator = hy.taylor_adaptive(
                system,
                np.zeros(len(system)),
                pars=[0.0],
                tol=tolerance,
                t_events=[hy.t_event(g, callback=self.callback())],
            )
        else:
            self.integrator = hy.taylor_adaptive_batch(
                system,
                np.zeros((len(system), lanes)),
                pars=np.zeros((1, lanes)),
                tol=tolerance,
                t_events=[hy.t_event_batch(g, callback=self.callback())],
            )

    def callback(self):
        """What an event does; a function, because heyoka copies objects."""

        def one(integrator, direction):
            integrator.pars[0] = self.now[0][0 if direction > 0 else 1]
            return True

        def lane(integrator, direction, lane):
            integrator.pars[0, lane] = self.now[lane][0 if direction > 0 else 1]
            return True

        return one if self.lanes == 1 else lane

    def start(self, part):
        """Puts the integrator to the start of the trajectories `part`."""
        integrator = self.integrator
        if self.lanes == 1:
            integrator.time = 0.0
            integrator.state[:] = self.initial[part][0]
        else:
            integrator.set_time(0.0)
            integrator.state[:] = self.initial[part].T
        integrator.pars[:] = self.at_start[part]
        integrator.reset_cooldowns()
        self.now = self.constants[part].tolist()

    def run(self):
        """Seconds, and the final states."""
        states = np.empty_like(self.initial)
        start = time.thread_time()
        for first in range(0, len(states), self.lanes):
            part = slice(first, first + self.lanes)
            self.start(part)
            self.integrator.propagate_until(T_END)
            states[part] = self.integrator.state.T
        return time.thread_time() - start, states


def candidates(description, ensemble, library, file):
    """Name and run of each integrator at each tolerance."""
    for tolerance in TOLERANCES:
        for lanes in (1, LANES):
            name = "heyoka" if lanes == 1 else f"heyoka, {lanes} lanes"
            yield name, tolerance, Batch(description, ensemble, tolerance, lanes).run
        for how in ("single", "lanes"):

            def run(how=how, tolerance=tolerance):
                words = (PROBLEM, "taylor", f"tolerance={tolerance!r}", T_END, file, how, 1)
                answer = library.ask("ensemble", *words)
                return answer["seconds"][0], np.array(answer["x"])

            yield f"taylor, {how}", tolerance, run


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--library", required=True, help="the program `timed`")
    parser.add_argument("--count", type=int, default=512, help="trajectories")
    arguments = parser.parse_args()
    library = Program(arguments.library)
    description = library.describe(PROBLEM)
    ensemble = Ensemble(description, arguments.count)
    exact = Batch(description, ensemble, 1e-16, 1).run()[1]
    with tempfile.TemporaryDirectory() as directory:
        file = pathlib.Path(directory) / "ensemble.csv"
        ensemble.write(file)
        reached = {}
        for name, tolerance, run in candidates(description, ensemble, library, file):
            states = run()[1]
            error = np.median(np.linalg.norm(states - exact, axis=1))
            for level in LEVELS:
                if error <= level:
                    reached.setdefault((level, name), (tolerance, error, run))
        for level in LEVELS:
            rows = {name: row for (its, name), row in reached.items() if its == level}
            compare(level, rows, arguments.count)


def compare(level, rows, count):
    """All integrators in turn."""
    seconds = {name: [] for name in rows}
    for _ in range(ROUNDS):
        for name, (_, _, run) in rows.items():
            seconds[name].append(run()[0])
    print(f"{PROBLEM}, T = {T_END:g}, median error at most {level:.0e}: trajectories a second")
    for name, (tolerance, error, _) in rows.items():
        rates = [count / one for one in seconds[name]]
        print(
            f"  {name:20} tolerance {tolerance:.0e} error {error:.0e}"
            f" {statistics.median(rates):12.0f} ({min(rates):.0f}-{max(rates):.0f})",
            flush=True,
        )


if __name__ == "__main__":
    main()
