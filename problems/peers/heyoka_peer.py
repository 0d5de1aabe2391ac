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

    def run(self, t_end, repeats):
        """Seconds of each repeat, final state, crossings, steps."""
        seconds = []
        for _ in range(repeats):
            start = time.thread_time()
            steps = self.once(t_end)
            seconds.append(time.thread_time() - start)
        return seconds, list(self.integrator.state), self.crossings, steps


def exact_state(description, t_end):
    """The state at `t_end` of a smooth problem, computed with BITS bits."""
    formulas = Formulas(description)
    system = list(zip(formulas.states, formulas.field(description["regions"])))
    initial = np.array([hy.real(value, BITS) for value in description["initial"]])
    integrator = hy.taylor_adaptive(system, initial, fp_type=hy.real)
    integrator.propagate_until(hy.real(t_end, BITS))
    return [float(value) for value in integrator.state]


def cost_of_python(description, tolerance, t_end, rounds=31):
    """Seconds that Python takes for each run and for each crossing. The former is the time of a
    run to where it starts. The latter is the body of the callback, found by doing it more often
    than once, and entering Python, found by a callback at each step that does nothing."""
    smooth = Heyoka(description | {"interfaces": []}, tolerance)
    if not description["interfaces"]:
        return min(smooth.run(0.0, rounds)[0]), 0.0
    twice, often = (Heyoka(description, tolerance, bodies) for bodies in (2, 6))
    runs, bodies, entries = [], [], []
    for _ in range(rounds):
        runs.append(twice.run(0.0, 1)[0][0])
        difference = often.run(t_end, 1)[0][0] - twice.run(t_end, 1)[0][0]
        bodies.append(difference / (often.crossings - twice.crossings))
        plain = smooth.run(t_end, 1)[0][0]
        start = time.thread_time()
        steps = smooth.once(t_end, lambda integrator: True)
        entries.append((time.thread_time() - start - plain) / steps)
    return min(runs), statistics.median(bodies) + statistics.median(entries)
