//! What became of a run, beside the reference solution.
//!
//! A scheme has errors. Where the solution comes nearer to an interface, or to leaving one, than
//! the error that a run has had until then, the run may rightly see another itinerary: such
//! differences are counted apart, with the margin of the contact. All others are wrong.

use dmm_runtime::ErrorKind;

use crate::reference::{Contact, Crossing, Ending, Growth, Problem, Reference, distance};
use crate::schemes::{End, Run, Setting};
use dmm_problems::stress::kind_of;

/// How often the measured error a margin has to be for the itinerary to be certain: errors grow
/// between the last point before a contact and the contact.
const FACTOR: f64 = 100.0;

/// What became of a run.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Class {
    /// The same itinerary, times and states within the scheme's accuracy.
    Same,
    /// Another itinerary after a contact of this margin.
    Near(f64),
    /// Stopped by an error of this kind at a contact.
    RefusedNear(&'static str),
    /// Stopped by an error of this kind, away from any contact.
    Refused(&'static str, String),
    /// Another itinerary, other times or another state, and nothing was said.
    Silent(String),
}

/// What runs are compared with.
pub(super) struct Truth<'a> {
    pub(super) problem: &'a Problem,
    pub(super) reference: &'a Reference,
    pub(super) growth: &'a Growth,
    /// Where runs end.
    pub(super) t_end: f64,
}

impl Truth<'_> {
    /// The class of a run that was observed.
    pub(super) fn judge(&self, setting: &Setting, run: &Run) -> Class {
        let [least, most] = setting.errors;
        // the error until now: never less than the setting's, never more than it may have
        let mut error = least;
        let mut points = run.points.iter().peekable();
        let crossings = &self.reference.crossings;
        let stopped_at = match &run.error {
            Some(error) => error.place().map_or(0.0, |place| place.t),
            None => f64::INFINITY,
        };
        for k in 0.. {
            let told = run.crossings.get(k);
            let truth = crossings.get(k);
            let times = [told.map(|told| told.t), truth.map(|truth| truth.t)];
            let until = times.into_iter().flatten().fold(self.t_end, f64::min);
            while let Some((t, x)) = points.next_if(|(t, _)| *t <= until) {
                let measured = distance(x, &self.reference.state(*t), self.problem.size);
                let allowed = most * self.growth.until(*t);
                if measured > allowed || measured.is_nan() {
                    return match self.nearest(*t, FACTOR * error) {
                        Some(margin) => Class::Near(margin),
                        None => Class::Silent(format!(
                            "the state is off by {measured:.1e} at t = {t}, before crossing {k}"
                        )),
                    };
                }
                error = error.max(measured.min(allowed));
            }
            let slack = |crossing: &Crossing| self.slack(crossing, error);
            let is_sliding =
                |k: usize| self.reference.ending == Ending::Sliding && k + 1 == crossings.len();
            match (told, truth) {
                (None, Some(truth)) if truth.t > self.t_end - slack(truth) => break,
                (None, Some(truth)) if stopped_at <= truth.t + slack(truth) => break,
                (None, None) => break,
                (Some(told), Some(truth)) => {
                    let is_same = told.interface == truth.interface
                        && told.to_positive == (truth.regions[1] >> truth.interface & 1 == 1)
                        && (told.t - truth.t).abs() <= slack(truth)
                        && !is_sliding(k);
                    if is_same {
                        continue;
                    }
                }
                (Some(_), None) | (None, Some(_)) => {}
            }
            let found = match (told, truth) {
                (Some(told), Some(truth)) if is_sliding(k) => {
                    format!("it crosses at t = {} and slides at {}", told.t, truth.t)
                }
                (Some(told), Some(truth)) => {
                    format!("crossing {k} at t = {} and not {}", told.t, truth.t)
                }
                (Some(told), None) => format!("crossing {k} at t = {} is none", told.t),
                (None, truth) => {
                    let t = truth.map_or(f64::NAN, |truth| truth.t);
                    format!("crossing {k} at t = {t} is missed")
                }
            };
            return match self.nearest(until, FACTOR * error) {
                Some(margin) => Class::Near(margin),
                None => Class::Silent(format!(
                    "{found}; error until then {error:.0e}, nearest contact {:.0e}",
                    self.margin(until)
                )),
            };
        }
        let Some(stopped) = &run.error else {
            return Class::Same;
        };
        let t = stopped.place().map_or(self.t_end, |place| place.t);
        let kind = kind_of(stopped);
        match (self.reference.ending, &stopped.kind) {
            (Ending::Sliding, ErrorKind::Sliding { .. } | ErrorKind::Tangential { .. })
                if run.crossings.len() + 1 == crossings.len() =>
            {
                Class::Same
            }
            _ => match self.nearest(t, FACTOR * error) {
                Some(_) => Class::RefusedNear(kind),
                None => Class::Refused(kind, format!("at t = {t}")),
            },
        }
    }

    /// The class of a run of which only the end is known.
    pub(super) fn judge_end(&self, setting: &Setting, end: &End) -> Class {
        let [least, most] = setting.errors;
        let growth = self.growth.until(self.t_end);
        let crossings = &self.reference.crossings;
        let certainly = |after: f64| {
            let slack = |crossing: &Crossing| self.slack(crossing, least * growth);
            let before = crossings
                .iter()
                .filter(|crossing| crossing.t < self.t_end + after * slack(crossing));
            before.count() as u64
        };
        let contacts = self.reference.contacts.iter();
        let margin = contacts
            .filter(|contact| contact.t <= self.t_end)
            .fold(f64::INFINITY, |least, contact| least.min(contact.margin));
        let is_near = margin <= FACTOR * least * growth;
        match end {
            Ok((x, count)) => {
                let error = distance(x, &self.reference.state(self.t_end), self.problem.size);
                let is_same =
                    (certainly(-1.0)..=certainly(1.0)).contains(count) && error <= most * growth;
                if is_same {
                    Class::Same
                } else if is_near {
                    Class::Near(margin)
                } else {
                    Class::Silent(format!(
                        "{count} crossings instead of {}, the state is off by {error:.1e}",
                        certainly(0.0)
                    ))
                }
            }
            Err(error) if is_near => Class::RefusedNear(kind_of(error)),
            Err(error) => {
                let t = error.place().map_or(f64::NAN, |place| place.t);
                Class::Refused(kind_of(error), format!("at t = {t}"))
            }
        }
    }

    /// By how much an error in the state moves a crossing.
    fn slack(&self, crossing: &Crossing, error: f64) -> f64 {
        let rounding = 1e-14 * (crossing.t.abs() + 1.0 / self.problem.rate);
        let steepness = crossing.steepness / crossing.rates[0].abs();
        FACTOR * error * steepness + rounding
    }

    /// The contacts that may have made a run differ from the time t on: the last one before it,
    /// and those until the second crossing after it.
    fn contacts(&self, t: f64) -> impl Iterator<Item = &Contact> {
        let contacts = &self.reference.contacts;
        let before = |contact: &&Contact| contact.t < t;
        let last = contacts
            .iter()
            .filter(before)
            .max_by(|a, b| a.t.total_cmp(&b.t));
        let crossings = self.reference.crossings.iter();
        let mut after = crossings.filter(|crossing| crossing.t > t);
        let until = after.nth(1).map_or(self.reference.t_end, |last| last.t);
        let next = contacts
            .iter()
            .filter(move |contact| contact.t >= t && contact.t <= until);
        last.into_iter().chain(next)
    }

    /// The least margin of them.
    fn margin(&self, t: f64) -> f64 {
        let margins = self.contacts(t).map(|contact| contact.margin);
        margins.fold(f64::INFINITY, f64::min)
    }

    /// The same, if it is at most `error`.
    fn nearest(&self, t: f64, error: f64) -> Option<f64> {
        Some(self.margin(t)).filter(|margin| *margin <= error)
    }
}
