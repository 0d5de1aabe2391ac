//! What a reader of emitted code would call a value.

use crate::algebra::{Id, Math, Name, Rational};
use crate::program::Lowered;

/// What a reader would call a node: `x_sum` for x₀ + x₁, `x_mean` for half of it, `sin_x` …
pub(super) fn suggestion(lowered: &Lowered, id: Id) -> Option<String> {
    let dag = lowered.dag();
    match &dag[id] {
        Math::Add([a, b]) => two_ends(lowered, *a, *b).map(|stem| format!("{stem}_sum")),
        Math::Sub([a, b]) => two_ends(lowered, *a, *b).map(|stem| format!("{stem}_step")),
        Math::Mul([a, b]) if a == b => Some(format!("{}_2", operand(lowered, *a)?)),
        Math::Mul([a, b]) if dag.as_constant(*a).is_some_and(is_half) => {
            let inner = operand(lowered, *b)?;
            Some(match inner.strip_suffix("_sum") {
                Some(stem) => format!("{stem}_mean"),
                None => format!("half_{inner}"),
            })
        }
        Math::Call(function, a) => Some(match operand(lowered, *a) {
            Some(inner) => format!("{function}_{inner}"),
            None => format!("{function}_u"),
        }),
        _ => None,
    }
}

fn is_half(value: &Rational) -> bool {
    *value == Rational::new(1.into(), 2.into())
}

/// A short name of an operand, if it has one.
fn operand(lowered: &Lowered, id: Id) -> Option<String> {
    match &lowered.dag()[id] {
        Math::Variable(name) => Some(plain(name)),
        _ => suggestion(lowered, id).filter(|name| name.len() <= 14),
    }
}

/// The variable whose values at the two ends are `a` and `b`.
fn two_ends(lowered: &Lowered, a: Id, b: Id) -> Option<String> {
    let dag = lowered.dag();
    let (Math::Variable(a), Math::Variable(b)) = (&dag[a], &dag[b]) else {
        return None;
    };
    let stem = a.as_str().strip_suffix(['₀', '₁'])?;
    let is_same = b.as_str().strip_suffix(['₀', '₁'])? == stem && a != b;
    is_same.then(|| plain(&Name::new(stem)))
}

/// A variable's name as an identifier: `x₀` is `x0`, `q[1]₀` is `q1_0`, `λ⟨1⟩` is `lambda1`.
pub(super) fn plain(name: &Name) -> String {
    name.as_str()
        .replace("λ⟨", "lambda⟨")
        // the start of `q[1]` is not to look like `q[10]`
        .replace("]₀", "_0")
        .replace("]₁", "_1")
        .chars()
        .filter_map(|letter| match letter {
            '₀' => Some('0'),
            '₁' => Some('1'),
            ' ' => Some('_'),
            '[' | ']' | '⟨' | '⟩' => None,
            letter => Some(letter),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_have_readable_names() {
        let names = ["x₀", "q[1]₀", "q[1]₁", "q[10]", "m[0]", "λ⟨1⟩"];
        let plain: Vec<String> = names.iter().map(|name| plain(&Name::new(name))).collect();
        assert_eq!(plain, ["x0", "q1_0", "q1_1", "q10", "m0", "lambda1"]);
    }
}
