//! Axes: their scales, ranges and ticks.

use std::sync::Arc;

use kuva::prelude::TickFormat;

/// How an axis maps its values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scale {
    /// As they are.
    Linear,
    /// By their logarithm to base 10.
    Decades,
    /// By their logarithm to base 2.
    Octaves,
}

impl Scale {
    pub(super) fn map(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Decades => value.log10(),
            Self::Octaves => value.log2(),
        }
    }

    pub(super) fn tick_format(self) -> TickFormat {
        let base = match self {
            Self::Linear => return TickFormat::Auto,
            Self::Decades => "10",
            Self::Octaves => "2",
        };
        TickFormat::Custom(Arc::new(move |exponent: f64| {
            format!("{base}{}", superscript(exponent.round() as i64))
        }))
    }
}

/// An integer as raised digits.
pub fn superscript(exponent: i64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if exponent < 0 { "⁻" } else { "" };
    let digits = exponent.unsigned_abs().to_string();
    let raised = digits
        .bytes()
        .map(|digit| DIGITS[usize::from(digit - b'0')]);
    sign.chars().chain(raised).collect()
}

/// An axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    /// What it shows.
    pub label: String,
    /// How.
    pub scale: Scale,
}

impl Axis {
    /// An axis.
    pub fn new(label: impl Into<String>, scale: Scale) -> Self {
        Self {
            label: label.into(),
            scale,
        }
    }
}

/// The range of an axis: the values with a margin, about whole decades for a logarithm.
pub(super) fn range(values: impl Iterator<Item = f64>, scale: Scale) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if !(low.is_finite() && high.is_finite()) {
        return (0.0, 1.0);
    }
    match scale {
        Scale::Linear if high > low => {
            let margin = 0.05 * (high - low);
            (low - margin, high + margin)
        }
        Scale::Linear => (low - 1.0, high + 1.0),
        Scale::Decades => {
            let (below, above) = (low.floor(), high.ceil().max(low.floor() + 1.0));
            // room for the marks of points on the first and the last decade
            let margin = |distance: f64| if distance < 0.1 { 0.2 } else { 0.0 };
            (below - margin(low - below), above + margin(above - high))
        }
        Scale::Octaves => (low - 0.5, high + 0.5),
    }
}

/// The distance of ticks: 1, 2 or 5 times a power of ten, whole for a logarithm.
pub(super) fn tick_step((low, high): (f64, f64), scale: Scale) -> f64 {
    let raw = (high - low) / 6.0;
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= raw)
        .unwrap_or(raw);
    match scale {
        Scale::Linear => step,
        Scale::Decades | Scale::Octaves => step.max(1.0).ceil(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_raised() {
        assert_eq!(superscript(-10), "⁻¹⁰");
        assert_eq!(superscript(3), "³");
    }

    #[test]
    fn points_are_inside_of_the_range() {
        let decades = |values: [f64; 2]| range(values.into_iter(), Scale::Decades);
        assert_eq!(decades([-3.5, -1.5]), (-4.0, -1.0));
        assert_eq!(decades([-3.0, -1.0]), (-3.2, -0.8));
        assert_eq!(decades([-3.0, -3.0]), (-3.2, -2.0));
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(tick_step((0.0, 100.0), Scale::Linear), 20.0);
        assert_eq!(tick_step((-0.7, 0.9), Scale::Linear), 0.5);
        assert_eq!(tick_step((-3.0, -1.0), Scale::Decades), 1.0);
        assert_eq!(tick_step((-16.0, 0.0), Scale::Decades), 5.0);
    }
}
