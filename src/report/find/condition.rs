//! A condition: `force_max < 2 and runup_max <= 0.5`.

use std::fmt;

use super::subject::{Number, Subject, flag};
use crate::math::decimal;
use crate::report::load::Loaded;

/// How a number is compared with a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// `<`
    Below,
    /// `<=`
    AtMost,
    /// `>`
    Above,
    /// `>=`
    AtLeast,
    /// `=` or `==`: equal to four digits, as nobody writes more by hand.
    Equal,
}

/// One comparison.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The quantity that is compared.
    pub subject: Subject,
    /// How it is compared.
    pub operator: Operator,
    /// The limit.
    pub limit: f64,
}

/// Whether a case meets a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It does.
    Met,
    /// It does not.
    NotMet,
    /// Its files do not say.
    Unknown,
}

/// Comparisons that must all be met.
#[derive(Debug, Clone)]
pub struct Condition(pub Vec<Comparison>);

const SHAPE: &str = "write COLUMN < NUMBER, with <, <=, >, >= or =, and `and` between comparisons, as in \
                     \"force_max < 2 and runup_max < 0.5\"";

impl Operator {
    /// Longer signs stand before those that begin the same way.
    const SIGNS: [(&'static str, Operator); 6] = [
        ("<=", Operator::AtMost),
        (">=", Operator::AtLeast),
        ("<", Operator::Below),
        (">", Operator::Above),
        ("==", Operator::Equal),
        ("=", Operator::Equal),
    ];

    fn sign(self) -> &'static str {
        match self {
            Operator::Below => "<",
            Operator::AtMost => "<=",
            Operator::Above => ">",
            Operator::AtLeast => ">=",
            Operator::Equal => "=",
        }
    }

    /// Whether the comparison's result may change for a larger value.
    fn may_change_above(self, value: f64, limit: f64) -> bool {
        match self {
            Operator::Below | Operator::AtMost => self.holds(value, limit),
            Operator::Above | Operator::AtLeast => !self.holds(value, limit),
            Operator::Equal => value < limit || self.holds(value, limit),
        }
    }

    fn holds(self, value: f64, limit: f64) -> bool {
        match self {
            Operator::Below => value < limit,
            Operator::AtMost => value <= limit,
            Operator::Above => value > limit,
            Operator::AtLeast => value >= limit,
            Operator::Equal => (value - limit).abs() <= 5e-4 * limit.abs(),
        }
    }
}

impl Comparison {
    /// Whether a case meets it. For a lower bound the true value may be anything above.
    pub fn verdict(&self, row: usize) -> Verdict {
        let Number::Value { value, bound, .. } = self.subject.readings[row] else {
            return Verdict::Unknown;
        };
        match self.operator.holds(value, self.limit) {
            _ if bound && self.operator.may_change_above(value, self.limit) => Verdict::Unknown,
            true => Verdict::Met,
            false => Verdict::NotMet,
        }
    }

    /// Whether a case's error bar reaches the limit. Equality has no other side.
    pub fn is_near(&self, row: usize) -> bool {
        match self.subject.readings[row] {
            _ if self.operator == Operator::Equal => false,
            Number::Value { value, bar: Some(bar), .. } => (value - self.limit).abs() <= bar,
            _ => false,
        }
    }
}

impl Condition {
    /// Reads a condition on the columns of a study.
    ///
    /// # Errors
    /// In one line: a malformed comparison, a column that the study does not have, or no number.
    pub fn read(text: &str, data: &Loaded) -> Result<Condition, String> {
        let words: Vec<_> = text.split_whitespace().collect();
        let parts = words.split(|word| word.eq_ignore_ascii_case("and"));
        parts.map(|part| comparison(&part.join(" "), data)).collect::<Result<_, _>>().map(Condition)
    }

    /// The subjects that are to equal a number.
    pub fn equal(&self) -> impl Iterator<Item = &Subject> {
        let equal = self.0.iter().filter(|one| one.operator == Operator::Equal);
        equal.map(|one| &one.subject)
    }

    /// Whether a column that was not swept is to equal a number: such points are on no axis.
    pub fn picks_points(&self, data: &Loaded) -> bool {
        self.equal().any(|one| data.keys.iter().all(|key| key.name != one.name))
    }

    /// Whether a case meets all comparisons. One that is not met decides, even beside unknowns.
    pub fn verdict(&self, row: usize) -> Verdict {
        let verdicts = || self.0.iter().map(|comparison| comparison.verdict(row));
        if verdicts().any(|verdict| verdict == Verdict::NotMet) {
            Verdict::NotMet
        } else if verdicts().any(|verdict| verdict == Verdict::Unknown) {
            Verdict::Unknown
        } else {
            Verdict::Met
        }
    }

    /// Whether the error bar of any compared number reaches its limit.
    pub fn is_near(&self, row: usize) -> bool {
        self.0.iter().any(|comparison| comparison.is_near(row))
    }
}

fn comparison(text: &str, data: &Loaded) -> Result<Comparison, String> {
    let bad = |reason: &str| Err(format!("{text:?}: {reason}; {SHAPE}"));
    if text.is_empty() {
        return bad("a comparison is missing");
    }
    let found = Operator::SIGNS.iter().find_map(|(sign, operator)| {
        text.split_once(sign).map(|(name, limit)| (*operator, name, limit))
    });
    let Some((operator, name, limit)) = found else {
        return bad("holds none of <, <=, >, >= and =");
    };
    let (name, limit) = (name.trim(), limit.trim());
    if name.is_empty() {
        return bad("names no column");
    }
    let subject = || Subject::of(name, data);
    if let Some(limit) = flag(limit) {
        let subject = subject().ok().filter(|subject| subject.is_flag);
        if let Some(subject) = subject {
            return Ok(Comparison { subject, operator, limit });
        }
    }
    let Some(limit) = decimal::read(limit).filter(|limit| limit.is_finite()) else {
        let only = "the limit must be one finite number, without a unit";
        return bad(&format!("{limit:?} is no limit: {only}"));
    };
    Ok(Comparison { subject: subject()?, operator, limit })
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.subject.name, self.operator.sign(), self.limit)
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<_> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&parts.join(" and "))
    }
}
