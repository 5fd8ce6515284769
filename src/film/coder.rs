//! Packs small whole numbers into bytes: an arithmetic coder that learns how often a bit is set
//! (Martin 1979; the form of LZMA). A plain script of some twenty lines decodes it.

/// Writes or reads one bit after another, each with its own learned probability.
pub(super) trait Coder {
    /// Codes a bit; a decoder ignores `bit`. Returns the bit as the decoder has it.
    fn bit(&mut self, chance: &mut u16, bit: bool) -> bool;
}

/// A probability of one half; probabilities of a zero are in 1/2048.
const HALF: u16 = 1024;
/// Below this range the next byte is written.
const SHORT: u32 = 1 << 24;

fn learn(chance: &mut u16, bit: bool) {
    if bit {
        *chance -= *chance >> 5;
    } else {
        *chance += (2048 - *chance) >> 5;
    }
}

/// Writes bits.
#[derive(Debug)]
pub(super) struct Encoder {
    low: u64,
    range: u32,
    cache: u8,
    /// Bytes that a carry may still change.
    waiting: u64,
    bytes: Vec<u8>,
}

impl Encoder {
    pub fn new() -> Encoder {
        Encoder { low: 0, range: u32::MAX, cache: 0, waiting: 1, bytes: Vec::new() }
    }

    fn shift(&mut self) {
        if self.low < 0xff00_0000 || self.low > 0xffff_ffff {
            let carry = (self.low >> 32) as u8;
            let mut byte = self.cache;
            for _ in 0..self.waiting {
                self.bytes.push(byte.wrapping_add(carry));
                byte = 0xff;
            }
            self.waiting = 0;
            self.cache = (self.low >> 24) as u8;
        }
        self.waiting += 1;
        self.low = (self.low & 0x00ff_ffff) << 8;
    }

    /// All bytes written so far.
    pub fn finish(mut self) -> Vec<u8> {
        for _ in 0..5 {
            self.shift();
        }
        self.bytes
    }
}

impl Coder for Encoder {
    fn bit(&mut self, chance: &mut u16, bit: bool) -> bool {
        let bound = (self.range >> 11) * u32::from(*chance);
        if bit {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        learn(chance, bit);
        while self.range < SHORT {
            self.range <<= 8;
            self.shift();
        }
        bit
    }
}

/// Up to this size a number takes a bit per unit; larger ones take a few bits more.
const UNARY: u32 = 14;
/// Probabilities of a number: that it is zero, of its sign, its size, and the rest.
const CHANCES: usize = UNARY as usize + 4;

/// The probabilities of a number in one context.
#[derive(Debug, Clone)]
pub(super) struct Chances([u16; CHANCES]);

impl Chances {
    pub const EVEN: Chances = Chances([HALF; CHANCES]);

    /// Codes a number; a decoder ignores `number`. Returns the number as the decoder has it.
    pub fn code(&mut self, coder: &mut impl Coder, number: i32) -> i32 {
        let [zero, sign, rest @ ..] = &mut self.0;
        let (sizes, beyond) = rest.split_at_mut(UNARY as usize);
        let wanted = number.unsigned_abs();
        if !coder.bit(zero, wanted > 0) {
            return 0;
        }
        let negative = coder.bit(sign, number < 0);
        let mut size = 1;
        while size < UNARY && coder.bit(&mut sizes[size as usize - 1], wanted > size) {
            size += 1;
        }
        if size == UNARY {
            let over = wanted.wrapping_sub(UNARY - 1).max(1);
            let mut digits = 0;
            while coder.bit(&mut beyond[0], digits < over.ilog2()) {
                digits += 1;
            }
            let mut read = 1;
            for digit in (0..digits).rev() {
                read = read << 1 | u32::from(coder.bit(&mut beyond[1], over >> digit & 1 == 1));
            }
            size += read - 1;
        }
        if negative { -(size as i32) } else { size as i32 }
    }
}

#[cfg(test)]
pub(super) mod decoder {
    use super::*;

    /// Reads bits.
    pub struct Decoder<'a> {
        range: u32,
        code: u32,
        bytes: std::slice::Iter<'a, u8>,
    }

    impl Decoder<'_> {
        pub fn new(bytes: &[u8]) -> Decoder<'_> {
            let mut decoder = Decoder { range: u32::MAX, code: 0, bytes: bytes.iter() };
            for _ in 0..5 {
                decoder.take();
            }
            decoder
        }

        fn take(&mut self) {
            self.code = self.code << 8 | u32::from(self.bytes.next().copied().unwrap_or(0));
        }
    }

    impl Coder for Decoder<'_> {
        fn bit(&mut self, chance: &mut u16, _: bool) -> bool {
            let bound = (self.range >> 11) * u32::from(*chance);
            let bit = self.code >= bound;
            if bit {
                self.code -= bound;
                self.range -= bound;
            } else {
                self.range = bound;
            }
            learn(chance, bit);
            while self.range < SHORT {
                self.range <<= 8;
                self.take();
            }
            bit
        }
    }
}

#[cfg(test)]
mod tests {
    use super::decoder::Decoder;
    use super::*;

    #[test]
    fn numbers_of_any_size_come_back() {
        let small = (0..20_000).map(|k: i32| (k * 7919 % 5 - 2) * i32::from(k % 3 == 0));
        let large = [0, 1, -1, 13, -13, 14, -14, 15, 16, 17, 100, -2047, 1_000_000];
        let numbers: Vec<i32> = large.into_iter().chain(small).chain(large).collect();
        let (mut encoder, mut chances) = (Encoder::new(), Chances::EVEN);
        for &number in &numbers {
            assert_eq!(chances.code(&mut encoder, number), number);
        }
        let bytes = encoder.finish();
        assert!(bytes.len() < 4500, "{}", bytes.len());
        let (mut decoder, mut chances) = (Decoder::new(&bytes), Chances::EVEN);
        for &number in &numbers {
            assert_eq!(chances.code(&mut decoder, 0), number);
        }
    }
}
