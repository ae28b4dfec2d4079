//! A table as Parquet.

use std::sync::Arc;

use parquet::{
    basic::{LogicalType, Repetition, Type as Physical},
    data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type},
    errors::{ParquetError, Result},
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        writer::{SerializedColumnWriter, SerializedFileWriter},
    },
    schema::types::{Type, TypePtr},
};

use super::{Column, Table};

/// A table cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// Parquet has no files without columns.
    #[error("a Parquet file needs at least one column")]
    NoColumns,
    /// From the Parquet library.
    #[error(transparent)]
    Parquet(#[from] ParquetError),
}

impl Table {
    /// As an uncompressed Parquet file with the metadata as key-value pairs; the same table gives
    /// the same bytes.
    ///
    /// Numbers are optional DOUBLE, counts INT64 (unsigned), text BYTE_ARRAY (STRING).
    ///
    /// # Errors
    ///
    /// [`TableError`] if there are no columns, or one value is too long for the format.
    pub fn parquet(&self) -> std::result::Result<Vec<u8>, TableError> {
        if self.columns.is_empty() {
            return Err(TableError::NoColumns);
        }
        Ok(file(self)?)
    }
}

fn file(table: &Table) -> Result<Vec<u8>> {
    let fields = table.columns().map(|(name, column)| field(name, column));
    let schema = Type::group_type_builder("schema")
        .with_fields(fields.collect::<Result<_>>()?)
        .build()?;
    let metadata: Vec<_> = table
        .metadata
        .iter()
        .map(|(key, value)| KeyValue::new(key.clone(), value.clone()))
        .collect();
    let properties = WriterProperties::builder()
        .set_key_value_metadata((!metadata.is_empty()).then_some(metadata))
        .build();
    let mut file = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    for (_, column) in table.columns() {
        if let Some(writer) = group.next_column()? {
            write(writer, column)?;
        }
    }
    group.close()?;
    file.into_inner()
}

fn field(name: &str, column: &Column) -> Result<TypePtr> {
    let (physical, logical, repetition) = match column {
        Column::Number(_) => (Physical::DOUBLE, None, Repetition::OPTIONAL),
        Column::Count(_) => (
            Physical::INT64,
            Some(LogicalType::integer(64, false)),
            Repetition::REQUIRED,
        ),
        Column::Text(_) => (
            Physical::BYTE_ARRAY,
            Some(LogicalType::String),
            Repetition::REQUIRED,
        ),
    };
    let field = Type::primitive_type_builder(name, physical)
        .with_logical_type(logical)
        .with_repetition(repetition)
        .build()?;
    Ok(Arc::new(field))
}

fn write(mut writer: SerializedColumnWriter<'_>, column: &Column) -> Result<()> {
    match column {
        Column::Number(values) => {
            let present: Vec<f64> = values.iter().copied().flatten().collect();
            let levels: Vec<i16> = values.iter().map(|x| x.is_some().into()).collect();
            writer
                .typed::<DoubleType>()
                .write_batch(&present, Some(&levels), None)?;
        }
        Column::Count(values) => {
            let values: Vec<i64> = values.iter().map(|n| n.cast_signed()).collect();
            writer
                .typed::<Int64Type>()
                .write_batch(&values, None, None)?;
        }
        Column::Text(values) => {
            let values: Vec<ByteArray> = values.iter().map(|s| s.as_str().into()).collect();
            writer
                .typed::<ByteArrayType>()
                .write_batch(&values, None, None)?;
        }
    }
    writer.close()
}

#[cfg(test)]
mod tests {
    use std::{fs::File, io::Write};

    use parquet::{
        file::reader::{FileReader, SerializedFileReader},
        record::{Field, Row},
    };

    use super::{
        super::{Column, Table, sample},
        TableError,
    };

    fn reader(table: &Table) -> SerializedFileReader<File> {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&table.parquet().unwrap()).unwrap();
        SerializedFileReader::new(file).unwrap()
    }

    #[test]
    fn reads_back_bit_for_bit() {
        let table = sample();
        let reader = reader(&table);
        let rows: Vec<Row> = reader
            .get_row_iter(None)
            .unwrap()
            .map(Result::unwrap)
            .collect();
        assert_eq!(rows.len(), table.rows());
        for (i, row) in rows.iter().enumerate() {
            assert_eq!(row.len(), table.columns().count());
            for ((name, column), (read_name, field)) in table.columns().zip(row.get_column_iter()) {
                assert_eq!(name, read_name);
                match (column, field) {
                    (Column::Number(values), Field::Double(x)) => {
                        assert_eq!(values[i].map(f64::to_bits), Some(x.to_bits()));
                    }
                    (Column::Number(values), Field::Null) => assert_eq!(values[i], None),
                    (Column::Count(values), Field::ULong(n)) => assert_eq!(values[i], *n),
                    (Column::Text(values), Field::Str(s)) => assert_eq!(&values[i], s),
                    other => panic!("{other:?}"),
                }
            }
        }
    }

    #[test]
    fn metadata_reads_back() {
        let pairs = |table: &Table| {
            let reader = reader(table);
            let pairs = reader.metadata().file_metadata().key_value_metadata();
            pairs.map(|pairs| {
                pairs
                    .iter()
                    .map(|p| (p.key.clone(), p.value.clone().unwrap()))
                    .collect::<Vec<_>>()
            })
        };
        let table = sample();
        assert_eq!(
            pairs(&table).unwrap(),
            [("program", "bogie"), ("version", "1")]
                .map(|(key, value)| (key.to_string(), value.to_string()))
        );
        let mut bare = Table::new();
        bare.count("n", [1]);
        assert_eq!(pairs(&bare), None);
    }

    #[test]
    fn same_table_same_bytes() {
        let bytes = sample().parquet().unwrap();
        for _ in 0..5 {
            assert_eq!(sample().parquet().unwrap(), bytes);
        }
    }

    #[test]
    fn without_rows_or_columns() {
        let mut table = Table::new();
        assert!(matches!(table.parquet(), Err(TableError::NoColumns)));
        table.text("a", [""; 0]);
        table.number("b", [0.0; 0]);
        assert_eq!(reader(&table).get_row_iter(None).unwrap().count(), 0);
    }
}
