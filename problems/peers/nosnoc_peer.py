"""nosnoc: finite elements with switch detection, solved as nonlinear programs by IPOPT, on the
harmonic oscillator of two springs."""

import contextlib
import io
import time

import casadi as ca
import nosnoc as ns
import numpy as np

# finite elements of a program
ELEMENTS = 2
# the tolerance of complementarity, which errors do not fall below
COMPLEMENTARITY = 1e-9


def loop(stages, programs, t_end):
    """A simulation by Radau IIA, that has not begun; what one has left does not serve the next."""
    x = ca.SX.sym("x", 2)
    fields = ca.horzcat(ca.vertcat(x[1], -x[0]), ca.vertcat(x[1], -3 * x[0]))
    sides = np.array([[1], [-1]])
    start = np.array([1.0, 1.0])
    model = ns.NosnocModel(x=x, F=[fields], S=[sides], c=[x[1]], x0=start)
    options = ns.NosnocOpts()
    options.irk_scheme, options.n_s = ns.IrkSchemes.RADAU_IIA, stages
    options.N_finite_elements, options.terminal_time = ELEMENTS, t_end / programs
    options.comp_tol = options.sigma_N = COMPLEMENTARITY
    options.step_equilibration = ns.StepEquilibrationMode.L2_RELAXED_SCALED
    options.mpcc_mode = ns.MpccMode.SCHOLTES_INEQ
    options.homotopy_update_slope = 0.1
    options.print_level = 0
    solver = ns.NosnocSolver(options, model)
    return ns.NosnocSimLooper(solver, model.x0, programs, print_level=0)


def integrator(stages, programs):
    """A function of an end time and a number of repeats that gives a run."""

    def run(t_end, repeats):
        seconds = []
        for _ in range(repeats):
            simulation = loop(stages, programs, t_end)
            start = time.thread_time()
            with contextlib.redirect_stdout(io.StringIO()):
                simulation.run()
            seconds.append(time.thread_time() - start)
        results = simulation.get_results()
        if any(status != ns.Status.SUCCESS for status in results["status"]):
            raise RuntimeError("a program was not solved")
        x = [float(component) for component in results["X_sim"][-1]]
        return seconds, x, len(results["switch_times"]), ELEMENTS * programs

    return run
