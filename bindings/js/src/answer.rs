//! The answer of the last call, kept until the next call.

use std::cell::RefCell;

use azulejo::{Context, Error, Progress, Result};

use crate::threads::context;
use crate::watch::progress;

thread_local! {
    static ANSWER: RefCell<Answer> = RefCell::default();
}

/// Arrays of numbers, as bytes, in an order that `index.js` knows.
#[derive(Default)]
pub(crate) struct Answer(Vec<Array>);

/// Numbers of different types.
pub(crate) enum Array {
    Bytes(Vec<u8>),
    F32(Vec<f32>),
    F32x2(Vec<[f32; 2]>),
    F32x3(Vec<[f32; 3]>),
    U32(Vec<u32>),
    F64(Vec<f64>),
}

impl Array {
    /// The address of the array and its length in bytes.
    fn place(&self) -> (*const u8, usize) {
        fn of<T>(numbers: &[T]) -> (*const u8, usize) {
            (numbers.as_ptr().cast(), size_of_val(numbers))
        }
        match self {
            Self::Bytes(numbers) => of(numbers),
            Self::F32(numbers) => of(numbers),
            Self::F32x2(numbers) => of(numbers),
            Self::F32x3(numbers) => of(numbers),
            Self::U32(numbers) => of(numbers),
            Self::F64(numbers) => of(numbers),
        }
    }
}

macro_rules! arrays {
    ($($kind:ident of $number:ty),*) => {
        $(impl From<Vec<$number>> for Array {
            fn from(numbers: Vec<$number>) -> Self {
                Self::$kind(numbers)
            }
        })*
    };
}

arrays!(Bytes of u8, F32 of f32, F32x2 of [f32; 2], F32x3 of [f32; 3], U32 of u32, F64 of f64);

impl Answer {
    /// This answer with one more array.
    pub fn and<T>(mut self, numbers: Vec<T>) -> Self
    where
        Array: From<Vec<T>>,
    {
        self.0.push(numbers.into());
        self
    }
}

/// Makes a call on the threads of the module, which JavaScript watches, and keeps its answer, or the text of its error.
/// Returns 1 if it succeeded, 2 if JavaScript cancelled it, else 0.
pub(crate) fn call(body: impl FnOnce(&Context, Option<&Progress>) -> Result<Answer>) -> i32 {
    ANSWER.set(Answer::default());
    let answer = context().and_then(|context| body(&context, Some(&progress)));
    let outcome = match &answer {
        Ok(_) => 1,
        Err(Error::Cancelled) => 2,
        Err(_) => 0,
    };
    ANSWER.set(answer.unwrap_or_else(|error| Answer(vec![Array::Bytes(error.to_string().into_bytes())])));
    outcome
}

fn place(index: usize) -> (*const u8, usize) {
    ANSWER.with_borrow(|answer| answer.0.get(index).map_or((std::ptr::null(), 0), Array::place))
}

/// The address of an array of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_answer(index: usize) -> *const u8 {
    place(index).0
}

/// The length of an array of the answer in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_answer_bytes(index: usize) -> usize {
    place(index).1
}

/// Frees the answer.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_answer_free() {
    ANSWER.set(Answer::default());
}
