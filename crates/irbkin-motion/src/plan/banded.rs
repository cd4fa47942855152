//! Linear equations of unknowns that are coupled to near ones only: a banded Cholesky factorization
//! (Golub, Van Loan, Matrix Computations, section 4.3.5).

use crate::prelude::*;

/// A symmetric positive definite matrix, its lower band by rows.
pub(super) struct Banded {
    /// Width of the band below the diagonal.
    width: usize,
    /// Of each row: the elements from column `row - width` to the diagonal.
    rows: Vec<f64>,
}

impl Banded {
    /// Zeros.
    pub(super) fn new(size: usize, width: usize) -> Self {
        Self { width, rows: vec![0.0; size * (width + 1)] }
    }

    fn at(&self, row: usize, column: usize) -> usize {
        row * (self.width + 1) + self.width + column - row
    }

    /// Add to an element on or below the diagonal.
    pub(super) fn add(&mut self, [row, column]: [usize; 2], amount: f64) {
        let at = self.at(row, column);
        self.rows[at] += amount;
    }

    /// Solve for a right-hand side in place; `false` if the matrix is not positive definite.
    pub(super) fn solve(mut self, x: &mut [f64]) -> bool {
        let width = self.width;
        for row in 0..x.len() {
            let first = row.saturating_sub(width);
            for column in first..=row {
                let start = first.max(column.saturating_sub(width));
                let (own, other) = (self.at(row, start), self.at(column, start));
                let count = column - start;
                let known = self.rows[own..own + count].iter();
                let dot: f64 =
                    known.zip(&self.rows[other..other + count]).map(|(a, b)| a * b).sum();
                let at = self.at(row, column);
                let rest = self.rows[at] - dot;
                self.rows[at] = if column < row {
                    rest / self.rows[self.at(column, column)]
                } else if rest > 0.0 {
                    rest.sqrt()
                } else {
                    return false;
                };
            }
            let from = self.at(row, first);
            let known = self.rows[from..from + row - first].iter();
            let dot: f64 = known.zip(&x[first..row]).map(|(a, b)| a * b).sum();
            x[row] = (x[row] - dot) / self.rows[self.at(row, row)];
        }
        for row in (0..x.len()).rev() {
            x[row] /= self.rows[self.at(row, row)];
            for column in row.saturating_sub(width)..row {
                x[column] -= self.rows[self.at(row, column)] * x[row];
            }
        }
        true
    }
}
