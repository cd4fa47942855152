//! Whether a caller still wants the answer of work that takes long.

use core::cell::Cell;
use core::fmt;

/// Rounds of a loop after which it asks [1]. Asking takes some 50 ns, a round of the fastest loops
/// as long, and one of the slowest a millisecond.
const ROUNDS: usize = 32;

/// A caller who may end work that takes long: asked now and then, on the caller's thread. Work
/// that is ended has a partial answer or an error.
///
/// ```
/// use core::cell::Cell;
/// use irbkin::Interrupt;
///
/// let asked = Cell::new(0);
/// let is_enough = || asked.replace(asked.get() + 1) == 2;
/// let interrupt = Interrupt::when(&is_enough);
/// assert_eq!([(); 3].map(|()| interrupt.is_raised()), [false, false, true]);
/// assert!(!Interrupt::none().is_raised());
/// ```
#[derive(Clone, Copy, Default)]
pub struct Interrupt<'a>(Option<&'a dyn Fn() -> bool>, Option<&'a Pace>);

/// How far work has come: rounds of its loops that are done, and all that it knows of so far.
#[derive(Debug, Default)]
pub struct Pace(Cell<[usize; 2]>);

impl Pace {
    /// The rounds that are done, and all.
    #[must_use]
    pub fn rounds(&self) -> [usize; 2] {
        self.0.get()
    }
}

impl<'a> Interrupt<'a> {
    /// A caller who waits for the answer.
    #[must_use]
    pub const fn none() -> Self {
        Self(None, None)
    }

    /// A caller who ends the work as soon as `is_raised`, which must stay so then.
    #[must_use]
    pub const fn when(is_raised: &'a dyn Fn() -> bool) -> Self {
        Self(Some(is_raised), None)
    }

    /// The caller, who is also told how far the work has come.
    #[must_use]
    pub const fn with_pace(self, pace: &'a Pace) -> Self {
        Self(self.0, Some(pace))
    }

    /// The rounds of a loop, which count as known of from now on, and as done when they begin.
    #[doc(hidden)]
    pub fn over<R: Iterator>(self, rounds: R) -> impl Iterator<Item = R::Item> {
        let advance = move |done, known| {
            let Some(Pace(rounds)) = self.1 else { return };
            let [before, all] = rounds.get();
            rounds.set([before + done, all + known]);
        };
        advance(0, rounds.size_hint().0);
        rounds.inspect(move |_| advance(1, 0))
    }

    /// Whether the work is to end.
    #[must_use]
    pub fn is_raised(self) -> bool {
        self.0.is_some_and(|is_raised| is_raised())
    }

    /// Whether a loop ends at its round of this number.
    #[doc(hidden)]
    pub fn ends(self, round: usize) -> bool {
        round.is_multiple_of(ROUNDS) && self.is_raised()
    }

    /// Refuse to go on with a loop that [`Self::ends`].
    #[doc(hidden)]
    pub fn check(self, round: usize) -> Result<(), Interrupted> {
        if self.ends(round) { Err(Interrupted) } else { Ok(()) }
    }
}

impl fmt::Debug for Interrupt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Interrupt").field(&self.0.is_some()).finish()
    }
}

/// The caller has ended the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the work was ended by its caller")]
pub struct Interrupted;
