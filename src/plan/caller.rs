//! What may be asked of the caller while a plan is made.

use alloc::vec::Vec;

/// After how many layers the caller is asked whether to go on.
const WATCHED: usize = 64;

/// A caller's own test of joint vectors, asked for many at a time: whether each is accepted, or
/// nothing to stop.
pub type Accept<'a> = dyn FnMut(&[[f64; 6]]) -> Option<Vec<bool>> + 'a;

/// A caller: its test of joint vectors, if it has one, and whether to go on.
pub(crate) struct Caller<'a, 'b> {
    pub(crate) accept: Option<&'a mut Accept<'b>>,
    pub(crate) watch: Watch<'a>,
}

/// Whether to go on; without a caller to ask, always.
#[derive(Clone, Copy, Default)]
pub(crate) struct Watch<'a>(pub(crate) Option<&'a dyn Fn() -> bool>);

impl Watch<'_> {
    pub(super) fn goes_on(self) -> bool {
        self.0.is_none_or(|goes_on| goes_on())
    }

    /// Whether a loop over many ends here: it asks now and then, not at once.
    pub(super) fn ends_at(self, number: usize) -> bool {
        number % WATCHED == WATCHED - 1 && !self.goes_on()
    }
}
