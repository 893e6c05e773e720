//! Parts that several threads make of one vector, each put in its place as soon as those before it are made.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The vector that the parts become, while they are made.
pub(super) struct Placing<'a, T>(Mutex<State<'a, T>>);

struct State<'a, T> {
    /// What is left of the vector's memory.
    free: &'a mut [T],
    /// How many parts have a place.
    placed: usize,
    /// Parts that were made before their turn.
    early: BTreeMap<usize, Vec<T>>,
    /// The parts from the first one on that the memory was too short for.
    beyond: Vec<Vec<T>>,
}

impl<'a, T: Copy> Placing<'a, T> {
    /// No parts yet, and memory for them.
    pub fn new(memory: &'a mut [T]) -> Self {
        Self(Mutex::new(State { free: memory, placed: 0, early: BTreeMap::new(), beyond: Vec::new() }))
    }

    /// Puts a part in its place, or keeps it until those before it have one. The copy happens outside of the lock, by
    /// the thread that has the part in its cache: so the page faults of memory that is new are shared as well.
    pub fn put(&self, index: usize, part: Vec<T>) {
        // A panic in another thread ends the call; what is placed after it does not matter.
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        state.early.insert(index, part);
        let mut ready = Vec::new();
        while let Some((place, part)) = state.next() {
            ready.push((place, part));
        }
        drop(state);
        ready.into_iter().for_each(|(place, part)| place.copy_from_slice(&part));
    }

    /// How much of the memory is left, and the parts that found no place in it.
    pub fn finish(self) -> (usize, Vec<Vec<T>>) {
        let state = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        (state.free.len(), state.beyond)
    }
}

impl<'a, T> State<'a, T> {
    /// The part whose turn it is, if it is made, and its place.
    fn next(&mut self) -> Option<(&'a mut [T], Vec<T>)> {
        loop {
            let part = self.early.remove(&self.placed)?;
            self.placed += 1;
            if self.beyond.is_empty() && part.len() <= self.free.len() {
                let (place, free) = std::mem::take(&mut self.free).split_at_mut(part.len());
                self.free = free;
                return Some((place, part));
            }
            self.beyond.push(part);
        }
    }
}
