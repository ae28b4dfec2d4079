//! A table as JSON.

use serde_json::{Map, Value, json};

use super::{Column, Table};

impl Table {
    /// As JSON: an array of rows, each an object with the columns' names as keys, in order.
    /// No value is `null`.
    pub fn json(&self) -> Value {
        (0..self.rows()).map(|i| self.row(i)).collect()
    }

    /// As JSON Lines: the objects of [`Self::json`], one a line.
    pub fn json_lines(&self) -> String {
        let line = |i| Value::Object(self.row(i)).to_string() + "\n";
        (0..self.rows()).map(line).collect()
    }

    fn row(&self, i: usize) -> Map<String, Value> {
        self.columns
            .iter()
            .map(|(name, column)| (name.clone(), cell(column, i)))
            .collect()
    }
}

fn cell(column: &Column, row: usize) -> Value {
    match column {
        Column::Number(values) => json!(values[row]),
        Column::Count(values) => json!(values[row]),
        Column::Text(values) => json!(values[row]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Table, sample};
    use serde_json::json;

    #[test]
    fn rows_in_order_with_nulls() {
        let rows = sample().json();
        assert_eq!(rows.as_array().unwrap().len(), 6);
        assert_eq!(
            rows[0].to_string(),
            r#"{"name, \"quoted\"":"plain","wheel_rail.conicity":0.30000000000000004,"evaluations":0,"speed_m_per_s":1.0}"#
        );
        assert_eq!(rows[1]["wheel_rail.conicity"], json!(null));
        assert_eq!(rows[5]["wheel_rail.conicity"], json!(null));
        assert_eq!(rows[2]["evaluations"], json!(u64::MAX));
        assert_eq!(Table::new().json(), json!([]));
    }
}
