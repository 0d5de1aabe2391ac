"""Stiff problems: the library beside CVODE, diffsol and Radau5, time at equal errors.

The error is that of the final state, each component relative to its exact value. For each level the
fastest setting of the library and of each peer is chosen as in `compare.py`, and the library runs
in turn with each peer: the ratio is the median of the pairs, above 1 where the library is faster.
Standard output gets a table in Markdown, and the directory of the results `stiff.csv`.
"""

import argparse
import csv
import pathlib
import statistics

from program import Program
from settings import LONGEST, Setting, chosen, in_turn, spread

LEVELS = [1e-3, 1e-5, 1e-7, 1e-9]
TOLERANCES = [10 ** (-k / 2) for k in range(3, 30)]
# of this library and of the peers, the integrators
OURS = [["radau-iia-3", "radau-iia-5"], ["best"]]
PEERS = {
    "CVODE": ["cvode-bdf"],
    "diffsol": ["diffsol-bdf", "diffsol-tr-bdf2", "diffsol-esdirk34"],
    "Radau5": ["radau5"],
}
# the name of a peer whose absolute tolerances are finer ends so
FINE = "-fine"


def relative(run, exact):
    """The same run with a final state relative to the exact one."""

    def scaled(t_end, repeats):
        seconds, x, changes, steps = run(t_end, repeats)
        return seconds, [x / size for x, size in zip(x, exact)], changes, steps

    return scaled


def settings_of(program, problem, scheme):
    """Every setting of an integrator."""
    name, exact = problem["name"], problem["x"]
    sample = {"t": problem["t_end"], "x": [1.0] * len(exact), "crossings": problem["changes"]}
    for tolerance in TOLERANCES:
        try:
            run = relative(program.integrator(name, scheme, tolerance), exact)
            setting = Setting(scheme, tolerance, run, sample)
        except RuntimeError:
            # what an integrator refuses is no setting of it
            continue
        yield setting
        if setting.seconds > LONGEST:
            break


def described(setting, level, seconds):
    """Of a setting the time, scheme and tolerance, or how far it comes."""
    by = f"{setting.who} {setting.tolerance:.0e}"
    if setting.error > level:
        return f"– ({by} reaches {setting.error:.0e})"
    return f"{seconds * 1e3:.3f} ms, {by}"


class Table:
    """The table on standard output and in a file."""

    COLUMNS = ["problem", "level", "ours", "our_tolerance", "our_error", "our_steps"]
    COLUMNS += ["our_seconds", "peer", "tolerance", "error", "steps", "seconds"]
    COLUMNS += ["ratio_min", "ratio_median", "ratio_max"]

    def __init__(self, directory):
        directory.mkdir(parents=True, exist_ok=True)
        self.file = open(directory / "stiff.csv", "w")
        self.csv = csv.writer(self.file)
        self.csv.writerow(self.COLUMNS)
        heads = ["problem", "error", "this library", *PEERS]
        print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|", flush=True)

    def row(self, problem, level, ours, peers):
        """A level: our setting beside those of the peers."""
        own, cells = [], []
        for peer in peers:
            rounds = in_turn(ours, peer)
            ratios = spread([b / a for a, b, _ in rounds])
            seconds = [statistics.median(times) for times in zip(*rounds)]
            own.append(seconds[0])
            cell = described(peer, level, seconds[1])
            if max(ours.error, peer.error) <= level:
                cell += f": **{ratios[1]:.2f}**" + ("" if ratios[1] >= 1 else " (loss)")
            cells.append(cell)
            side = [[it.who, it.tolerance, it.error, it.steps] for it in (ours, peer)]
            self.csv.writerow(
                [problem, level, *side[0], seconds[0], *side[1], seconds[1], *ratios]
            )
        first = described(ours, level, statistics.median(own))
        print("| " + " | ".join([problem, f"{level:.0e}", first, *cells]) + " |", flush=True)
        self.file.flush()


def compare(program, problem, table):
    """All levels of a problem."""
    schemes = program.ask("schemes", problem["name"])
    settings = {scheme: list(settings_of(program, problem, scheme)) for scheme in schemes}
    of = lambda names: [
        setting
        for scheme, own in settings.items()
        if scheme.removesuffix(FINE) in names
        for setting in own
    ]
    peers = [of(names) for names in PEERS.values()]
    for ours in filter(None, map(of, OURS)):
        for level in LEVELS:
            fastest = [chosen(peer, level) for peer in peers]
            table.row(problem["name"], level, chosen(ours, level), fastest)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="of the four these")
    parser.add_argument("--program", required=True, help="the program of the folder `stiff`")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("output/peers"))
    arguments = parser.parse_args()
    program = Program(arguments.program)
    table = Table(arguments.out)
    for problem in program.ask("problems"):
        if not arguments.problems or problem["name"] in arguments.problems:
            compare(program, problem, table)


if __name__ == "__main__":
    main()
