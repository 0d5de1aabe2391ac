"""heyoka: Taylor's method, compiled for a system at run time.

One integrator for both regions: a terminal event on g sets, in its callback, the constants that
differ. A user of heyoka's C++ library would not pay for Python, there and at the start of a run,
so that cost is measured and reported beside the plain times.
"""

import statistics
import time

import heyoka as hy
import numpy as np

from formulas import Formulas
from settings import LEAST_REPEATS, turn

# seconds of a run to where it starts, or less
SHORTEST = 2e-6
# measurements of what Python takes, of which the median counts
ROUNDS = 15
#: of exact states: twice as many as a double has
BITS = 113


class Heyoka:
    """An integrator of a problem."""

    def __init__(self, description, tolerance, callback_bodies=1):
        formulas = Formulas(description)
        field = formulas.field(description["regions"])
        self.initial = np.array(description["initial"])
        self.values = {
            1: np.array([pair[0] for pair in formulas.switched]),
            -1: np.array([pair[1] for pair in formulas.switched]),
        }
        self.crossings = 0
        events, self.start = [], 1
        for text in description["interfaces"]:
            g = formulas.one(text)
            at_start = hy.cfunc([g], list(formulas.states))(self.initial)[0]
            self.start = 1 if at_start > 0 else -1
            events.append(hy.t_event(g, callback=self.callback(callback_bodies)))
        self.integrator = hy.taylor_adaptive(
            list(zip(formulas.states, field)),
            self.initial,
            pars=self.values[self.start],
            tol=tolerance,
            t_events=events,
        )

    def callback(self, bodies):
        """What an event does, `bodies` times."""
        above, below = self.values[1], self.values[-1]

        if len(above) == 1:
            above, below = above[0], below[0]

            def switch(integrator, direction):
                self.crossings += 1
                integrator.pars[0] = above if direction > 0 else below
                return True

        else:

            def switch(integrator, direction):
                self.crossings += 1
                integrator.pars[:] = above if direction > 0 else below
                return True

        def several(integrator, direction):
            for _ in range(bodies):
                switch(integrator, direction)
            return True

        return switch if bodies == 1 else several

    def once(self, t_end, callback=None):
        """The number of steps of a run; `callback` is called at each."""
        integrator = self.integrator
        integrator.time = 0.0
        integrator.state[:] = self.initial
        integrator.pars[:] = self.values[self.start]
        if integrator.with_events:
            integrator.reset_cooldowns()
        self.crossings = 0
        return integrator.propagate_until(t_end, callback=callback)[3]

    def run(self, t_end, repeats, callback=None):
        """Seconds of each repeat, final state, crossings, steps."""
        seconds = []
        for _ in range(repeats):
            start = time.thread_time()
            steps = self.once(t_end, callback)
            seconds.append(time.thread_time() - start)
        return seconds, list(self.integrator.state), self.crossings, steps

    def run_with_entries(self, t_end, repeats):
        """The same, with a callback at each step that does nothing."""
        return self.run(t_end, repeats, lambda integrator: True)


def exact_state(description, t_end):
    """The state at `t_end` of a smooth problem, computed with BITS bits."""
    formulas = Formulas(description)
    system = list(zip(formulas.states, formulas.field(description["regions"])))
    initial = np.array([hy.real(value, BITS) for value in description["initial"]])
    integrator = hy.taylor_adaptive(system, initial, fp_type=hy.real)
    integrator.propagate_until(hy.real(t_end, BITS))
    return [float(value) for value in integrator.state]


class CostOfPython:
    """The seconds that Python takes of a run: those to where it starts, and those of each crossing. The
    latter are the body of the callback, found by doing it more often than once, and entering Python,
    found by a callback at each step that does nothing."""

    def __init__(self, description, tolerance, t_end):
        smooth = Heyoka(description | {"interfaces": []}, tolerance)
        self.start, self.t_end, self.runs = smooth.run, t_end, []
        if description["interfaces"]:
            twice, often = (Heyoka(description, tolerance, bodies) for bodies in (2, 6))
            self.start = twice.run
            runs = [twice.run, often.run, smooth.run, smooth.run_with_entries]
            # with what one of each takes
            self.runs = [(run, min(run(t_end, LEAST_REPEATS)[0])) for run in runs]
            self.bodies, self.entries = often.crossings - twice.crossings, smooth.once(t_end)
        rounds = zip(*(self.each() for _ in range(ROUNDS)))
        self.a_run, self.a_crossing = map(statistics.median, rounds)

    def each(self):
        """Seconds of a run to where it starts, and of a crossing, as they are now."""
        a_run = turn(self.start, 0.0, SHORTEST)
        if not self.runs:
            return a_run, 0.0
        twice, often, plain, entered = (turn(run, self.t_end, about) for run, about in self.runs)
        return a_run, (often - twice) / self.bodies + (entered - plain) / self.entries

    def about(self, crossings):
        """Seconds of a run with so many crossings."""
        return self.a_run + self.a_crossing * crossings

    def now(self, crossings):
        """The same, measured anew: the processor's clock changes."""
        a_run, a_crossing = self.each()
        return a_run + a_crossing * crossings
