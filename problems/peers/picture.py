"""Work-precision diagrams: time against final error, a panel a problem."""

import math

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222"]
COLUMNS = 3


def work_precision(panels, path):
    """A panel is a title, the library's settings and the peers'."""
    columns = min(COLUMNS, len(panels))
    rows = math.ceil(len(panels) / columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.6 * columns, 3.8 * rows), squeeze=False)
    names = []
    for axis, (title, ours, others) in zip(axes.flat, panels):
        for settings, stroke in ((ours, "-"), (others, "--")):
            for who in dict.fromkeys(setting.who for setting in settings):
                if who not in names:
                    names.append(who)
                known = [s for s in settings if s.who == who and math.isfinite(s.error)]
                axis.loglog(
                    [setting.error for setting in known],
                    [setting.net * 1e3 for setting in known],
                    stroke,
                    marker="o",
                    markersize=3,
                    label=who,
                    color=COLOURS[names.index(who) % len(COLOURS)],
                )
        axis.set_title(title, fontsize=10)
        axis.set_xlabel("final error")
        axis.set_ylabel("time (ms)")
        axis.invert_xaxis()
        axis.legend(fontsize=8)
        axis.grid(True, which="major", alpha=0.3)
    for axis in axes.flat[len(panels) :]:
        axis.remove()
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
