//! The motion in a mode: its field, with the weights of the mean while it slides, and what its end
//! is told by.

use crate::plant::{MOST, Plant, Role, State, slopes, value};

/// What a mode does at an interface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Choice {
    Above,
    Below,
    Slides,
}

impl Choice {
    pub(crate) fn of(g: f64) -> Self {
        if g > 0.0 { Self::Above } else { Self::Below }
    }

    /// 1 or −1
    pub(crate) fn sign(self) -> f64 {
        if self == Self::Above { 1.0 } else { -1.0 }
    }
}

/// A choice for each interface, and the discrete state.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Mode {
    pub(crate) choices: Vec<Choice>,
    pub(crate) u: f64,
}

/// A system with its coefficients.
#[derive(Clone, Copy)]
pub(crate) struct Systems<'a> {
    pub(crate) plant: &'a Plant,
    pub(crate) c: &'a [f64],
}

/// What the field of a mode is made of.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Motion {
    pub(crate) mode: Mode,
    /// The regions around it.
    pub(crate) regions: Vec<usize>,
    /// The switches that it slides on.
    switches: Vec<usize>,
    /// All interfaces that it slides on.
    pub(crate) slid: Vec<usize>,
    /// The other interfaces that bound it.
    pub(crate) bounds: Vec<usize>,
}

/// What is positive in a mode.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Guard {
    /// g on its side.
    Interface(usize),
    /// A weight of the mean.
    Weight(usize),
}

/// The most weights, and the equation of their sum.
const SIZE: usize = 8;

impl<'a> Systems<'a> {
    pub(crate) fn g(&self, interface: usize, t: f64, x: &State) -> f64 {
        let g = &self.plant.interfaces[interface].g;
        value(g, self.c, t, x, 1.0)
    }

    pub(crate) fn slopes(&self, interface: usize, t: f64, x: &State) -> (State, f64) {
        slopes(&self.plant.interfaces[interface].g, self.c, t, x)
    }

    /// The motion in a mode; nothing where it slides on what does not bound regions, or four regions
    /// meet that have no one mean.
    pub(crate) fn motion(&self, mode: Mode) -> Option<Motion> {
        let interfaces = &self.plant.interfaces;
        let role = |role: Role| (0..interfaces.len()).filter(move |&k| interfaces[k].role == role);
        let slides = |k: &usize| mode.choices[*k] == Choice::Slides;
        let borders: Vec<usize> = role(Role::Border).filter(slides).collect();
        let switches: Vec<usize> = role(Role::Switch).filter(slides).collect();
        let regions = self.regions(&mode.choices);
        if regions.len() != borders.len() + 1 {
            return None;
        }
        for &border in &borders {
            let mut side = mode.choices.clone();
            side[border] = Choice::Above;
            if self.regions(&side).len() == regions.len() {
                return None;
            }
        }
        let bounds = |&k: &usize| {
            if slides(&k) {
                return false;
            }
            interfaces[k].role != Role::Border || {
                let mut other = mode.choices.clone();
                other[k] = match other[k] {
                    Choice::Above => Choice::Below,
                    _ => Choice::Above,
                };
                self.regions(&other) != regions
            }
        };
        Some(Motion {
            bounds: (0..interfaces.len()).filter(bounds).collect(),
            slid: (0..interfaces.len()).filter(slides).collect(),
            switches,
            regions,
            mode,
        })
    }

    /// The regions that choices leave.
    fn regions(&self, choices: &[Choice]) -> Vec<usize> {
        let fits = |&region: &usize| {
            let pattern = &self.plant.regions[region].pattern;
            let mut sides = pattern.iter().zip(choices);
            sides.all(|(side, choice)| match (side, choice) {
                (None, _) | (_, Choice::Slides) => true,
                (Some(above), choice) => *above == (*choice == Choice::Above),
            })
        };
        (0..self.plant.regions.len()).filter(fits).collect()
    }

    /// The field of a region without the switches that slide.
    fn base(&self, motion: &Motion, region: usize, t: f64, x: &State) -> State {
        let mut f = [0.0; MOST];
        let u = motion.mode.u;
        let field = &self.plant.regions[region].field;
        for (part, sum) in f.iter_mut().zip(field) {
            *part = value(sum, self.c, t, x, u);
        }
        for (k, choice) in motion.mode.choices.iter().enumerate() {
            if *choice == Choice::Slides {
                continue;
            }
            for (part, sum) in f.iter_mut().zip(&self.plant.interfaces[k].switched) {
                *part += choice.sign() * value(sum, self.c, t, x, u);
            }
        }
        f
    }

    fn switched(&self, motion: &Motion, interface: usize, t: f64, x: &State) -> State {
        let mut f = [0.0; MOST];
        for (part, sum) in f.iter_mut().zip(&self.plant.interfaces[interface].switched) {
            *part = value(sum, self.c, t, x, motion.mode.u);
        }
        f
    }

    /// The field, and the weights if it slides: Σ θᵣ = 1 and ∂ₜg + ∇g·(Σ θᵣ fᵣ + Σ wₖ Fₖ) = 0 for every
    /// interface that it slides on. Not a number where they have no solution.
    pub(crate) fn field(&self, motion: &Motion, t: f64, x: &State) -> (State, [f64; SIZE]) {
        let regions = motion.regions.len();
        if motion.slid.is_empty() {
            return (self.base(motion, motion.regions[0], t, x), [1.0; SIZE]);
        }
        let mut columns = [[0.0; MOST]; SIZE];
        for (column, &region) in columns.iter_mut().zip(&motion.regions) {
            *column = self.base(motion, region, t, x);
        }
        for (column, &switch) in columns[regions..].iter_mut().zip(&motion.switches) {
            *column = self.switched(motion, switch, t, x);
        }
        let count = regions + motion.switches.len();
        let mut matrix = [[0.0; SIZE + 1]; SIZE];
        matrix[0][..regions].fill(1.0);
        matrix[0][count] = 1.0;
        for (row, &interface) in matrix[1..].iter_mut().zip(&motion.slid) {
            let (gradient, by_time) = self.slopes(interface, t, x);
            for k in 0..count {
                row[k] = dot(&gradient, &columns[k]);
            }
            row[count] = -by_time;
        }
        let weights = solve(&mut matrix, count);
        let mut f = [0.0; MOST];
        for (weight, column) in weights.iter().zip(&columns[..count]) {
            for (part, entry) in f.iter_mut().zip(column) {
                *part += weight * entry;
            }
        }
        (f, weights)
    }

    /// Whether it slides where the fields lead away: what the weight of an interface adds to its dg/dt
    /// has the sign of the side it stands for.
    pub(crate) fn is_repelling(&self, motion: &Motion, t: f64, x: &State) -> bool {
        let repels = |&k: &usize| {
            let rates = [Choice::Below, Choice::Above].map(|side| {
                let mut mode = motion.mode.clone();
                mode.choices[k] = side;
                let f = self.motion(mode).map(|motion| self.field(&motion, t, x).0);
                f.map(|f| self.rate(k, t, x, &f))
            });
            matches!(rates, [Some(below), Some(above)] if below < 0.0 && above > 0.0)
        };
        motion.slid.iter().any(repels)
    }

    /// The largest change of a weight between two points; infinite where there are none.
    pub(crate) fn change(
        &self,
        motion: &Motion,
        (t, x): (f64, &State),
        (later, after): (f64, &State),
    ) -> f64 {
        if motion.slid.is_empty() {
            return 0.0;
        }
        let weights = self.field(motion, t, x).1;
        let others = self.field(motion, later, after).1;
        let changes = weights.iter().zip(&others).map(|(a, b)| (a - b).abs());
        changes.fold(0.0, |most, change| {
            if change.is_nan() {
                f64::INFINITY
            } else {
                most.max(change)
            }
        })
    }

    /// dg/dt under a field.
    pub(crate) fn rate(&self, interface: usize, t: f64, x: &State, f: &State) -> f64 {
        let (gradient, by_time) = self.slopes(interface, t, x);
        by_time + dot(&gradient, f)
    }

    /// The value of a guard; that of a weight by the weights.
    pub(crate) fn guard(
        &self,
        motion: &Motion,
        guard: Guard,
        (t, x): (f64, &State),
        weights: &[f64; SIZE],
    ) -> f64 {
        match guard {
            Guard::Interface(k) => motion.mode.choices[k].sign() * self.g(k, t, x),
            Guard::Weight(k) if k < motion.regions.len() => weights[k],
            // −1 < w < 1
            Guard::Weight(k) => 1.0 - weights[k].abs(),
        }
    }

    /// Puts a state back on the interfaces that it slides on.
    pub(crate) fn project(&self, motion: &Motion, t: f64, x: &mut State) {
        let count = motion.slid.len();
        for _ in 0..if count > 0 { 2 } else { 0 } {
            let mut gradients = [[0.0; MOST]; SIZE];
            let mut matrix = [[0.0; SIZE + 1]; SIZE];
            for (gradient, &k) in gradients.iter_mut().zip(&motion.slid) {
                *gradient = self.slopes(k, t, x).0;
            }
            for (row, &k) in motion.slid.iter().enumerate() {
                for column in 0..count {
                    matrix[row][column] = dot(&gradients[row], &gradients[column]);
                }
                matrix[row][count] = -self.g(k, t, x);
            }
            let factors = solve(&mut matrix, count);
            for (factor, gradient) in factors.iter().zip(&gradients[..count]) {
                for (part, entry) in x.iter_mut().zip(gradient) {
                    *part += factor * entry;
                }
            }
        }
    }
}

impl Motion {
    /// What is positive in it.
    pub(crate) fn guards(&self) -> Vec<Guard> {
        let sides = self.bounds.iter().map(|&k| Guard::Interface(k));
        let first = if self.regions.len() > 1 {
            0
        } else {
            self.regions.len()
        };
        let weights = first..self.regions.len() + self.switches.len();
        sides.chain(weights.map(Guard::Weight)).collect()
    }
}

fn dot(a: &State, b: &State) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Gauss elimination with the right side in column `count`.
fn solve(matrix: &mut [[f64; SIZE + 1]; SIZE], count: usize) -> [f64; SIZE] {
    let mut solution = [0.0; SIZE];
    for k in 0..count {
        let size = |row: &usize| matrix[*row][k].abs();
        let pivot = (k..count).max_by(|a, b| size(a).total_cmp(&size(b)));
        let pivot = pivot.unwrap_or(k);
        if size(&pivot) < 1e-9 {
            return [f64::NAN; SIZE];
        }
        matrix.swap(k, pivot);
        for row in k + 1..count {
            let factor = matrix[row][k] / matrix[k][k];
            let known = matrix[k];
            for (entry, known) in matrix[row].iter_mut().zip(known).take(count + 1) {
                *entry -= factor * known;
            }
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|j| matrix[k][j] * solution[j]).sum();
        solution[k] = (matrix[k][count] - known) / matrix[k][k];
    }
    solution
}
