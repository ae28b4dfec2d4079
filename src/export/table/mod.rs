//! Flat tables of results, written as CSV, JSON and Parquet.
//!
//! ```
//! use bogie::export::table::Table;
//!
//! let mut table = Table::new();
//! table.text("limit", ["slip", "flange"]);
//! table.number("degree_curve_deg", [Some(1.5), None]);
//! assert_eq!(table.csv(), "limit,degree_curve_deg\nslip,1.5\nflange,\n");
//! ```

mod csv;
mod json;
#[cfg(feature = "parquet")]
mod parquet;

#[cfg(feature = "parquet")]
pub use self::parquet::TableError;

/// The values of one column.
#[derive(Debug, Clone, PartialEq)]
pub enum Column {
    /// Finite numbers; `None`: there is no value.
    Number(Vec<Option<f64>>),
    /// Counts and other whole numbers.
    Count(Vec<u64>),
    /// Text.
    Text(Vec<String>),
}

impl Column {
    fn rows(&self) -> usize {
        match self {
            Self::Number(values) => values.len(),
            Self::Count(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }
}

/// Columns of equal length under different names, in order.
///
/// A name carries the unit, as in `degree_curve_deg`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    columns: Vec<(String, Column)>,
    metadata: Vec<(String, String)>,
}

impl Table {
    /// A table without columns.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a column of numbers, `f64` or `Option<f64>`. What is not finite becomes `None`.
    ///
    /// # Panics
    ///
    /// If the number of values differs from that of the other columns, or the name is taken.
    pub fn number<V: Into<Option<f64>>>(
        &mut self,
        name: impl Into<String>,
        values: impl IntoIterator<Item = V>,
    ) {
        let finite = |value: V| value.into().filter(|x| x.is_finite());
        self.add(
            name.into(),
            Column::Number(values.into_iter().map(finite).collect()),
        );
    }

    /// Adds a column of counts.
    ///
    /// # Panics
    ///
    /// As [`Self::number`].
    pub fn count(&mut self, name: impl Into<String>, values: impl IntoIterator<Item = u64>) {
        self.add(name.into(), Column::Count(values.into_iter().collect()));
    }

    /// Adds a column of text.
    ///
    /// # Panics
    ///
    /// As [`Self::number`].
    pub fn text<V: Into<String>>(
        &mut self,
        name: impl Into<String>,
        values: impl IntoIterator<Item = V>,
    ) {
        self.add(
            name.into(),
            Column::Text(values.into_iter().map(Into::into).collect()),
        );
    }

    fn add(&mut self, name: String, column: Column) {
        if !self.columns.is_empty() {
            assert_eq!(column.rows(), self.rows(), "rows of column `{name}`");
        }
        assert!(
            self.columns.iter().all(|(other, _)| *other != name),
            "two columns `{name}`"
        );
        self.columns.push((name, column));
    }

    /// Says something about the whole table, such as the program that wrote it. A key given again
    /// gets the new value. Only Parquet files hold it.
    pub fn metadata(&mut self, key: impl Into<String>, value: impl Into<String>) {
        let (key, value) = (key.into(), value.into());
        match self.metadata.iter_mut().find(|(k, _)| *k == key) {
            Some((_, old)) => *old = value,
            None => self.metadata.push((key, value)),
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.rows())
    }

    /// Names and columns in order.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &Column)> {
        self.columns.iter().map(|(name, c)| (name.as_str(), c))
    }
}

/// A table with all that is awkward in some format.
#[cfg(test)]
fn sample() -> Table {
    let mut table = Table::new();
    table.text(
        "name, \"quoted\"",
        ["plain", "a,b", "a \"b\"", "two\nlines", "µ — °\r", ""],
    );
    table.number(
        "wheel_rail.conicity",
        [
            Some(0.1 + 0.2),
            None,
            Some(-0.0),
            Some(5e-324),
            Some(f64::MAX),
            Some(f64::NAN),
        ],
    );
    table.count("evaluations", [0, 1, u64::MAX, 1 << 53, 7, 8]);
    table.number(
        "speed_m_per_s",
        [1.0, 2.0, 1.0 / 3.0, f64::INFINITY, 5.0, 6.0],
    );
    table.metadata("program", "bogie");
    table.metadata("version", "0");
    table.metadata("version", "1");
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_no_value() {
        let mut table = Table::new();
        table.number("x", [f64::NAN, f64::INFINITY, -f64::INFINITY, 1.0]);
        let (name, column) = table.columns().next().unwrap();
        assert_eq!(name, "x");
        assert_eq!(column, &Column::Number(vec![None, None, None, Some(1.0)]));
        assert_eq!(table.rows(), 4);
    }

    #[test]
    #[should_panic(expected = "rows of column `y`")]
    fn unequal_lengths() {
        let mut table = Table::new();
        table.number("x", [1.0, 2.0]);
        table.count("y", [1]);
    }

    #[test]
    #[should_panic(expected = "two columns `x`")]
    fn one_name_twice() {
        let mut table = Table::new();
        table.number("x", [1.0]);
        table.text("x", ["a"]);
    }
}
