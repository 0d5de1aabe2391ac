//! The discrete multipliers that must come out, and how they read.

use super::formula::formula;
use crate::algebra::{Dag, Name, at_midpoint, divided_difference, to_text};

fn coefficients(psi: &str, variables: &[&str]) -> Vec<String> {
    let mut dag = Dag::new();
    let psi = formula(&mut dag, psi);
    let variables: Vec<Name> = variables.iter().map(|name| Name::new(name)).collect();
    divided_difference(&mut dag, psi, &variables)
        .into_iter()
        .map(|coefficient| to_text(&dag, coefficient))
        .collect()
}

#[test]
fn harmonic_oscillator() {
    assert_eq!(
        coefficients("(y^2 + k*x^2)/2", &["x", "y"]),
        ["k*(x₁ + x₀)/2", "(y₁ + y₀)/2"]
    );
}

#[test]
fn elliptic_curve() {
    assert_eq!(
        coefficients("y^2 - x^3 - a*x", &["x", "y"]),
        ["-(x₁^2 + x₁*x₀ + x₀^2 + a)", "y₁ + y₀"]
    );
}

#[test]
fn pendulum() {
    assert_eq!(
        coefficients("y^2/2 - g*cos(x)", &["x", "y"]),
        ["g*sin((x₁ + x₀)/2)*sinc((x₁ - x₀)/2)", "(y₁ + y₀)/2"]
    );
}

#[test]
fn lotka_volterra() {
    assert_eq!(
        coefficients("d*x - c*ln(x)", &["x"]),
        ["d - c*ln_dd(x₀, x₁)"]
    );
}

#[test]
fn kepler() {
    assert_eq!(
        coefficients("-m/sqrt(x^2 + y^2)", &["x"]),
        ["m*(x₁ + x₀)/(sqrt(x₁^2 + y^2)*sqrt(x₀^2 + y^2)*(sqrt(x₁^2 + y^2) + sqrt(x₀^2 + y^2)))"]
    );
}

#[test]
fn time_is_a_variable_like_any_other() {
    assert_eq!(
        coefficients("x*exp(g*t)", &["x", "t"]),
        [
            "(exp(g*t₁) + exp(g*t₀))/2",
            "(x₁ + x₀)*exp(g*(t₁ + t₀)/2)*sinhc((t₁ - t₀)*g/2)*g/2",
        ]
    );
}

#[test]
fn what_does_not_vary_has_no_coefficient() {
    assert_eq!(coefficients("k*y + sin(k)", &["x", "y"]), ["0", "k"]);
}

#[test]
fn midpoint() {
    let mut dag = Dag::new();
    let root = formula(&mut dag, "k*x^2");
    let midpoint = at_midpoint(&mut dag, root, &[Name::new("x")]);
    assert_eq!(to_text(&dag, midpoint), "k*((x₁ + x₀)/2)^2");
}
