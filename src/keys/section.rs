//! Sections of files: structs whose fields are declared keys.

use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::error::ConfigError;
use super::key::Key;
use super::shape::Shape;

/// A table of a file. `section!` writes it from the declarations of its keys.
pub trait Section: Sized {
    /// Its name in files, without brackets.
    const NAME: &'static str;
    /// Its own keys, in order.
    const KEYS: &'static [Key];
    /// The keys of groups that it only has for some values of its own keys.
    const GROUPS: &'static [&'static [Key]];

    /// Reads a table. Missing values come from `base`, or else from the defaults. Unknown keys are
    /// ignored.
    ///
    /// # Errors
    /// The first value of the wrong type or out of range; the first required key that is missing.
    fn read(table: &Table, base: Option<&Self>) -> Result<Self, ConfigError>;

    /// All its values as in a file, in the order of its keys.
    fn entries(&self) -> Vec<(&'static str, Value)>;

    /// The same as a table.
    fn table(&self) -> Table {
        self.entries().into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// The value of a key, as in a file.
    fn entry(&self, name: &str) -> Option<Value>;

    /// Adds the names of all keys whose values differ. False if only one of the two has some group
    /// of keys.
    fn differing(&self, other: &Self, names: &mut Vec<&'static str>) -> bool;

    /// All its keys.
    fn keys() -> Vec<&'static Key> {
        Self::KEYS.iter().chain(Self::GROUPS.iter().copied().flatten()).collect()
    }

    /// Whether it has a key of this name.
    fn has(name: &str) -> bool {
        let groups = Self::GROUPS.iter().copied().flatten();
        Self::KEYS.iter().chain(groups).any(|key| key.name == name)
    }

    /// The section of an empty table.
    ///
    /// # Panics
    /// A key is required.
    fn defaults() -> Self {
        Self::read(&Table::new(), None).expect("every key has a default")
    }
}

/// Rare parts of a section are boxed, so that the others stay small.
impl<S: Section> Section for Box<S> {
    const NAME: &'static str = S::NAME;
    const KEYS: &'static [Key] = S::KEYS;
    const GROUPS: &'static [&'static [Key]] = S::GROUPS;

    fn read(table: &Table, base: Option<&Self>) -> Result<Self, ConfigError> {
        S::read(table, base.map(AsRef::as_ref)).map(Box::new)
    }

    fn entries(&self) -> Vec<(&'static str, Value)> {
        S::entries(self)
    }

    fn entry(&self, name: &str) -> Option<Value> {
        S::entry(self, name)
    }

    fn differing(&self, other: &Self, names: &mut Vec<&'static str>) -> bool {
        S::differing(self, other, names)
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
                let mut keys = <Self as $crate::keys::Section>::KEYS.iter();
                $(let $name: $type = {
                    let base = base.map(|base| Clone::clone(&base.$name));
                    let otherwise = || base$(.or_else(|| Some($default)))?;
                    let key = keys.next().expect("each field is a key");
                    $crate::keys::value($title, key, table, otherwise)?
                };)*
                $($(let $group = if $holds {
                    let base = base.and_then(|base| base.$group.as_ref());
                    Some(<$of as $crate::keys::Section>::read(table, base)?)
                } else {
                    None
                };)*)?
                Ok($section { $($name,)* $($($group,)*)? })
            }

            fn entries(&self) -> Vec<(&'static str, toml::Value)> {
                let mut keys = Self::KEYS.iter();
                let mut entries = Vec::with_capacity(Self::KEYS.len());
                $(entries.extend(keys.next().and_then(|key| $crate::keys::stored(key, &self.$name)));)*
                $($(entries.extend(self.$group.iter().flat_map($crate::keys::Section::entries));)*)?
                entries
            }

            fn entry(&self, name: &str) -> Option<toml::Value> {
                $(if name == stringify!($name) {
                    return $crate::keys::value_of(&self.$name);
                })*
                None $($(.or_else(|| {
                    self.$group.as_ref().and_then(|group| $crate::keys::Section::entry(group, name))
                }))*)?
            }

            fn differing(&self, other: &Self, names: &mut Vec<&'static str>) -> bool {
                $(if self.$name != other.$name {
                    names.push(stringify!($name));
                })*
                true $($(&& match (&self.$group, &other.$group) {
                    (Some(one), Some(other)) => {
                        $crate::keys::Section::differing(one, other, names)
                    }
                    (None, None) => true,
                    _ => false,
                })*)?
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

/// Tables with at most this many entries are searched linearly, because hashing a name takes
/// longer.
const FEW: usize = 12;

/// The value of a key in a table.
pub fn given<'a>(table: &'a Table, name: &str) -> Option<&'a Value> {
    if table.len() > FEW {
        return table.get(name);
    }
    table.iter().find(|(key, _)| *key == name).map(|(_, value)| value)
}

/// The value of a section's key, from its table or from elsewhere.
pub fn value<T: DeserializeOwned>(
    section: &str,
    key: &Key,
    table: &Table,
    otherwise: impl FnOnce() -> Option<T>,
) -> Result<T, ConfigError> {
    let path = || format!("{section}.{}", key.name);
    let Some(value) = given(table, key.name) else {
        return otherwise().ok_or_else(|| key.missing(&path()));
    };
    let read = T::deserialize(whole(key, value).unwrap_or_else(|| value.clone()))
        .map_err(|error| key.refuse(&path(), value, error.message()))?;
    key.check(&path(), value)?;
    Ok(read)
}

/// A whole number that is written with a point or an exponent, as 1e5, if a key only takes whole
/// numbers.
fn whole(key: &Key, value: &Value) -> Option<Value> {
    let number = value.as_float().filter(|number| (0.0..=f64::from(u32::MAX)).contains(number))?;
    let is_whole = number.fract() == 0.0 && (key.shape)() == Shape::Whole;
    is_whole.then_some(Value::Integer(number as i64))
}

/// The entry of a key in a section's table.
pub fn stored<T: Serialize>(key: &Key, value: &T) -> Option<(&'static str, Value)> {
    let value = value_of(value)?;
    let left_out = key.rule.newer && (key.default)().as_ref() == Some(&value);
    (!left_out).then_some((key.name, value))
}

/// The value as in a file; none for `None`.
pub fn value_of<T: Serialize>(value: &T) -> Option<Value> {
    Value::try_from(value).ok()
}
