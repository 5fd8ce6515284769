//! Sections of files: structs whose fields are declared keys.

use std::cell::LazyCell;

use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::error::ConfigError;
use super::key::Key;
use super::rule::When;
use super::shape::Shape;

/// A table of a file. `section!` writes it from the declarations of its keys.
pub trait Section: Sized {
    /// Its name in files, without brackets.
    const NAME: &'static str;
    /// Its own keys, in order.
    const KEYS: &'static [Key];
    /// The keys of what it holds at some values of its own keys alone.
    const GROUPS: &'static [&'static [Key]];

    /// Reads a table, and takes what it does not give from `base`, or else from the defaults. Keys
    /// that the section does not know are not looked at.
    ///
    /// # Errors
    /// The first value of the wrong type or out of range, and the first key that must be given and
    /// is not.
    fn read(table: &Table, base: Option<&Self>) -> Result<Self, ConfigError>;

    /// All its values, as a file would give them.
    fn table(&self) -> Table;

    /// All its keys.
    fn keys() -> Vec<&'static Key> {
        Self::KEYS.iter().chain(Self::GROUPS.iter().copied().flatten()).collect()
    }

    /// The section of an empty table.
    ///
    /// # Panics
    /// Where a key must be given.
    fn defaults() -> Self {
        Self::read(&Table::new(), None).expect("every key has a default")
    }
}

/// What few sections hold is kept apart, so that all others stay small.
impl<S: Section> Section for Box<S> {
    const NAME: &'static str = S::NAME;
    const KEYS: &'static [Key] = S::KEYS;
    const GROUPS: &'static [&'static [Key]] = S::GROUPS;

    fn read(table: &Table, base: Option<&Self>) -> Result<Self, ConfigError> {
        S::read(table, base.map(AsRef::as_ref)).map(Box::new)
    }

    fn table(&self) -> Table {
        S::table(self)
    }
}

/// Declares a section: a struct with a public field for each key. See [`crate::keys`].
macro_rules! section {
    (
        $(#[doc = $about:literal])*
        $visibility:vis struct $section:ident in $title:literal {
            $(
                $(#[doc = $meaning:literal])*
                $name:ident: $type:ty $(= $default:expr)?, $rule:expr;
            )*
        }
        $(with {
            $(
                $(#[doc = $group_about:literal])*
                $group:ident: $of:ty where $holds:expr;
            )*
        })?
    ) => {
        $(#[doc = $about])*
        #[derive(Debug, Clone, PartialEq)]
        $visibility struct $section {
            $($(#[doc = $meaning])* pub $name: $type,)*
            $($($(#[doc = $group_about])* pub $group: Option<$of>,)*)?
        }

        impl $crate::keys::Section for $section {
            const NAME: &'static str = $title;
            const KEYS: &'static [$crate::keys::Key] = {
                #[allow(unused_imports)]
                use $crate::keys::{plain, unit};
                &[$($crate::keys::Key {
                    name: stringify!($name),
                    meaning: concat!($($meaning),*),
                    rule: $rule,
                    shape: $crate::keys::Shape::of::<$type>,
                    default: || None $(.or($crate::keys::value_of::<$type>(&$default)))?,
                    required: true $(&& { let _ = stringify!($default); false })?,
                }),*]
            };
            const GROUPS: &'static [&'static [$crate::keys::Key]] =
                &[$($(<$of as $crate::keys::Section>::KEYS),*)?];

            fn read(
                table: &toml::Table,
                base: Option<&Self>,
            ) -> Result<Self, $crate::keys::ConfigError> {
                $(let $name: $type = {
                    let base = base.map(|base| Clone::clone(&base.$name));
                    let otherwise = || base$(.or_else(|| Some($default)))?;
                    $crate::keys::value::<Self, _>(stringify!($name), table, otherwise)?
                };)*
                $($(let $group = if $holds {
                    let base = base.and_then(|base| base.$group.as_ref());
                    Some(<$of as $crate::keys::Section>::read(table, base)?)
                } else {
                    None
                };)*)?
                Ok($section { $($name,)* $($($group,)*)? })
            }

            fn table(&self) -> toml::Table {
                let mut table = toml::Table::new();
                $($crate::keys::store::<Self, _>(stringify!($name), &self.$name, &mut table);)*
                $($(table.extend(self.$group.iter().flat_map($crate::keys::Section::table));)*)?
                table
            }
        }

        impl serde::Serialize for $section {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::keys::Section::table(self).serialize(serializer)
            }
        }

        impl<'de> serde::Deserialize<'de> for $section {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let table = toml::Table::deserialize(deserializer)?;
                <Self as $crate::keys::Section>::read(&table, None).map_err(serde::de::Error::custom)
            }
        }
    };
}
pub(crate) use section;

fn own<S: Section>(name: &str) -> &'static Key {
    S::KEYS.iter().find(|key| key.name == name).expect("the field of a section is its key")
}

/// The value of a section's key, from its table or otherwise.
pub fn value<S: Section, T: DeserializeOwned>(
    name: &str,
    table: &Table,
    otherwise: impl FnOnce() -> Option<T>,
) -> Result<T, ConfigError> {
    let key = own::<S>(name);
    let path = || format!("{}.{name}", S::NAME);
    let Some(value) = table.get(name) else {
        return otherwise().ok_or_else(|| key.missing(&path()));
    };
    let read = T::deserialize(whole(key, value).unwrap_or_else(|| value.clone()))
        .map_err(|error| key.refuse(&path(), value, error.message()))?;
    key.check(&path(), value)?;
    Ok(read)
}

/// A whole number that is written with a point or an exponent, as 1e5, where a key takes these alone.
fn whole(key: &Key, value: &Value) -> Option<Value> {
    let number = value.as_float().filter(|number| (0.0..=f64::from(u32::MAX)).contains(number))?;
    let is_whole = number.fract() == 0.0 && (key.shape)() == Shape::Whole;
    is_whole.then_some(Value::Integer(number as i64))
}

/// Puts a value of a section into its table, where there is one.
pub fn store<S: Section, T: Serialize>(name: &str, value: &T, table: &mut Table) {
    let key = own::<S>(name);
    let Some(value) = value_of(value) else { return };
    if !(key.rule.newer && (key.default)().as_ref() == Some(&value)) {
        table.insert(name.to_owned(), value);
    }
}

/// What a file would give; nothing for what is not there.
pub fn value_of<T: Serialize>(value: &T) -> Option<Value> {
    Value::try_from(value).ok()
}

/// Reads a table that stands by itself.
///
/// # Errors
/// The first unknown key, with the nearest known one; the first value that does not fit; the first
/// key that belongs to other values of another.
pub fn read_alone<S: Section>(table: &Table) -> Result<S, ConfigError> {
    let known = S::keys();
    if let Some(name) = table.keys().find(|name| known.iter().all(|key| key.name != name.as_str()))
    {
        return Err(ConfigError::unknown_in_table(&format!("{}.{name}", S::NAME), &known));
    }
    let section = S::read(table, None)?;
    check_conditions(table, &section)?;
    Ok(section)
}

/// Checks what keys say of one another: `given` is what a file says, `section` what holds in the end.
///
/// # Errors
/// A key that belongs to other values of another key; one that is needed and not there.
pub fn check_conditions<S: Section>(given: &Table, section: &S) -> Result<(), ConfigError> {
    // Mostly no condition has to be looked at, and to write a table takes as long as to read it.
    let complete = LazyCell::new(|| section.table());
    let holds = |when: &When| match given.contains_key(when.key) {
        true => when.holds(given),
        false => when.holds(&complete),
    };
    for key in S::keys() {
        let path = || format!("{}.{}", S::NAME, key.name);
        let missed = key.rule.needed && !given.contains_key(key.name);
        if missed && key.applies(&complete) && !complete.contains_key(key.name) {
            return Err(key.missing(&path()));
        }
        let Some((when, value)) = key.rule.only.zip(given.get(key.name)) else { continue };
        if !holds(&when) {
            return Err(ConfigError::new(&path(), value, format!("belongs to {when}")));
        }
    }
    Ok(())
}
