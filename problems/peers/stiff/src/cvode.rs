//! CVODE of SUNDIALS: BDF of order 1 to 5 with Newton's method, dense matrices and the exact
//! Jacobian. At a root it is initialised again with the next field.

use std::ffi::{c_int, c_void};
use std::ptr::{from_mut, null_mut};

use sundials_sys::*;

use crate::Outcome;
use crate::phases::{End, Part, Tolerances, integrate};
use crate::plain::Plain;

const MOST_STEPS: i64 = 1_000_000;

/// The numbers of a vector.
///
/// # Safety
/// It has N of them.
unsafe fn numbers<'a, const N: usize>(vector: N_Vector) -> &'a mut [f64; N] {
    unsafe { &mut *N_VGetArrayPointer(vector).cast() }
}

unsafe extern "C" fn field<P: Plain<N>, const N: usize>(
    _: f64,
    x: N_Vector,
    dx: N_Vector,
    phase: *mut c_void,
) -> c_int {
    unsafe { *numbers(dx) = P::field(*phase.cast(), numbers(x)) };
    0
}

unsafe extern "C" fn jacobian<P: Plain<N>, const N: usize>(
    _: f64,
    x: N_Vector,
    _: N_Vector,
    matrix: SUNMatrix,
    phase: *mut c_void,
    _: N_Vector,
    _: N_Vector,
    _: N_Vector,
) -> c_int {
    let rows = unsafe { P::jacobian(*phase.cast(), numbers(x)) };
    let columns: &mut [[f64; N]; N] = unsafe { &mut *SUNDenseMatrix_Data(matrix).cast() };
    *columns = std::array::from_fn(|k| std::array::from_fn(|i| rows[i][k]));
    0
}

unsafe extern "C" fn roots<P: Plain<N>, const N: usize>(
    _: f64,
    x: N_Vector,
    g: *mut f64,
    phase: *mut c_void,
) -> c_int {
    unsafe { *g.cast() = P::roots(*phase.cast(), numbers(x)) };
    0
}

fn checked(what: &str, code: c_int) -> Outcome<c_int> {
    if code < 0 {
        Err(format!("{what}: {code}").into())
    } else {
        Ok(code)
    }
}

/// What SUNDIALS has allocated.
struct Allocated {
    context: SUNContext,
    x: N_Vector,
    tolerances: N_Vector,
    matrix: SUNMatrix,
    solver: SUNLinearSolver,
    memory: *mut c_void,
}

impl Allocated {
    fn new<const N: usize>() -> Outcome<Self> {
        let mut context = null_mut();
        let states = N as sunindextype;
        unsafe {
            checked("context", SUNContext_Create(SUN_COMM_NULL, &mut context))?;
            // failures are told by the codes that functions return
            SUNContext_ClearErrHandlers(context);
            let x = N_VNew_Serial(states, context);
            let matrix = SUNDenseMatrix(states, states, context);
            Ok(Self {
                context,
                x,
                tolerances: N_VNew_Serial(states, context),
                matrix,
                solver: SUNLinSol_Dense(x, matrix, context),
                memory: CVodeCreate(CV_BDF, context),
            })
        }
    }
}

impl Drop for Allocated {
    fn drop(&mut self) {
        unsafe {
            CVodeFree(&mut self.memory);
            SUNLinSolFree(self.solver);
            SUNMatDestroy(self.matrix);
            N_VDestroy(self.tolerances);
            N_VDestroy(self.x);
            SUNContext_Free(&mut self.context);
        }
    }
}

pub fn bdf<P: Plain<N>, const N: usize>(tolerances: Tolerances) -> Outcome<End<N>> {
    let made = Allocated::new::<N>()?;
    let (memory, mut phase) = (made.memory, P::Phase::default());
    let data = from_mut(&mut phase);
    unsafe {
        *numbers(made.x) = P::INITIAL;
        *numbers(made.tolerances) = tolerances.of_components::<P, N>();
        checked("init", CVodeInit(memory, Some(field::<P, N>), 0.0, made.x))?;
        let code = CVodeSVtolerances(memory, tolerances.relative, made.tolerances);
        checked("tolerances", code)?;
        checked("data", CVodeSetUserData(memory, data.cast()))?;
        let (solver, matrix) = (made.solver, made.matrix);
        checked("solver", CVodeSetLinearSolver(memory, solver, matrix))?;
        checked("jacobian", CVodeSetJacFn(memory, Some(jacobian::<P, N>)))?;
        checked("steps", CVodeSetMaxNumSteps(memory, MOST_STEPS))?;
        if P::ROOTS > 0 {
            let count = P::ROOTS as c_int;
            checked("roots", CVodeRootInit(memory, count, Some(roots::<P, N>)))?;
        }
    }
    integrate::<P, N>(|phase, x, left| unsafe {
        *data = phase;
        *numbers(made.x) = x;
        checked("init", CVodeReInit(memory, 0.0, made.x))?;
        let (mut t, mut steps) = (0.0, 0);
        let code = CVode(memory, left, made.x, &mut t, CV_NORMAL);
        let code = checked("a step", code)?;
        checked("steps", CVodeGetNumSteps(memory, &mut steps))?;
        Ok(Part {
            t,
            x: *numbers(made.x),
            steps: steps as u64,
            root: code == CV_ROOT_RETURN,
        })
    })
}
