//! SUNDIALS on smooth problems: CVODE by Adams's methods of order 1 to 12 with fixed-point iteration, which
//! its guide names for problems that are not stiff, and explicit Runge–Kutta methods of ARKODE, Verner's of
//! order 9 and Dormand and Prince's of order 5.

use std::ffi::{CStr, c_char, c_int, c_long, c_void};
use std::ptr::{from_ref, null_mut};

use dmm_runtime::System;
use sundials_sys::*;

use crate::sides::Sides;
use crate::{End, Outcome};

// the bindings do without ARKODE
unsafe extern "C" {
    fn ERKStepCreate(f: CVRhsFn, t0: f64, x0: N_Vector, context: SUNContext) -> *mut c_void;
    fn ERKStepSetTableName(memory: *mut c_void, table: *const c_char) -> c_int;
    fn ARKodeSStolerances(memory: *mut c_void, relative: f64, absolute: f64) -> c_int;
    fn ARKodeSetUserData(memory: *mut c_void, data: *mut c_void) -> c_int;
    fn ARKodeSetMaxNumSteps(memory: *mut c_void, most: c_long) -> c_int;
    fn ARKodeSetStopTime(memory: *mut c_void, end: f64) -> c_int;
    fn ARKodeEvolve(memory: *mut c_void, end: f64, x: N_Vector, t: *mut f64, task: c_int) -> c_int;
    fn ARKodeGetNumSteps(memory: *mut c_void, steps: *mut c_long) -> c_int;
    fn ARKodeFree(memory: *mut *mut c_void);
}

/// `ARK_NORMAL`: until the end.
const UNTIL_END: c_int = 1;

const MOST_STEPS: c_long = 2_000_000;

/// The numbers of a vector.
///
/// # Safety
/// It has N of them, and nothing else refers to them.
unsafe fn numbers<'a, const N: usize>(vector: N_Vector) -> &'a mut [f64; N] {
    unsafe { &mut *N_VGetArrayPointer(vector).cast() }
}

unsafe extern "C" fn field<Sys: System<N>, const N: usize>(
    t: f64,
    x: N_Vector,
    dx: N_Vector,
    sides: *mut c_void,
) -> c_int {
    let sides = unsafe { &*sides.cast::<Sides<'_, Sys, N>>() };
    unsafe { *numbers(dx) = sides.field(t, numbers(x)) };
    0
}

fn checked(what: &str, code: c_int) -> Outcome<()> {
    if code < 0 {
        Err(format!("{what}: {code}").into())
    } else {
        Ok(())
    }
}

/// A vector, the context that it belongs to, and what f is given.
struct State {
    context: SUNContext,
    x: N_Vector,
    data: *mut c_void,
}

impl State {
    /// What is not smooth is not asked of SUNDIALS here: methods of several steps begin anew at each crossing.
    fn new<Sys: System<N>, const N: usize>(
        sides: &Sides<'_, Sys, N>,
        initial: [f64; N],
    ) -> Outcome<Self> {
        if !sides.is_smooth() {
            return Err("no problem for this integrator: it has interfaces".into());
        }
        let data = from_ref(sides).cast_mut().cast();
        let mut context = null_mut();
        unsafe {
            checked("context", SUNContext_Create(SUN_COMM_NULL, &mut context))?;
            // failures are told by the codes that functions return
            SUNContext_ClearErrHandlers(context);
            let x = N_VNew_Serial(N as sunindextype, context);
            *numbers(x) = initial;
            Ok(Self { context, x, data })
        }
    }

    fn end<const N: usize>(&self, steps: c_long) -> End<N> {
        End {
            x: unsafe { *numbers(self.x) },
            steps: steps as u64,
            crossings: 0,
        }
    }
}

impl Drop for State {
    fn drop(&mut self) {
        unsafe {
            N_VDestroy(self.x);
            SUNContext_Free(&mut self.context);
        }
    }
}

/// CVODE's memory, with its solver of equations.
struct Cvode {
    memory: *mut c_void,
    solver: SUNNonlinearSolver,
}

impl Drop for Cvode {
    fn drop(&mut self) {
        unsafe {
            CVodeFree(&mut self.memory);
            SUNNonlinSolFree(self.solver);
        }
    }
}

pub fn adams<Sys: System<N>, const N: usize>(
    sides: &Sides<'_, Sys, N>,
    initial: [f64; N],
    t_end: f64,
    tolerance: f64,
) -> Outcome<End<N>> {
    let state = State::new(sides, initial)?;
    let (mut t, mut steps) = (0.0, 0);
    unsafe {
        let made = Cvode {
            memory: CVodeCreate(CV_ADAMS, state.context),
            solver: SUNNonlinSol_FixedPoint(state.x, 0, state.context),
        };
        let memory = made.memory;
        let right_hand_side = Some(field::<Sys, N> as _);
        checked("init", CVodeInit(memory, right_hand_side, 0.0, state.x))?;
        checked(
            "tolerances",
            CVodeSStolerances(memory, tolerance, tolerance),
        )?;
        checked("data", CVodeSetUserData(memory, state.data))?;
        checked("solver", CVodeSetNonlinearSolver(memory, made.solver))?;
        checked("steps", CVodeSetMaxNumSteps(memory, MOST_STEPS))?;
        checked("end", CVodeSetStopTime(memory, t_end))?;
        checked("a step", CVode(memory, t_end, state.x, &mut t, CV_NORMAL))?;
        checked("steps", CVodeGetNumSteps(memory, &mut steps))?;
    }
    Ok(state.end(steps))
}

/// ARKODE's memory.
struct Arkode(*mut c_void);

impl Drop for Arkode {
    fn drop(&mut self) {
        unsafe { ARKodeFree(&mut self.0) };
    }
}

/// By the method whose name in ARKODE is `table`.
pub fn explicit<Sys: System<N>, const N: usize>(
    sides: &Sides<'_, Sys, N>,
    initial: [f64; N],
    t_end: f64,
    tolerance: f64,
    table: &CStr,
) -> Outcome<End<N>> {
    let state = State::new(sides, initial)?;
    let (mut t, mut steps) = (0.0, 0);
    unsafe {
        let right_hand_side = Some(field::<Sys, N> as _);
        let made = Arkode(ERKStepCreate(right_hand_side, 0.0, state.x, state.context));
        let memory = made.0;
        checked("method", ERKStepSetTableName(memory, table.as_ptr()))?;
        checked(
            "tolerances",
            ARKodeSStolerances(memory, tolerance, tolerance),
        )?;
        checked("data", ARKodeSetUserData(memory, state.data))?;
        checked("steps", ARKodeSetMaxNumSteps(memory, MOST_STEPS))?;
        checked("end", ARKodeSetStopTime(memory, t_end))?;
        checked(
            "a step",
            ARKodeEvolve(memory, t_end, state.x, &mut t, UNTIL_END),
        )?;
        checked("steps", ARKodeGetNumSteps(memory, &mut steps))?;
    }
    Ok(state.end(steps))
}
