//! Whether journal and tables can hold every number: JSON has no NaN and no infinity. Everything
//! else comes back unchanged.

use std::fmt::Display;

use serde::ser::{
    Error, Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant,
    SerializeTuple, SerializeTupleStruct, SerializeTupleVariant, Serializer,
};

use crate::simulation::CaseResult;

/// Makes sure that a value comes back from JSON unchanged.
pub(super) fn demand(whole: &impl Serialize) -> Result<(), String> {
    whole
        .serialize(Finite)
        .map_err(|NotFinite| "not-a-number: a reported quantity is not a finite number".to_owned())
}

/// The same for the part of a result that goes to the journal.
pub(super) fn demand_of(result: &CaseResult) -> Result<(), String> {
    let CaseResult { outcome, energy, readings, phases, .. } = result;
    demand(&(outcome, energy, readings, phases))
}

/// Checks every number and writes nothing: writing and reading text takes many times as long.
#[derive(Clone, Copy)]
struct Finite;

#[derive(Debug, thiserror::Error)]
#[error("not a finite number")]
struct NotFinite;

impl Error for NotFinite {
    fn custom<T: Display>(_: T) -> NotFinite {
        NotFinite
    }
}

type Looked = Result<(), NotFinite>;

/// Types without numbers that could fail.
macro_rules! fine {
    ($($name:ident($($argument:ty),*);)*) => {
        $(fn $name(self, $(_: $argument),*) -> Looked { Ok(()) })*
    };
}

/// Types that contain others.
macro_rules! open {
    ($($name:ident($($argument:ty),*) -> $kind:ident;)*) => {
        $(type $kind = Finite;
        fn $name(self, $(_: $argument),*) -> Result<Finite, NotFinite> { Ok(self) })*
    };
}

impl Serializer for Finite {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_f64(self, value: f64) -> Looked {
        if value.is_finite() { Ok(()) } else { Err(NotFinite) }
    }

    fn serialize_f32(self, value: f32) -> Looked {
        self.serialize_f64(value.into())
    }

    fine! {
        serialize_bool(bool); serialize_char(char); serialize_str(&str); serialize_bytes(&[u8]);
        serialize_i8(i8); serialize_i16(i16); serialize_i32(i32); serialize_i64(i64);
        serialize_u8(u8); serialize_u16(u16); serialize_u32(u32); serialize_u64(u64);
        serialize_none(); serialize_unit(); serialize_unit_struct(&'static str);
        serialize_unit_variant(&'static str, u32, &'static str);
    }

    open! {
        serialize_seq(Option<usize>) -> SerializeSeq;
        serialize_tuple(usize) -> SerializeTuple;
        serialize_tuple_struct(&'static str, usize) -> SerializeTupleStruct;
        serialize_tuple_variant(&'static str, u32, &'static str, usize) -> SerializeTupleVariant;
        serialize_map(Option<usize>) -> SerializeMap;
        serialize_struct(&'static str, usize) -> SerializeStruct;
        serialize_struct_variant(&'static str, u32, &'static str, usize) -> SerializeStructVariant;
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Looked {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Looked {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        value: &T,
    ) -> Looked {
        value.serialize(self)
    }

    fn collect_str<T: Display + ?Sized>(self, _: &T) -> Looked {
        Ok(())
    }
}

/// Each value of a type that contains others.
macro_rules! each {
    ($($kind:ident: $($name:ident($($key:ty)?)),*;)*) => {
        $(impl $kind for Finite {
            type Ok = ();
            type Error = NotFinite;
            $(fn $name<T: Serialize + ?Sized>(&mut self, $(_: $key,)? value: &T) -> Looked {
                value.serialize(*self)
            })*
            fn end(self) -> Looked { Ok(()) }
        })*
    };
}

each! {
    SerializeSeq: serialize_element();
    SerializeTuple: serialize_element();
    SerializeTupleStruct: serialize_field();
    SerializeTupleVariant: serialize_field();
    SerializeMap: serialize_key(), serialize_value();
    SerializeStruct: serialize_field(&'static str);
    SerializeStructVariant: serialize_field(&'static str);
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde::{Deserialize, Serialize};

    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    enum Either {
        Unit,
        New(f64),
        Two(u8, f64),
        Named { value: f64 },
    }

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct All {
        plain: f64,
        single: f32,
        optional: Option<f64>,
        list: Vec<f64>,
        pair: (i64, f64),
        map: BTreeMap<String, f64>,
        either: [Either; 4],
        text: String,
    }

    /// With a number in one of the places.
    fn all(place: usize, number: f64) -> All {
        let at = |own: usize| if own == place { number } else { 0.1 };
        All {
            plain: at(0),
            single: at(1) as f32,
            optional: Some(at(2)),
            list: vec![0.0, at(3)],
            pair: (-1, at(4)),
            map: BTreeMap::from([("a".to_owned(), at(5))]),
            either: [
                Either::Unit,
                Either::New(at(6)),
                Either::Two(1, at(7)),
                Either::Named { value: at(8) },
            ],
            text: "NaN".to_owned(),
        }
    }

    #[test]
    fn what_passes_is_what_comes_back_from_json() {
        let numbers = [1e-310, -0.0, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        for (place, number) in (0..9).flat_map(|place| numbers.map(|number| (place, number))) {
            let whole = all(place, number);
            let text = serde_json::to_string(&whole).unwrap();
            let comes_back = serde_json::from_str::<All>(&text).is_ok_and(|read| read == whole);
            assert_eq!(demand(&whole).is_ok(), comes_back, "place {place}, {number}");
            let single_overflows = place == 1 && number == f64::MAX;
            assert_eq!(comes_back, number.is_finite() && !single_overflows);
        }
    }
}
