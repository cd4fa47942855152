//! The exports: a request and its answer as buffers in linear memory.
//!
//! A caller writes a request into the buffer of [`alloc`] and passes it to [`call`], which frees it.
//! The answer is four bytes with the length of a text, the least first, then the text in UTF-8;
//! [`release`] frees it. An address that is of no buffer is answered by an error: nothing is read
//! or written through it. The only `unsafe` are the names of the exports.
#![allow(unsafe_code)]

use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use crate::{Page, refused};

/// The page, and the buffers that the caller has.
static STATE: LazyLock<Mutex<State>> = LazyLock::new(Mutex::default);

#[derive(Default)]
struct State {
    page: Page,
    buffers: Vec<Box<[u8]>>,
}

impl State {
    /// Keep a buffer; its address.
    fn keep(&mut self, buffer: Vec<u8>) -> usize {
        let mut buffer = buffer.into_boxed_slice();
        let address = buffer.as_mut_ptr().expose_provenance();
        self.buffers.push(buffer);
        address
    }

    /// Take the buffer at an address.
    fn take(&mut self, address: usize) -> Option<Box<[u8]>> {
        let at = self.buffers.iter().position(|buffer| buffer.as_ptr().addr() == address)?;
        Some(self.buffers.swap_remove(at))
    }

    /// The answer to the request in the first `len` bytes of a buffer.
    fn answer(&mut self, address: usize, len: usize) -> String {
        let buffer = self.take(address);
        match buffer.as_deref().and_then(|buffer| buffer.get(..len)).map(str::from_utf8) {
            Some(Ok(request)) => self.page.answer(request),
            Some(Err(_)) => refused("the request is not UTF-8"),
            None => refused("the request is in no buffer of alloc, or longer than it"),
        }
    }
}

fn state() -> MutexGuard<'static, State> {
    STATE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A buffer of `len` bytes for a request; its address.
// SAFETY: no other symbol has this name, and the function takes and returns plain numbers.
#[unsafe(no_mangle)]
pub extern "C" fn alloc(len: usize) -> usize {
    // One byte at least, so that every buffer has an address of its own.
    state().keep(vec![0; len.max(1)])
}

/// Answer the request in the first `len` bytes of a buffer, which is freed; the address of the
/// answer.
// SAFETY: as of `alloc`.
#[unsafe(no_mangle)]
pub extern "C" fn call(address: usize, len: usize) -> usize {
    let mut state = state();
    let text = state.answer(address, len);
    let length = u32::try_from(text.len()).unwrap_or(u32::MAX);
    let mut answer = Vec::with_capacity(4 + text.len());
    answer.extend(length.to_le_bytes());
    answer.extend(text.as_bytes());
    state.keep(answer)
}

/// Free a buffer.
// SAFETY: as of `alloc`.
#[unsafe(no_mangle)]
pub extern "C" fn release(address: usize) {
    state().take(address);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(address: usize) -> String {
        let answer = state().take(address).unwrap();
        let length = u32::from_le_bytes(answer[..4].try_into().unwrap());
        assert_eq!(answer.len(), 4 + usize::try_from(length).unwrap());
        String::from_utf8(answer[4..].to_vec()).unwrap()
    }

    #[test]
    fn a_request_is_answered_and_both_buffers_are_freed() {
        let request = br#"{"do": "catalog"}"#;
        let address = alloc(request.len());
        let mut held = state().take(address).unwrap();
        held.copy_from_slice(request);
        let address = state().keep(held.into_vec());
        let answer = call(address, request.len());
        assert!(state().take(address).is_none());
        assert!(text(answer).starts_with(r#"{"ok":"#));
    }

    #[test]
    fn an_address_of_no_buffer_and_invalid_text_are_refused() {
        assert!(text(call(17, 4)).contains("in no buffer"));
        assert!(text(call(alloc(4), 5)).contains("longer than it"));
        let address = state().keep(vec![0xff; 3]);
        assert!(text(call(address, 3)).contains("not UTF-8"));
        release(17);
    }
}
