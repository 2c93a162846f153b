//! Keys of draws: fixed seeds from which the coordinates of the random points come.

/// The key of a draw: equal keys draw equal values, and other keys draw other values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key(u64, u64);

impl Key {
    /// The key of a kind of value, such as "symbol" or "angle".
    #[must_use]
    pub(crate) fn new(domain: &str) -> Self {
        Self(0x9e37_79b9_7f4a_7c15, 0xc2b2_ae3d_27d4_eb4f).text(domain)
    }

    /// The key extended by a word.
    #[must_use]
    pub(crate) const fn word(self, word: u64) -> Self {
        let a = mix(self.0 ^ word);
        let b = mix(self.1.wrapping_add(word).rotate_left(29) ^ a);
        Self(a.wrapping_add(self.1.rotate_left(17)), b)
    }

    /// The key extended by a text.
    #[must_use]
    pub(crate) fn text(self, text: &str) -> Self {
        let mut key = self.word(text.len() as u64);
        for chunk in text.as_bytes().chunks(8) {
            let mut word = [0u8; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            key = key.word(u64::from_le_bytes(word));
        }
        key
    }

    /// Half a word, different for every salt.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the upper half of a word is half a word")]
    pub(crate) const fn draw_word(&self, salt: u64) -> u32 {
        (self.draw(salt) >> 30) as u32
    }

    /// A word below 2^62, different for every salt.
    pub(crate) const fn draw(&self, salt: u64) -> u64 {
        let a = mix(self.0 ^ salt);
        mix(a.wrapping_add(self.1)) >> 2
    }
}

/// The finaliser of splitmix64 [Steele, Lea & Flood 2014].
const fn mix(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
