//! How common tasks are done.
//!
//! All of them with one system, a ball that falls on a spring; every piece of code is run by the
//! tests. Times and states are in the units of the declaration, whatever those are.
//!
//! ```text
//! pws! {
//!     pub system Ball {
//!         state x, v;
//!         param k = 4;
//!         interface spring = x;
//!         region free where spring > 0 {
//!             der(x) = v; der(v) = -1;
//!             conserved energy = v^2/2 + x;
//!         }
//!         region pressed where spring < 0 {
//!             der(x) = v; der(v) = -1 - k*x;
//!             conserved energy = v^2/2 + x + k*x^2/2;
//!         }
//!     }
//! }
//! ```
//!
//! # The section of a trajectory
//!
//! A section (Poincaré section) is the set of points at which a trajectory crosses an interface in one
//! direction. The points are located to rounding, and cost no memory but their own. Where a section is
//! wanted and no interface is, declare one, with the same equations on both sides of it.
//!
//! ```
//! use dmm_runtime::{Best, Integrator, on_transition};
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! let mut section = Vec::new();
//! let mut crossing = on_transition(|transition| {
//!     if transition.to == BallRegion::Pressed {
//!         section.push((transition.t, transition.x[1]));
//!     }
//! });
//! Integrator::new(&Ball::default(), Best::tolerance(1e-12))
//!     .initial(0.0, [0.5, 0.0])
//!     .observe_until(1000.0, &mut crossing)?;
//! // it falls from x = 1/2 in unit time, each time with the same velocity
//! assert_eq!(section.len(), 248);
//! assert!((section[0].0 - 1.0).abs() < 1e-15);
//! assert!(section.iter().all(|(_, v)| (v + 1.0).abs() < 1e-12));
//! # Ok::<(), dmm_runtime::Error>(())
//! ```
//!
//! # An early stop, and progress
//!
//! An observer that returns `Break` ends a run, and the [`End`](crate::End) or the
//! [`Solution`](crate::Solution) says what [ended it](crate::EndedBy). Points are the ends of steps: where a run is
//! to end at a surface, declare an interface there and stop at the transition. Observers go together
//! as pairs; a run whose trajectory is kept takes them by
//! [`observer`](crate::InitialValueProblem::observer).
//!
//! ```
//! use std::ops::ControlFlow;
//! use dmm_runtime::{EndedBy, Integrator, Taylor, on_transition, progress};
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! let t_end = 100.0;
//! let mut told = Vec::new();
//! let progress = progress(t_end / 100.0, |point| told.push((100.0 * point.t / t_end).round()));
//! let mut bounces = 0;
//! let tenth = on_transition(|transition| {
//!     bounces += u32::from(transition.to == BallRegion::Pressed);
//!     if bounces == 10 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
//! });
//! let solution = Integrator::new(&Ball::default(), Taylor::tolerance(1e-12))
//!     .initial(0.0, [0.5, 0.0])
//!     .observer((progress, tenth))
//!     .run_until(t_end)?;
//! assert_eq!(solution.ended_by(), EndedBy::Observer);
//! assert_eq!(solution.transitions().len(), 19);
//! assert!(told.len() > 10 && told.is_sorted(), "{told:?}");
//! # Ok::<(), dmm_runtime::Error>(())
//! ```
//!
//! # Output times, the solution in between, CSV and data for a plot
//!
//! [`output_times`](crate::InitialValueProblem::output_times) are served by the scheme itself, without
//! changing its steps. [`Solution::at`](crate::Solution::at) gives the solution at any time that was
//! integrated (dense output), by a step of the scheme that ends there, so that it is on the level of
//! what is conserved. [`Solution::write_csv`](crate::Solution::write_csv) writes a table that every
//! plotting program reads; of a solution with exact flows, which take few steps, ask for output times
//! first.
//!
//! ```
//! use dmm_runtime::{Best, Integrator};
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! let times: Vec<f64> = (0..=200).map(|i| 0.05 * f64::from(i)).collect();
//! let solution = Integrator::new(&Ball::default(), Best::tolerance(1e-12))
//!     .initial(0.0, [0.5, 0.0])
//!     .output_times(times)
//!     .run_until(10.0)?;
//! // a curve for a plot
//! let curve: Vec<(f64, f64)> = solution.into_iter().map(|point| (point.t, point.x[0])).collect();
//! assert_eq!(curve.len(), 201);
//! assert_eq!(curve[10], (0.5, 0.375));
//! // dense output, also in between
//! let [x, v] = solution.at(0.625)?.into();
//! assert!((v * v / 2.0 + x - 0.5).abs() < 1e-15);
//! // a table
//! let mut csv = Vec::new();
//! solution.write_csv(&mut csv)?;
//! let csv = String::from_utf8(csv)?;
//! assert_eq!(csv.lines().take(2).collect::<Vec<_>>(), ["t,region,x,v", "0,free,0.5,0"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A sweep over parameters
//!
//! An [`Ensemble`](crate::Ensemble) integrates its members on all cores and keeps their order. What
//! halts one of them is its outcome, with the point that it reached, and no other member's.
//!
//! ```
//! use dmm_runtime::{Best, Ensemble, Member};
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! let stiffness: Vec<f64> = (1..=8).map(f64::from).collect();
//! let members = stiffness.iter().map(|&k| Member::new(Ball { k }, 0.0, [0.5, 0.0]));
//! let outcomes = Ensemble::new(Best::tolerance(1e-12)).collect_until(100.0, members);
//! let mut bounces = Vec::new();
//! for outcome in outcomes {
//!     bounces.push(outcome?.statistics.transitions / 2);
//! }
//! // the stiffer the spring, the sooner it throws the ball back
//! assert!(bounces.is_sorted() && bounces[0] < bounces[7], "{bounces:?}");
//! # Ok::<(), dmm_runtime::Error>(())
//! ```
//!
//! # A locator of one's own
//!
//! One-step methods take another [`Locator`](crate::Locator) of crossings in place of
//! [`NewtonLocator`](crate::NewtonLocator). It is given a bracket [lower, upper] of the time, steps of
//! the scheme from the start of the step, and g with the sign that makes it positive in the region that
//! is left; this one bisects.
//!
//! ```
//! use dmm_runtime::{Crossing, Dynamics, Integrator, Located, Locator, OneStep};
//! use dmm_runtime::{Statistics, Symmetric};
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! #[derive(Clone)]
//! struct Bisection;
//!
//! impl Locator for Bisection {
//!     fn locate<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
//!         &self,
//!         crossing: &Crossing<'_, Map, F, N>,
//!         statistics: &mut Statistics,
//!     ) -> Option<Located<N>> {
//!         let (mut lower, mut upper) = (crossing.lower, crossing.upper);
//!         for _ in 0..100 {
//!             let elapsed = 0.5 * (lower + upper);
//!             let increment = crossing.increment(elapsed, statistics).ok()?;
//!             let (g, _, _) = crossing.switching(elapsed, &increment);
//!             if g > 0.0 {
//!                 lower = elapsed;
//!             } else {
//!                 upper = elapsed;
//!             }
//!         }
//!         let increment = crossing.increment(upper, statistics).ok()?;
//!         Some(Located { elapsed: upper, increment })
//!     }
//! }
//!
//! let solution = Integrator::new(&Ball::default(), Symmetric::step_size(0.03).locator(Bisection))
//!     .initial(0.0, [0.5, 0.0])
//!     .run_until(10.0)?;
//! assert!((solution.transitions()[0].t - 1.0).abs() < 1e-14);
//! # Ok::<(), dmm_runtime::Error>(())
//! ```
//!
//! # Derivatives, and a shooting method
//!
//! The derivatives of a solution by its initial state and by the parameters are asked of the solution.
//! With them Newton's method finds what leads to a goal: here the height from which the ball is back
//! at its highest point after a given time.
//!
//! ```
//! use dmm_runtime::{Best, Integrator};
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! let t = 4.0;
//! let mut height = 0.7;
//! for _ in 0..8 {
//!     let solution = Integrator::new(&Ball::default(), Best::tolerance(1e-14))
//!         .initial(0.0, [height, 0.0])
//!         .run_until(t)?;
//!     let sensitivities = solution.sensitivities()?;
//!     let (Some(end), Some(derivative)) = (solution.last(), sensitivities.last()) else {
//!         break;
//!     };
//!     // v(t) = 0
//!     height -= end.x[1] / derivative.by_initial[(1, 0)];
//! }
//! // twice a fall, and half a period of the spring about x = −1/4
//! let bounce = |height: f64| {
//!     let speed = (2.0 * height).sqrt();
//!     2.0 * speed + (std::f64::consts::PI + 2.0 * (0.5 / speed).atan()) / 2.0
//! };
//! assert!((bounce(height) - t).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A transition has the derivatives of its time and of the states around it: the derivative of a return
//! map, whose eigenvalues are the multipliers of a periodic orbit. Where there is none, because an
//! interface is touched, several are met at once, or one is met at the end time itself, that is an
//! error with its reason.
//!
//! | wanted | ask for |
//! |---|---|
//! | derivatives of all that there is, by few numbers | [`Solution::sensitivities`](crate::Solution::sensitivities) |
//! | of few numbers, by many parameters | [`Solution::gradients`](crate::Solution::gradients) |
//! | second derivatives, for Newton's method on a minimum | [`Solution::second_sensitivities`](crate::Solution::second_sensitivities) |
//! | of the integral of l(t, x) | a state more, with `der(q) = l;` |
//!
//! # f, g and ψ at a point
//!
//! ```
//! use dmm_runtime::System;
//! # use dmm_runtime::pws;
//! # pws! {
//! #     pub system Ball {
//! #         state x, v;
//! #         param k = 4;
//! #         interface spring = x;
//! #         region free where spring > 0 {
//! #             der(x) = v; der(v) = -1;
//! #             conserved energy = v^2/2 + x;
//! #         }
//! #         region pressed where spring < 0 {
//! #             der(x) = v; der(v) = -1 - k*x;
//! #             conserved energy = v^2/2 + x + k*x^2/2;
//! #         }
//! #     }
//! # }
//! let ball = Ball::default();
//! let x = [-0.5, 2.0].into();
//! let region = BallRegion::Pressed;
//! let f: [f64; 2] = ball.vector_field(region, 0.0, &x).into();
//! assert_eq!(f, [2.0, 1.0]);
//! assert_eq!(ball.metadata().interfaces, ["spring"]);
//! assert_eq!(ball.switching_function(0, 0.0, &x), Some(-0.5));
//! assert_eq!(ball.conserved(region, 0.0, &x), [2.0]);
//! ```
//!
//! # And besides
//!
//! | to | see |
//! |---|---|
//! | integrate to an earlier time | [`Reversed`](crate::Reversed) |
//! | start again from a transition | [`InitialValueProblem::region`](crate::InitialValueProblem::region) |
//! | change parameters or the state on the way | [`Stepper`](crate::Stepper) |
//! | bound the memory of a long run | [`Recording::memory_limit`](crate::Recording::memory_limit) |
//! | return errors from `main` | [`Interrupted`](crate::Interrupted) |
