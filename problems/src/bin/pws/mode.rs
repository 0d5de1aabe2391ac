//! Modes in words and in colours: a region, its discrete states, and the sides of what formulas
//! switch at.
//!
//! The sides of other interfaces with events are part of a mode too. The field is the same on both,
//! and they are not shown.

use std::collections::{BTreeMap, BTreeSet};

use dmm_picture::{LIGHT_GREY, Look};
use dmm_problems::problem::{AnyMode, Problem};
use dmm_runtime::Side;

use crate::output;

/// The discrete states of a mode, as they are declared.
pub(crate) fn discrete(problem: &Problem, mode: &AnyMode) -> Vec<f64> {
    problem.metadata().declared_values(&mode.discrete)
}

/// The names of the discrete states, as they are declared.
pub(crate) fn discrete_names(problem: &Problem) -> Vec<&'static str> {
    let declared = problem.metadata().declared_discrete();
    declared.map(|(_, name)| name).collect()
}

/// A part of a mode in words.
struct Part {
    /// What has the value; nothing of the region, which is a name by itself.
    name: &'static str,
    /// Between name and value.
    relation: &'static str,
    value: String,
}

impl Part {
    fn text(&self) -> String {
        format!("{}{}{}", self.name, self.relation, self.value)
    }
}

/// The parts of a mode: as many and in the same order for all modes of a problem.
fn parts(problem: &Problem, mode: &AnyMode) -> Vec<Part> {
    let metadata = problem.metadata();
    let region = metadata.regions.get(mode.region).map(|region| Part {
        name: "",
        relation: "",
        value: region.name.to_owned(),
    });
    let names = discrete_names(problem).into_iter();
    let discrete = names
        .zip(discrete(problem, mode))
        .map(|(name, value)| Part {
            name,
            relation: " = ",
            value: output::short(value),
        });
    let free = metadata.free.iter().zip(&mode.sides);
    let switches = free.filter(|(interface, _)| metadata.switches.contains(interface));
    let switches = switches.map(|(&interface, side)| Part {
        name: metadata.interfaces.get(interface).copied().unwrap_or(""),
        relation: " ",
        value: match side {
            Some(Side::Positive) => "> 0".to_owned(),
            Some(Side::Negative) => "< 0".to_owned(),
            // it slides there
            None => "= 0".to_owned(),
        },
    });
    region.into_iter().chain(discrete).chain(switches).collect()
}

/// What differs between two modes: `above → below, n 1 → 2`.
pub(crate) fn change(problem: &Problem, from: &AnyMode, to: &AnyMode) -> String {
    let pairs = parts(problem, from).into_iter().zip(parts(problem, to));
    let changed = pairs.filter(|(from, to)| from.value != to.value);
    let texts = changed.map(|(from, to)| {
        let space = if from.name.is_empty() { "" } else { " " };
        format!("{}{space}{} → {}", from.name, from.value, to.value)
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// So many modes have a colour of their own.
const MOST: usize = 6;
/// More modes of a run are not told apart.
const MOST_KEPT: usize = 2_000;

/// The modes of a run, by numbers, and what tells them apart in pictures.
pub(crate) struct Modes<'a> {
    problem: &'a Problem,
    /// By number: the region and the parts.
    modes: Vec<(usize, Vec<Part>)>,
    numbers: BTreeMap<Vec<String>, usize>,
    /// The last one that was asked for, with its number.
    last: Option<(AnyMode, usize)>,
}

/// Modes that look alike in a picture.
#[derive(Debug)]
pub(crate) struct Shown {
    /// Their numbers.
    pub(crate) numbers: Vec<usize>,
    /// Their entry in the legend, where there are others beside them.
    pub(crate) label: Option<String>,
    pub(crate) look: Look,
}

impl<'a> Modes<'a> {
    pub(crate) fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            modes: Vec::new(),
            numbers: BTreeMap::new(),
            last: None,
        }
    }

    /// The number of a mode; sides that are not shown make no mode of its own.
    pub(crate) fn number(&mut self, mode: &AnyMode) -> usize {
        if let Some((last, number)) = &self.last
            && last == mode
        {
            return *number;
        }
        let parts = parts(self.problem, mode);
        let key = parts.iter().map(|part| part.value.clone()).collect();
        let next = self.modes.len();
        let number = match self.numbers.get(&key) {
            Some(&number) => number,
            None if next < MOST_KEPT => {
                self.numbers.insert(key, next);
                self.modes.push((mode.region, parts));
                next
            }
            None => MOST_KEPT,
        };
        self.last = Some((mode.clone(), number));
        number
    }

    /// How the modes are drawn and named: by regions, and each region's in the order of the run.
    /// Those without a colour of their own are the last.
    pub(crate) fn shown(&self) -> Vec<Shown> {
        let places = self.places();
        let text = |number: usize| -> String {
            let parts = &self.modes[number].1;
            let texts = places.iter().map(|&place| parts[place].text());
            texts.collect::<Vec<_>>().join(", ")
        };
        let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
        for number in 0..self.modes.len() {
            let text = text(number);
            let known = groups.iter().position(|(known, _)| *known == text);
            // all of the others are one group
            let known = known.or_else(|| (groups.len() > MOST).then_some(MOST));
            match known {
                Some(known) => groups[known].1.push(number),
                None => groups.push((text, vec![number])),
            }
        }
        let mut others = groups.split_off(groups.len().min(MOST));
        groups.sort_by_key(|(_, numbers)| self.modes[numbers[0]].0);
        let metadata = self.problem.metadata();
        let by_region = !metadata.has_constants() && metadata.regions.len() <= MOST;
        let own = groups
            .into_iter()
            .enumerate()
            .map(|(place, (text, numbers))| {
                let look = Look::nth(if by_region {
                    self.modes[numbers[0]].0
                } else {
                    place
                });
                let label = (!text.is_empty()).then_some(text);
                Shown {
                    numbers,
                    label,
                    look,
                }
            });
        let others = others.pop().map(|(_, mut numbers)| {
            numbers.push(MOST_KEPT);
            Shown {
                numbers,
                label: Some("other modes".to_owned()),
                look: LIGHT_GREY.into(),
            }
        });
        own.chain(others).collect()
    }

    /// The places of the parts that tell the modes apart. Where there are more modes than colours,
    /// what has as many values by itself counts something, and is left out unless nothing else is
    /// left.
    fn places(&self) -> Vec<usize> {
        let count = self.modes.first().map_or(0, |(_, parts)| parts.len());
        let values = |place: usize| {
            let modes = self.modes.iter();
            let values = modes.map(|(_, parts)| &parts[place].value);
            values.collect::<BTreeSet<&String>>().len()
        };
        let differ: Vec<usize> = (0..count).filter(|&place| values(place) > 1).collect();
        let few = differ.iter().copied();
        let few: Vec<usize> = few
            .filter(|&place| place == 0 || values(place) <= MOST)
            .collect();
        match (self.modes.len() > MOST && !few.is_empty(), &differ[..]) {
            (true, _) => few,
            // the region, which comes first
            (false, []) if self.problem.regions().len() > 1 => vec![0],
            (false, _) => differ,
        }
    }
}

#[cfg(test)]
mod tests {
    use dmm_runtime::Model;

    use super::*;

    fn problem(declaration: &str) -> Problem {
        let model = Model::compile(declaration).expect("a right declaration");
        Problem::own(model).expect("a small system")
    }

    fn labels(modes: &Modes<'_>) -> Vec<String> {
        let shown = modes.shown().into_iter();
        shown.map(|shown| shown.label.unwrap_or_default()).collect()
    }

    #[test]
    fn modes_are_told_apart_by_what_differs() {
        let problem = problem(
            "system Walk { state x; discrete n = 0, motor = 1; interface wall = x - 1;
                der(x) = motor + abs(x);
                on wall rising { x = 0; n = n + 1; } }",
        );
        let mode = |n: f64, on: f64, side| AnyMode {
            region: 0,
            discrete: vec![n, on],
            sides: vec![Some(Side::Negative), Some(side)],
        };
        let free = problem.metadata().free;
        assert_eq!(free.len(), 2, "{free:?}");
        let mut modes = Modes::new(&problem);
        assert_eq!(modes.number(&mode(0.0, 1.0, Side::Positive)), 0);
        assert_eq!(labels(&modes), [""]);
        assert_eq!(modes.number(&mode(0.0, 1.0, Side::Negative)), 1);
        assert_eq!(modes.number(&mode(0.0, 1.0, Side::Positive)), 0);
        assert_eq!(labels(&modes), ["x > 0", "x < 0"]);
        assert_eq!(modes.number(&mode(1.0, 1.0, Side::Positive)), 2);
        assert_eq!(
            labels(&modes),
            ["n = 0, x > 0", "n = 0, x < 0", "n = 1, x > 0"]
        );
        // what counts is no mode of its own among many
        for n in 2..5000 {
            modes.number(&mode(f64::from(n), 1.0, Side::Positive));
        }
        assert_eq!(labels(&modes), ["x > 0", "x < 0"]);
        let of = |from, to| change(&problem, &from, &to);
        let (from, to) = (
            mode(1.0, 1.0, Side::Negative),
            mode(2.0, 1.0, Side::Positive),
        );
        assert_eq!(of(from.clone(), to), "n 1 → 2, x < 0 → > 0");
        assert_eq!(of(from.clone(), from), "");
    }

    #[test]
    fn modes_beyond_the_colours_have_one_together() {
        let problem = problem(
            "system Count { state x; discrete n = 0; interface wall = x - 1;
                der(x) = 1;
                on wall rising { x = 0; n = n + 1; } }",
        );
        let mut modes = Modes::new(&problem);
        for n in 0..5000 {
            modes.number(&AnyMode {
                discrete: vec![f64::from(n)],
                ..AnyMode::default()
            });
        }
        let shown = modes.shown();
        assert_eq!(shown.len(), MOST + 1);
        assert_eq!(shown[1].label.as_deref(), Some("n = 1"));
        assert_eq!(shown[MOST].label.as_deref(), Some("other modes"));
        let numbers: usize = shown.iter().map(|shown| shown.numbers.len()).sum();
        assert_eq!(numbers, MOST_KEPT + 1);
    }
}
