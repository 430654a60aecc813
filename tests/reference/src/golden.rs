//! The golden values in `tests/data/golden`.

use std::path::PathBuf;

/// A golden file: its header and its rows of numbers.
#[derive(Clone, Debug)]
pub struct Golden {
    columns: Vec<String>,
    /// All rows, each as long as the header.
    pub rows: Vec<Vec<f64>>,
}

impl Golden {
    /// Reads `tests/data/golden/NAME.csv`.
    ///
    /// # Panics
    /// When the file is missing, a cell is no number, or there are no rows: a test over nothing would pass.
    pub fn read(name: &str) -> Self {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../data/golden/{name}.csv"));
        let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let columns = reader.headers().unwrap().iter().map(str::to_owned).collect();
        let rows: Vec<Vec<f64>> = reader.deserialize().map(|row| row.unwrap()).collect();
        assert!(!rows.is_empty(), "{} has no rows", path.display());
        Self { columns, rows }
    }

    /// The named columns of every row.
    ///
    /// # Panics
    /// When a column is missing.
    pub fn columns<const N: usize>(&self, names: [&str; N]) -> Vec<[f64; N]> {
        let indices = names.map(|name| {
            self.columns.iter().position(|column| column == name).unwrap_or_else(|| panic!("no column {name}"))
        });
        self.rows.iter().map(|row| indices.map(|index| row[index])).collect()
    }
}
