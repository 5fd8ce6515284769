//! The values of a type, as its own deserialiser asks for them.

use serde::de::value::Error;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};

/// The kind of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Number,
    /// A whole number, 0 or above.
    Whole,
    /// `true` or `false`.
    Flag,
    /// A string.
    Text,
    /// One of these names.
    Names(&'static [&'static str]),
    /// A list of points.
    Points,
}

impl Shape {
    /// The values of a type; for an optional type, its values if given.
    pub fn of<T: DeserializeOwned>() -> Shape {
        let mut shape = Shape::Text;
        let _ = T::deserialize(Asked(&mut shape));
        shape
    }

    /// What it takes, in words.
    pub fn what(self) -> &'static str {
        match self {
            Shape::Number => "a number",
            Shape::Whole => "a whole number",
            Shape::Flag => "true or false",
            Shape::Text | Shape::Names(_) => "a string",
            Shape::Points => "a list of points [x, y]",
        }
    }
}

/// Records what it is asked for, and has no value.
struct Asked<'a>(&'a mut Shape);

impl Asked<'_> {
    fn note<T>(self, shape: Shape) -> Result<T, Error> {
        *self.0 = shape;
        Err(Error::custom("there is no value, only a type"))
    }
}

macro_rules! notes {
    ($($asked:ident => $shape:expr),*) => {
        $(fn $asked<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
            self.note($shape)
        })*
    };
}

impl<'de> Deserializer<'de> for Asked<'_> {
    type Error = Error;

    notes! {
        deserialize_any => Shape::Text,
        deserialize_f64 => Shape::Number,
        deserialize_u32 => Shape::Whole,
        deserialize_bool => Shape::Flag,
        deserialize_seq => Shape::Points
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_some(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Error> {
        self.note(Shape::Names(names))
    }

    serde::forward_to_deserialize_any! {
        i8 i16 i32 i64 u8 u16 u64 f32 char str string bytes byte_buf unit unit_struct newtype_struct
        tuple tuple_struct map struct identifier ignored_any
    }
}
