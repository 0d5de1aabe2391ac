//! An independent integrator of high order, for what the reference data do not list: states
//! between crossings, other parameters or initial values, smooth problems.
//!
//! Gragg's modified midpoint rule over a basic step H with n = 2, 4, …, 2K substeps,
//! extrapolated to n → ∞ (order 2K; Hairer, Nørsett & Wanner, *Solving Ordinary Differential
//! Equations I*, II.9). It shares nothing with the schemes under study but the formulas of f
//! and g.

use thiserror::Error;

use crate::problem::Problem;

/// K, the rows of the extrapolation table.
const ROWS: usize = 7;
/// Accepted difference of the last two extrapolated values, relative to the state.
const TOLERANCE: f64 = 4e-15;
/// The largest basic step: changes of side in between would not be seen.
const LARGEST_STEP: f64 = 1.0 / 8.0;
const SMALLEST_STEP: f64 = 1e-9;

/// Where an accurate solution could not be continued.
#[derive(Clone, PartialEq, Debug, Error)]
#[error("no accurate reference solution beyond t = {t}")]
pub struct Stuck {
    /// The time reached.
    pub t: f64,
}

/// A point of the accurate solution, with the region that it goes on in.
#[derive(Clone, PartialEq, Debug)]
pub struct Node {
    /// Time.
    pub t: f64,
    /// State.
    pub x: Vec<f64>,
    /// Index of the region.
    pub region: usize,
}

/// One basic step: the state at `t + step` and the error relative to the state.
///
/// What is summed and extrapolated is the difference to the state at the start: it is smaller
/// than the state, and so are its rounding errors, which the extrapolation enlarges.
fn basic_step(problem: &Problem, node: &Node, step: f64) -> (Vec<f64>, f64) {
    let add = |x: &[f64], y: &[f64], factor: f64| -> Vec<f64> {
        x.iter().zip(y).map(|(x, y)| x + factor * y).collect()
    };
    let field = |elapsed: f64, moved: &[f64]| {
        let x = add(&node.x, moved, 1.0);
        problem.vector_field(node.region, node.t + elapsed, &x)
    };
    let zero = vec![0.0; node.x.len()];
    let start = field(0.0, &zero);
    let mut table: Vec<Vec<f64>> = Vec::with_capacity(ROWS);
    let mut error = f64::INFINITY;
    for row in 1..=ROWS {
        let substeps = 2 * row;
        let h = step / substeps as f64;
        let mut before = zero.clone();
        let mut now = add(&zero, &start, h);
        for k in 1..substeps {
            let next = add(&before, &field(k as f64 * h, &now), 2.0 * h);
            before = std::mem::replace(&mut now, next);
        }
        let mut entry = now;
        // Aitken–Neville in h²; table[j] holds the previous row's column j
        for (column, previous) in table.iter_mut().enumerate() {
            let ratio = (row as f64 / (row - 1 - column) as f64).powi(2) - 1.0;
            let difference = add(&entry, previous, -1.0);
            let next = add(&entry, &difference, 1.0 / ratio);
            error = largest(&difference) / (ratio * largest(&node.x));
            *previous = std::mem::replace(&mut entry, next);
        }
        table.push(entry);
    }
    let moved = table.pop().unwrap_or_default();
    (add(&node.x, &moved, 1.0), error)
}

/// The largest modulus, NaN if there is one.
fn largest(x: &[f64]) -> f64 {
    x.iter()
        .fold(f64::MIN_POSITIVE, |largest, x| match x.abs() {
            size if size > largest || size.is_nan() => size,
            _ => largest,
        })
}

/// An accepted step towards `t_end`, and the size to try next.
fn accepted_step(
    problem: &Problem,
    node: &Node,
    t_end: f64,
    mut step: f64,
) -> Result<(Node, f64), Stuck> {
    loop {
        let last = node.t + step >= t_end;
        let taken = if last { t_end - node.t } else { step };
        let (x, error) = basic_step(problem, node, taken);
        if error <= TOLERANCE {
            let grown = if error < 0.1 * TOLERANCE {
                1.5 * step
            } else {
                step
            };
            let t = if last { t_end } else { node.t + taken };
            let region = node.region;
            return Ok((Node { t, x, region }, grown.min(LARGEST_STEP)));
        }
        step = 0.5 * taken;
        if step < SMALLEST_STEP {
            return Err(Stuck { t: node.t });
        }
    }
}

/// The state at time `t` after `node`, in the node's region.
///
/// # Errors
/// [`Stuck`] if the steps become too small.
pub fn state_at(problem: &Problem, node: &Node, t: f64) -> Result<Vec<f64>, Stuck> {
    let (mut node, mut step) = (node.clone(), LARGEST_STEP);
    while node.t < t {
        (node, step) = accepted_step(problem, &node, t, step)?;
    }
    Ok(node.x)
}

/// The start and the crossings of the first interface, at most `count`, up to `t_end`.
///
/// # Errors
/// [`Stuck`] if the steps become too small.
pub fn crossings(
    problem: &Problem,
    initial: &[f64],
    t_end: f64,
    count: usize,
) -> Result<Vec<Node>, Stuck> {
    let side_of = |t: f64, x: &[f64]| problem.switching_function(0, t, x).signum();
    let has_interface = !problem.interfaces().is_empty();
    let region = if has_interface {
        problem.region_on_side(side_of(0.0, initial))
    } else {
        Some(0)
    };
    let region = region.ok_or(Stuck { t: 0.0 })?;
    let mut node = Node {
        t: 0.0,
        x: initial.to_vec(),
        region,
    };
    let mut nodes = vec![node.clone()];
    if !has_interface {
        return Ok(nodes);
    }
    let mut side = side_of(0.0, initial);
    let mut step = LARGEST_STEP;
    while node.t < t_end && nodes.len() - 1 < count {
        let (next, proposed) = accepted_step(problem, &node, t_end, step)?;
        step = proposed;
        if side_of(next.t, &next.x) == side {
            node = next;
            continue;
        }
        let (t, x) = root(problem, &node, next.t, side);
        let region = problem.region_on_side(-side).ok_or(Stuck { t })?;
        node = Node { t, x, region };
        side = -side;
        nodes.push(node.clone());
    }
    Ok(nodes)
}

/// The first point with g of the other sign, by Illinois' regula falsi on the step from `node`.
fn root(problem: &Problem, node: &Node, upper: f64, side: f64) -> (f64, Vec<f64>) {
    let at = |t: f64| {
        let (x, _) = basic_step(problem, node, t - node.t);
        (side * problem.switching_function(0, t, &x), x)
    };
    let (mut lower, mut upper) = (node.t, upper);
    let mut g_lower = side * problem.switching_function(0, node.t, &node.x);
    let (mut g_upper, mut x) = at(upper);
    for iteration in 0..100 {
        let secant = lower + (upper - lower) * g_lower / (g_lower - g_upper);
        let inside = secant > lower && secant < upper;
        let middle = if inside && iteration % 3 != 2 {
            secant
        } else {
            0.5 * (lower + upper)
        };
        if middle <= lower || middle >= upper {
            break;
        }
        let (g, at_middle) = at(middle);
        if g > 0.0 {
            (lower, g_lower) = (middle, g);
            g_upper *= 0.5;
        } else {
            (upper, g_upper, x) = (middle, g, at_middle);
            g_lower *= 0.5;
            if g == 0.0 {
                break;
            }
        }
    }
    (upper, x)
}
