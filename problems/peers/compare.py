"""The library beside other integrators: time against final error, at equal errors.

For each problem, end time and error level the fastest setting of each side is chosen: one that
reaches the level and whose next tighter one does too, so that a lucky error does not count.
Then both run in turn, in the same window on the same core, and the ratio of each pair of times
is kept: minimum, median, maximum. The directory of the results gets `settings.csv` with every
setting, `ratios.csv` with the table, and `work_precision.svg`.
"""

import argparse
import csv
import pathlib

from heyoka_peer import CostOfPython, Heyoka, exact_state
from picture import work_precision
from program import Program
from settings import LONGEST, Setting, chosen, in_turn, spread

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
    "poschl_teller",
    "double_pendulum",
    "three_body",
    "chain_4",
    "chain_8",
    "chain_16",
    "chain_32",
    "chain_64",
    "planets_5",
    "planets_8",
    "outer_planets",
]
LEVELS = [1e-3, 1e-6, 1e-9, 1e-12]
TOLERANCES = [10 ** (-k / 2) for k in range(4, 32)]
# a problem is measured until its last sample up to here, and until its very last one
SHORT = 100.0


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
                if str(refused).startswith("no problem"):
                    break
                continue
            yield setting
            if setting.seconds > LONGEST:
                break


def settings_of_heyoka(description, sample):
    cost = CostOfPython(description, 1e-9, min(sample["t"], SHORT))
    a_run, a_crossing = 1e6 * cost.a_run, 1e6 * cost.a_crossing
    print(f"  heyoka: Python takes {a_run:.1f} µs a run, {a_crossing:.2f} µs a crossing")
    for tolerance in TOLERANCES:
        run = Heyoka(description, tolerance).run
        yield Setting("heyoka", tolerance, run, sample, cost)


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

    def level(self, problem, level, ours, peer, rounds):
        ratios = spread([b / a for a, b, _ in rounds])
        net = spread([own / a for a, _, own in rounds])
        sides = [
            [side.who, side.tolerance, side.error, side.steps, *spread(times)]
            for side, times in zip((ours, peer), zip(*rounds))
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
        report.level(problem, level, fastest, peer, in_turn(fastest, peer))
        slower = dict.fromkeys(setting.who for setting in others if setting.who != peer.who)
        for who in slower:
            own = chosen([setting for setting in others if setting.who == who], level)
            reaches = "" if own.error <= level else f" (reaches {own.error:.0e})"
            print(f"         {who}{reaches} {own.net / fastest.net:.1f} times as long")
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
