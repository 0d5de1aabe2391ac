//! The kinds of transitions: what they are called, and how they are counted.

use super::TransitionKind;
use crate::method::Statistics;

impl TransitionKind {
    /// What the kind is called, and its counter. All else about kinds follows from here.
    #[inline(always)]
    fn entry(self) -> (&'static str, fn(&mut Statistics) -> &mut u64) {
        match self {
            Self::Crossed => ("crossed", |statistics| &mut statistics.crossed),
            Self::Jumped => ("jumped", |statistics| &mut statistics.jumped),
            Self::BeganToSlide => ("began to slide", |statistics| {
                &mut statistics.began_to_slide
            }),
            Self::LeftSlide => ("left the slide", |statistics| &mut statistics.left_slide),
        }
    }

    /// What the kind is called in tables.
    ///
    /// ```
    /// use dmm_runtime::TransitionKind;
    ///
    /// assert_eq!(TransitionKind::Crossed.name(), "crossed");
    /// ```
    pub fn name(self) -> &'static str {
        self.entry().0
    }

    /// Counts a transition of the kind.
    #[inline]
    pub(crate) fn count(self, statistics: &mut Statistics) {
        statistics.transitions += 1;
        *self.entry().1(statistics) += 1;
    }
}
