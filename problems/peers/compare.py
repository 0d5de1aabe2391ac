"""The library beside other integrators: time against final error, at equal errors.

For each problem, end time and error level the fastest setting of each side is chosen: one that
reaches the level and whose next tighter one does too, so that a lucky error does not count.
Then both run in turn, in the same window on the same core, and the ratio of each pair of times
is kept: minimum, median, maximum. The directory of the results gets `settings.csv` with every
setting, `ratios.csv` with the table, and `work_precision.svg`.
"""

import argparse
import csv
import math
import pathlib
import statistics

from heyoka_peer import Heyoka, cost_of_python, exact_state
from picture import work_precision
from program import Program

PROBLEMS = [
    "elliptic",
    "harmonic",
    "pendulum",
    "lotka_volterra_periodic",
    "kepler_refraction",
    "rigid_body",
    "damped",
    "spiral",
    "henon_heiles",
    "toda",
    "relativistic_oscillator",
]
LEVELS = [1e-3, 1e-6, 1e-9, 1e-12]
TOLERANCES = [10 ** (-k / 2) for k in range(4, 32)]
# a problem is measured until its last sample up to here, and until its very last one
SHORT = 100.0
# seconds and runs that a setting is tried for, and pairs of runs of a comparison
TRIAL, LEAST_TRIALS, PAIRS = 0.02, 3, 25
# tighter tolerances of one that takes longer are not tried: low orders take hours
LONGEST = 0.5
# a run this long is repeated in its turn, because the first after a pause is slower
QUICK, REPEATS = 0.01, 3


class Setting:
    """An integrator at a tolerance on a problem: what it takes and reaches."""

    def __init__(self, who, tolerance, run, sample, a_run=0.0, a_crossing=0.0):
        self.who, self.tolerance, self.function, self.t_end = who, tolerance, run, sample["t"]
        first, x, crossings, self.steps = run(self.t_end, 1)
        self.error = math.dist(x, sample["x"]) if crossings == sample["crossings"] else math.inf
        # what is not the integrator's own
        self.overhead = a_run + a_crossing * crossings
        trials = LEAST_TRIALS + min(50, int(TRIAL / first[0]))
        self.seconds = min(run(self.t_end, trials)[0])

    @property
    def net(self):
        return self.seconds - self.overhead

    def turn(self):
        repeats = REPEATS if self.seconds < QUICK else 1
        return statistics.median(self.function(self.t_end, repeats)[0])


def end_times(description):
    """Times at which the exact state is known, as samples."""
    samples = description["samples"]
    if not samples:
        return [{"t": SHORT, "x": exact_state(description, SHORT), "crossings": 0}]
    last_short = [sample for sample in samples if sample["t"] <= SHORT][-1]
    return [last_short] + [sample for sample in samples[-1:] if sample["t"] > SHORT]


def settings_of(program, problem, sample):
    """Every setting of a program's integrators."""
    for scheme in program.schemes():
        for tolerance in TOLERANCES:
            try:
                run = program.integrator(problem, scheme, tolerance)
                setting = Setting(scheme, tolerance, run, sample)
            except RuntimeError as refused:
                print(f"    {scheme} at {tolerance:.0e}: {refused}")
                continue
            yield setting
            if setting.seconds > LONGEST:
                break


def settings_of_heyoka(description, sample):
    costs = cost_of_python(description, 1e-9, min(sample["t"], SHORT))
    a_run, a_crossing = (1e6 * cost for cost in costs)
    print(f"  heyoka: Python takes {a_run:.1f} µs a run, {a_crossing:.2f} µs a crossing")
    for tolerance in TOLERANCES:
        run = Heyoka(description, tolerance).run
        yield Setting("heyoka", tolerance, run, sample, *costs)


def chosen(settings, level):
    """The fastest setting that reaches a level, or the most accurate one if none does."""
    reliable = []
    for who in dict.fromkeys(setting.who for setting in settings):
        own = [setting for setting in settings if setting.who == who]
        for setting, tighter in zip(own, own[1:] + own[-1:]):
            if max(setting.error, tighter.error) <= level:
                reliable.append(setting)
    fastest = min(reliable, key=lambda setting: setting.net, default=None)
    return fastest or min(settings, key=lambda setting: setting.error)


def duel(ours, peer):
    """Pairs of times, in turn."""
    return [(ours.turn(), peer.turn()) for _ in range(PAIRS)]


def spread(values):
    return min(values), statistics.median(values), max(values)


class Report:
    """The files and the table on standard output."""

    COLUMNS = ["problem", "t_end", "level"]
    SIDE = ["who", "tolerance", "error", "steps", "seconds_min", "seconds_median", "seconds_max"]
    SETTING = ["tolerance", "error", "steps", "seconds", "net"]
    RATIO = ["ratio_min", "ratio_median", "ratio_max"]

    def __init__(self, directory):
        directory.mkdir(parents=True, exist_ok=True)
        self.settings = csv.writer(open(directory / "settings.csv", "w"))
        self.settings.writerow(["problem", "t_end", "who", *self.SETTING])
        self.ratios = csv.writer(open(directory / "ratios.csv", "w"))
        sides = [f"{side}_{column}" for side in ("ours", "peer") for column in self.SIDE]
        net = [f"net_{column}" for column in self.RATIO]
        self.ratios.writerow(self.COLUMNS + sides + self.RATIO + net)

    def setting(self, problem, setting):
        self.settings.writerow(
            [problem, setting.t_end, setting.who, setting.tolerance, setting.error]
            + [setting.steps, setting.seconds, setting.net]
        )

    def level(self, problem, level, ours, peer, pairs):
        ratios = spread([b / a for a, b in pairs])
        net = spread([(b - peer.overhead) / a for a, b in pairs])
        sides = [
            [side.who, side.tolerance, side.error, side.steps, *spread(times)]
            for side, times in zip((ours, peer), zip(*pairs))
        ]
        self.ratios.writerow([problem, ours.t_end, level] + sides[0] + sides[1] + [*ratios, *net])
        describe = lambda side, seconds: (
            f"{side.who} {side.tolerance:.0e}"
            + ("" if side.error <= level else f" (reaches {side.error:.0e})")
            + f" {seconds * 1e3:.4f} ms"
        )
        print(
            f"  {level:.0e}: {describe(ours, sides[0][5])} | {describe(peer, sides[1][5])}"
            f" | ratio {ratios[1]:.2f} ({ratios[0]:.2f}-{ratios[2]:.2f})"
            f" | net of Python {net[1]:.2f} ({net[0]:.2f}-{net[2]:.2f})",
            flush=True,
        )


def compare(problem, sample, description, library, peers, report):
    """All levels of a problem until a time; the settings."""
    print(f"{problem}, T = {sample['t']:g}, {sample['crossings']} crossings", flush=True)
    ours = list(settings_of(library, problem, sample))
    others = list(settings_of_heyoka(description, sample))
    for program in peers:
        others += settings_of(program, problem, sample)
    for setting in ours + others:
        report.setting(problem, setting)
    for level in LEVELS:
        fastest, peer = chosen(ours, level), chosen(others, level)
        report.level(problem, level, fastest, peer, duel(fastest, peer))
    return ours, others


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", default=PROBLEMS)
    parser.add_argument("--library", required=True, help="the program `timed`")
    parser.add_argument("--peers", action="append", default=[], help="another such program")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("output/peers"))
    arguments = parser.parse_args()
    library = Program(arguments.library)
    peers = [Program(path) for path in arguments.peers]
    report, panels = Report(arguments.out), []
    for problem in arguments.problems:
        description = library.describe(problem)
        for sample in end_times(description):
            sides = compare(problem, sample, description, library, peers, report)
            panels.append((f"{problem}, T = {sample['t']:g}", *sides))
    work_precision(panels, arguments.out / "work_precision.svg")


if __name__ == "__main__":
    main()
