//! Values and unit expressions: `1.764e6 slug ft^2`, `17.5 kN s/m`, `1e-6 m²/(rad/m)`.

use super::{Dimension, UnitError, symbol};

/// A unit: its size in SI base units and its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Size in kg, m, s, rad.
    pub factor: f64,
    /// Its dimension.
    pub dimension: Dimension,
}

/// A number with a unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure<'a> {
    /// The number as written.
    pub number: f64,
    /// The unit as written; empty for a bare number.
    pub label: &'a str,
    /// The unit.
    pub unit: Unit,
}

/// Longest value that is read, bytes. It also bounds the depth of parentheses.
pub const LONGEST: usize = 100;

/// A regular expression for values with units, in the dialect of JSON Schema (ECMA-262).
///
/// Every value that can be read matches; without `negative` every one above zero. Whether brackets
/// close and the dimension is right it cannot tell.
pub fn pattern(negative: bool) -> String {
    let sign = if negative { r"[+\-]?" } else { r"\+?" };
    let number = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+\-]?[0-9]+)?";
    let between = r"(?:[()\s*·⋅/]|\^-?[1-4]|⁻?[¹²³⁴])";
    let symbol = symbol::alternatives();
    format!(r"^\s*{sign}{number}\s*{between}*(?:{symbol})(?:{between}+(?:{symbol}))*{between}*$")
}

impl Unit {
    const ONE: Self = Self {
        factor: 1.0,
        dimension: Dimension::new(0, 0, 0, 0),
    };

    /// Reads a unit expression: products by space, `*` or `·`; `/` divides by the next factor or
    /// parenthesised group only; powers as `^2`, `²`, `^-1`.
    ///
    /// # Errors
    ///
    /// An unknown symbol, or not an expression.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        if text.len() > LONGEST {
            return Err(UnitError::TooLong(LONGEST));
        }
        let mut parser = Parser { rest: text.trim() };
        let unit = parser.product()?;
        if parser.rest.is_empty() {
            Ok(unit)
        } else {
            Err(parser.unexpected())
        }
    }

    fn times(self, other: Self, n: i32) -> Self {
        Self {
            factor: self.factor * other.factor.powi(n),
            dimension: self.dimension.times(other.dimension, n),
        }
    }
}

impl<'a> Measure<'a> {
    /// Reads a number and its unit.
    ///
    /// # Errors
    ///
    /// No number, a number that is not finite, or a unit that cannot be read.
    pub fn parse(text: &'a str) -> Result<Self, UnitError> {
        let text = text.trim();
        if text.len() > LONGEST {
            return Err(UnitError::TooLong(LONGEST));
        }
        let (digits, label) = text.split_at(number_length(text));
        let number: f64 = digits
            .parse()
            .map_err(|_| UnitError::NoNumber(text.to_owned()))?;
        let label = label.trim_start();
        let unit = if label.is_empty() {
            Unit::ONE
        } else {
            Unit::parse(label)?
        };
        // A number may be finite as written and leave the range of f64 in SI.
        if !(number * unit.factor).is_finite() {
            return Err(UnitError::NotFinite(text.to_owned()));
        }
        Ok(Self {
            number,
            label,
            unit,
        })
    }

    /// In SI base units.
    pub fn si(&self) -> f64 {
        self.number * self.unit.factor
    }
}

/// Length of the decimal number that `text` begins with, bytes.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let sign = |i: usize| i + usize::from(matches!(bytes.get(i), Some(b'+' | b'-')));
    let digits = |i: usize| {
        let tail = &bytes[i.min(bytes.len())..];
        i + tail.iter().take_while(|b| b.is_ascii_digit()).count()
    };
    let mut end = digits(sign(0));
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let first = sign(end + 1);
        let last = digits(first);
        if last > first {
            end = last;
        }
    }
    end
}

/// Characters with which a power without `^` begins.
const RAISED: [char; 5] = ['⁻', '¹', '²', '³', '⁴'];

struct Parser<'a> {
    rest: &'a str,
}

impl Parser<'_> {
    fn product(&mut self) -> Result<Unit, UnitError> {
        let mut unit = self.factor()?;
        loop {
            let apart = self.rest.trim_start();
            let n = match apart.chars().next() {
                None | Some(')') => {
                    self.rest = apart;
                    return Ok(unit);
                }
                Some('/') => -1,
                Some('*' | '·' | '⋅' | '(') => 1,
                // `m1` and `ft^2lbf` are no products.
                Some(_) if apart.len() == self.rest.len() => return Err(self.unexpected()),
                Some(_) => 1,
            };
            self.rest = apart;
            self.rest = self
                .rest
                .strip_prefix(['/', '*', '·', '⋅'])
                .unwrap_or(self.rest);
            unit = unit.times(self.factor()?, n);
        }
    }

    fn factor(&mut self) -> Result<Unit, UnitError> {
        self.rest = self.rest.trim_start();
        let base = if let Some(inside) = self.rest.strip_prefix('(') {
            self.rest = inside;
            let group = self.product()?;
            self.rest = self
                .rest
                .strip_prefix(')')
                .ok_or_else(|| self.unexpected())?;
            group
        } else {
            self.symbol()?
        };
        Ok(Unit::ONE.times(base, self.power()?))
    }

    fn symbol(&mut self) -> Result<Unit, UnitError> {
        let is_symbol = |c: char| c.is_alphabetic() || matches!(c, '°' | '_');
        let end = match self.rest.find(|c| !is_symbol(c)) {
            // `1/m`
            Some(0) if self.rest.starts_with('1') => 1,
            Some(0) => return Err(self.unexpected()),
            None if self.rest.is_empty() => return Err(self.unexpected()),
            end => end.unwrap_or(self.rest.len()),
        };
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        match symbol::find(name) {
            Some((factor, dimension)) => Ok(Unit { factor, dimension }),
            None if matches!(name, "lb" | "lbs") => Err(UnitError::Pound(name.to_owned())),
            None => Err(UnitError::Unknown {
                symbol: name.to_owned(),
                nearest: symbol::nearest(name),
            }),
        }
    }

    /// Exponent after a factor, of one digit; 1 where none is written.
    fn power(&mut self) -> Result<i32, UnitError> {
        let is_raised = self.rest.starts_with(RAISED);
        let (negative, rest) = if let Some(rest) = self.rest.strip_prefix('^') {
            let minus = rest.strip_prefix('-');
            (minus.is_some(), minus.unwrap_or(rest))
        } else if is_raised {
            let minus = self.rest.strip_prefix('⁻');
            (minus.is_some(), minus.unwrap_or(self.rest))
        } else {
            return Ok(1);
        };
        let mut chars = rest.chars();
        let power = match (chars.next(), is_raised) {
            (Some('1'), false) | (Some('¹'), true) => 1,
            (Some('2'), false) | (Some('²'), true) => 2,
            (Some('3'), false) | (Some('³'), true) => 3,
            (Some('4'), false) | (Some('⁴'), true) => 4,
            _ => return Err(self.unexpected()),
        };
        if chars.as_str().starts_with(|c: char| c.is_ascii_digit()) {
            return Err(self.unexpected());
        }
        self.rest = chars.as_str();
        Ok(if negative { -power } else { power })
    }

    fn unexpected(&self) -> UnitError {
        match self.rest {
            "" => UnitError::Syntax("the end".into()),
            rest => UnitError::Syntax(rest.to_owned()),
        }
    }
}
