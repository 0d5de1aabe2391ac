"""Settings of integrators: what they take and reach, the fastest one for an error, and runs of two in
turn."""

import math
import statistics

# seconds and runs that a setting is tried for, and pairs of runs of a comparison
TRIAL, LEAST_TRIALS, PAIRS = 0.02, 3, 25
# the processor's clock may change from trial to trial: those within this of the least are compared in turn
NEARLY, ROUNDS = 1.7, 9
# tighter tolerances of one that takes longer are not tried: low orders take hours
LONGEST = 0.5
# a turn takes about this long, because the first runs after a pause are slower, and is as many runs at least
# and at most; longer runs are turns of their own
TURN, LEAST_REPEATS, MOST_REPEATS = 0.005, 3, 999


class Setting:
    """An integrator at a tolerance on a problem: what it takes and reaches."""

    def __init__(self, who, tolerance, run, sample, cost=None):
        """`cost` measures what of a run is not the integrator's own, as `CostOfPython` does."""
        self.who, self.tolerance, self.function, self.t_end = who, tolerance, run, sample["t"]
        first, x, crossings, self.steps = run(self.t_end, 1)
        self.error = math.dist(x, sample["x"]) if crossings == sample["crossings"] else math.inf
        self.cost, self.crossings = cost, crossings
        self.overhead = cost.about(crossings) if cost else 0.0
        trials = LEAST_TRIALS + min(50, int(TRIAL / first[0]))
        self.seconds = min(run(self.t_end, trials)[0])

    @property
    def net(self):
        return self.seconds - self.overhead

    def turn(self):
        """Seconds of a run."""
        return turn(self.function, self.t_end, self.seconds)

    def own_turn(self):
        """Seconds of a run, and what of them is the integrator's own."""
        seconds = self.turn()
        return seconds, seconds - (self.cost.now(self.crossings) if self.cost else 0.0)


def turn(run, t_end, about):
    """The median of as many runs, of `about` so many seconds, as make a turn."""
    repeats = min(MOST_REPEATS, max(LEAST_REPEATS, round(TURN / about)))
    if about > 2 * TURN:
        repeats = 1
    return statistics.median(run(t_end, repeats)[0])


def chosen(settings, level):
    """The fastest setting that reaches a level, or the most accurate one if none does."""
    reliable = []
    for who in dict.fromkeys(setting.who for setting in settings):
        own = [setting for setting in settings if setting.who == who]
        for setting, tighter in zip(own, own[1:] + own[-1:]):
            if max(setting.error, tighter.error) <= level:
                reliable.append(setting)
    if not reliable:
        return min(settings, key=lambda setting: setting.error)
    least = min(setting.net for setting in reliable)
    return fastest([setting for setting in reliable if setting.net <= NEARLY * least])


def fastest(settings):
    """The one that takes the least in the same moment, as the median of some rounds in turn."""
    if len(settings) == 1:
        return settings[0]
    shares = {setting: [] for setting in settings}
    for _ in range(ROUNDS):
        times = {setting: setting.turn() - setting.overhead for setting in settings}
        whole = sum(times.values())
        for setting, time in times.items():
            shares[setting].append(time / whole)
    return min(settings, key=lambda setting: statistics.median(shares[setting]))


def in_turn(ours, peer):
    """Times in turn: ours, the peer's, and of the latter what is its own. All are measured in the same
    moment, because the processor's clock changes."""
    return [(ours.turn(), *peer.own_turn()) for _ in range(PAIRS)]


def spread(values):
    return min(values), statistics.median(values), max(values)
