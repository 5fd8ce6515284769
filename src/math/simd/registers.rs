//! Arithmetic with one processor instruction per register, for vectors of one or two registers.

/// Sums, differences and products: the vector, its registers, the instructions.
macro_rules! operators {
    ($Name:ident [$($at:tt),+]: $add:ident, $sub:ident, $mul:ident) => {
        impl std::ops::Add for $Name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: the processor has these instructions wherever a value of this type exists.
                unsafe { $Name($($add(self.$at, other.$at)),+) }
            }
        }

        impl std::ops::Sub for $Name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: the processor has these instructions wherever a value of this type exists.
                unsafe { $Name($($sub(self.$at, other.$at)),+) }
            }
        }

        impl std::ops::Mul for $Name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: the processor has these instructions wherever a value of this type exists.
                unsafe { $Name($($mul(self.$at, other.$at)),+) }
            }
        }

        impl std::ops::AddAssign for $Name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
    };
}

/// Methods of `Vector`: the registers, the instructions of one number and of several.
macro_rules! arithmetic {
    (
        [$($at:tt),+]: $sqrt:ident, $div:ident, $min:ident, $max:ident,
        $fmadd:ident, $fmsub:ident, $fnmadd:ident
    ) => {
        #[inline(always)]
        fn mul_add(self, factor: Self, addend: Self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($fmadd(self.$at, factor.$at, addend.$at)),+) }
        }
        #[inline(always)]
        fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($fmsub(self.$at, factor.$at, subtrahend.$at)),+) }
        }
        #[inline(always)]
        fn negated_mul_add(self, factor: Self, addend: Self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($fnmadd(self.$at, factor.$at, addend.$at)),+) }
        }
        #[inline(always)]
        fn div(self, divisor: Self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($div(self.$at, divisor.$at)),+) }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($sqrt(self.$at)),+) }
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($min(self.$at, other.$at)),+) }
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            // SAFETY: the processor has these instructions wherever a value of this type exists.
            unsafe { Self($($max(self.$at, other.$at)),+) }
        }
    };
}

pub(super) use {arithmetic, operators};
