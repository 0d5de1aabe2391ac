//! Food chain of three species, the middle one harvested while its prey abounds.
//!
//! ẋ = x(a − b y), ẏ = y(−c + d x − e z), ż = z(−f + γ y): prey, predators, and predators of
//! the predators. With a γ = b f, which is how f is declared here, the chain has two
//! invariants,
//!
//! γ ln x + b ln z and d x − c ln x + (e b/γ) z + b y − a ln y.
//!
//! Where the prey passes a threshold, harvest of the middle species begins: c becomes c + h.
//! The first invariant is the same on both sides, the second is not. At the threshold
//! ẋ = x(a − b y) is continuous, so that nothing slides.
//!
//! Source: E. Chauvet, J. E. Paullet, J. P. Previte, Z. Walls, *A Lotka–Volterra three-species
//! food chain*, Math. Magazine 75 (2002); threshold harvest: M. I. S. Costa, E. Kaszkurewicz,
//! A. Bhaya, L. Hsu, Ecol. Modelling 128 (2000).

use crate::problem::Description;

pws! {
    /// Food chain of three species, the middle one harvested while its prey abounds.
    pub system FoodChain {
        /// Prey.
        state x;
        /// Predators.
        state y;
        /// Their predators.
        state z;
        param a = 1, b = 1, c = 1, d = 1, e = 1, gamma = 1;
        /// Rate of the harvest, and the threshold of the prey.
        param harvest = 1/4, threshold = 3/2;
        let f = a * gamma / b;
        let shared = d * x + e * b / gamma * z + b * y - a * ln(y);
        interface prey = x - threshold;
        conserved surface = gamma * ln(x) + b * ln(z);
        region spared where prey < 0 {
            der(x) = x * (a - b * y);
            der(y) = y * (-c + d * x - e * z);
            der(z) = z * (-f + gamma * y);
            conserved volterra = shared - c * ln(x);
        }
        region harvested where prey > 0 {
            der(x) = x * (a - b * y);
            der(y) = y * (-(c + harvest) + d * x - e * z);
            der(z) = z * (-f + gamma * y);
            conserved volterra = shared - (c + harvest) * ln(x);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "food_chain",
    title: "food chain of three species with a harvest that begins at x = 3/2",
    source: "Chauvet, Paullet, Previte & Walls, Math. Magazine 75 (2002); Costa, Kaszkurewicz, \
             Bhaya & Hsu, Ecol. Modelling 128 (2000)",
    initial: &[1.0, 0.5, 1.25],
    t_end: 100.0,
    step_size: 1e-3,
    longest: None,
    reference: None,
};
