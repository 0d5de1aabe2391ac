"""The library beside nosnoc, Radau IIA with switch detection by both, on the problem `harmonic`.

For each setting of nosnoc the library's largest step size is taken that is as accurate, and so is
the next smaller one. Then both run in turn; the ratio is of the times of each pair, of which
minimum, median and maximum are printed.
"""

import argparse
import math
import statistics

import nosnoc_peer
from program import Program
from settings import Setting, spread

T_END = 10.0
STAGES = [2, 3]
# programs of two finite elements each, and pairs of runs
PROGRAMS = [20, 50, 100]
PAIRS = 5
# steps of the library
STEPS = [round(10 * 2 ** (k / 4)) for k in range(60)]


def step_sizes(program, stages, sample):
    """Every setting of the library, from the largest step size."""
    for steps in STEPS:
        step = T_END / steps
        run = program.integrator("harmonic", f"radau-iia-{stages}", step, control="step")
        yield Setting(f"radau-iia-{stages}", step, run, sample)


def as_accurate(settings, error):
    """The first setting that reaches an error, and whose next one does too."""
    pairs = zip(settings, settings[1:])
    return next(one for one, next_one in pairs if max(one.error, next_one.error) <= error)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--library", required=True, help="the program `timed`")
    program = Program(parser.parse_args().library)
    samples = program.describe("harmonic")["samples"]
    sample = next(sample for sample in samples if sample["t"] == T_END)
    heads = ["stages", "nosnoc: steps", "error", "time", "this library: steps", "error", "time"]
    heads += ["ratio (min–max)"]
    print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|", flush=True)
    for stages in STAGES:
        settings = list(step_sizes(program, stages, sample))
        for programs in PROGRAMS:
            run = nosnoc_peer.integrator(stages, programs)
            _, x, switches, steps = run(T_END, 1)
            error = math.dist(x, sample["x"]) if switches == sample["crossings"] else math.inf
            ours = as_accurate(settings, error)
            pairs = [(ours.turn(), run(T_END, 1)[0][0]) for _ in range(PAIRS)]
            low, median, high = spread([b / a for a, b in pairs])
            own, peer = (statistics.median(times) for times in zip(*pairs))
            cells = [stages, steps, f"{error:.1e}", f"{peer:.2f} s", ours.steps]
            cells += [f"{ours.error:.1e}", f"{own * 1e6:.1f} µs"]
            cells += [f"{median:.0f} ({low:.0f}–{high:.0f})"]
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


if __name__ == "__main__":
    main()
