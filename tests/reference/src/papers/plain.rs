//! Small matrices in plain f64: products that are refused where the shapes do not fit, inverses, pseudo-inverses.

/// A matrix of rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix(pub Vec<Vec<f64>>);

impl Matrix {
    /// A column.
    pub fn column(values: &[f64]) -> Self {
        Self(values.iter().map(|&v| vec![v]).collect())
    }

    /// The identity.
    pub fn identity(n: usize) -> Self {
        Self((0..n).map(|i| (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect()).collect())
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.0.len(), self.0.first().map_or(0, Vec::len))
    }

    /// The product, or `None` where it has no meaning.
    pub fn times(&self, other: &Self) -> Option<Self> {
        if self.shape().1 != other.shape().0 {
            return None;
        }
        let columns = other.shape().1;
        let entry = |row: &Vec<f64>, j: usize| row.iter().zip(&other.0).map(|(a, b)| a * b[j]).sum();
        Some(Self(self.0.iter().map(|row| (0..columns).map(|j| entry(row, j)).collect()).collect()))
    }

    /// The sum of this and `by` times another, or `None` where the shapes differ.
    pub fn plus(&self, by: f64, other: &Self) -> Option<Self> {
        let add = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a + by * b).collect();
        (self.shape() == other.shape()).then(|| Self(self.0.iter().zip(&other.0).map(add).collect()))
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        Self((0..self.shape().1).map(|j| self.0.iter().map(|row| row[j]).collect()).collect())
    }

    /// The inverse by Gauss–Jordan elimination with pivoting, or `None` where there is none.
    pub fn inverse(&self) -> Option<Self> {
        let (n, columns) = self.shape();
        if n != columns {
            return None;
        }
        let (mut left, mut right) = (self.clone(), Self::identity(n));
        for i in 0..n {
            let pivot = (i..n).max_by(|&a, &b| left.0[a][i].abs().total_cmp(&left.0[b][i].abs()))?;
            left.0.swap(i, pivot);
            right.0.swap(i, pivot);
            let scale = left.0[i][i];
            if scale.abs() < 1e-12 {
                return None;
            }
            for matrix in [&mut left, &mut right] {
                matrix.0[i].iter_mut().for_each(|x| *x /= scale);
            }
            for row in (0..n).filter(|&row| row != i) {
                let factor = left.0[row][i];
                for matrix in [&mut left, &mut right] {
                    let by = matrix.0[i].clone();
                    matrix.0[row].iter_mut().zip(by).for_each(|(x, y)| *x -= factor * y);
                }
            }
        }
        Some(right)
    }

    /// The right pseudo-inverse Jᵀ(JJᵀ)⁻¹ of a matrix of full row rank.
    pub fn right_inverse(&self) -> Option<Self> {
        let transpose = self.transpose();
        transpose.times(&self.times(&transpose)?.inverse()?)
    }

    /// The largest absolute entry.
    pub fn largest(&self) -> f64 {
        self.0.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()))
    }

    /// The entries of a column.
    pub fn entries(&self) -> Vec<f64> {
        self.0.iter().flatten().copied().collect()
    }
}
