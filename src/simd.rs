//! Which vector instructions the processor has. Code for them exists beside a portable twin, equal to the bit, and is chosen at
//! run time.
//!
//! A level other than the portable one holds a token that only detection makes: code that has the token may run the
//! instructions, and no safe code can ask for instructions that the processor lacks.

/// Proof that the processor has AVX2, POPCNT, BMI1 and BMI2.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Avx2(());

/// Proof that the processor has what [`Avx2`] says, and AVX-512 F, VL, DQ and BW.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Avx512(());

/// A level of vector instructions that the processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

impl Level {
    /// The widest level.
    pub fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("popcnt")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
        {
            let is_wide = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw");
            return if is_wide { Self::Avx512(Avx512(())) } else { Self::Avx2(Avx2(())) };
        }
        Self::Portable
    }

    /// All levels, from the portable one to the widest.
    #[cfg(test)]
    pub fn available() -> Vec<Self> {
        match Self::widest() {
            Self::Portable => vec![Self::Portable],
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => vec![Self::Portable, Self::widest()],
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => vec![Self::Portable, Self::Avx2(Avx2(())), Self::widest()],
        }
    }
}
