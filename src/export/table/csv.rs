//! A table as CSV.

use std::io;

use csv::{IntoInnerError, Writer};

use super::{Column, Table};

impl Table {
    /// As CSV: a header line and a line per row, ended by `\n`, quoted as in RFC 4180 where needed.
    ///
    /// Numbers have the fewest digits that read back as the same `f64`, without powers of ten;
    /// no value is an empty field.
    pub fn csv(&self) -> String {
        if self.columns.is_empty() {
            return String::new();
        }
        lines(self).unwrap_or_else(|error| unreachable!("text in memory: {error}"))
    }
}

fn lines(table: &Table) -> csv::Result<String> {
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(table.columns().map(|(name, _)| name))?;
    for i in 0..table.rows() {
        writer.write_record(table.columns().map(|(_, column)| field(column, i)))?;
    }
    let bytes = writer.into_inner().map_err(IntoInnerError::into_error)?;
    Ok(String::from_utf8(bytes).map_err(io::Error::other)?)
}

fn field(column: &Column, row: usize) -> String {
    match column {
        Column::Number(values) => values[row].map_or(String::new(), |x| x.to_string()),
        Column::Count(values) => values[row].to_string(),
        Column::Text(values) => values[row].clone(),
    }
}

#[cfg(test)]
mod tests {
    use csv::Reader;

    use super::super::{Column, Table, sample};

    #[test]
    fn reads_back_bit_for_bit() {
        let table = sample();
        let text = table.csv();
        let mut reader = Reader::from_reader(text.as_bytes());
        let names: Vec<_> = table.columns().map(|(name, _)| name).collect();
        assert_eq!(reader.headers().unwrap(), names);
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(records.len(), table.rows());
        for (i, record) in records.iter().enumerate() {
            for ((_, column), field) in table.columns().zip(record) {
                match column {
                    Column::Number(values) => assert_eq!(
                        (!field.is_empty()).then(|| field.parse::<f64>().unwrap().to_bits()),
                        values[i].map(f64::to_bits)
                    ),
                    Column::Count(values) => assert_eq!(field.parse(), Ok(values[i])),
                    Column::Text(values) => assert_eq!(field, values[i]),
                }
            }
        }
    }

    #[test]
    fn quotes_and_empty_fields() {
        let mut table = Table::new();
        table.text("a,b", ["say \"x\"", "1\n2", "plain"]);
        table.number("x", [Some(0.1), None, Some(1e-7)]);
        assert_eq!(
            table.csv(),
            "\"a,b\",x\n\"say \"\"x\"\"\",0.1\n\"1\n2\",\nplain,0.0000001\n"
        );
    }

    #[test]
    fn no_value_alone_in_its_row() {
        let mut table = Table::new();
        table.number("x", [None, Some(2.0)]);
        assert_eq!(table.csv(), "x\n\"\"\n2\n");
        assert_eq!(Table::new().csv(), "");
    }
}
