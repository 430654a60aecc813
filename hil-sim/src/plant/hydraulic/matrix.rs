//! Symmetric 3 × 3 matrices: what the chain of boom, arm and bucket needs.

use kinematics_core::Vec2;

/// Diagonal, and the entries (0,1), (0,2), (1,2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sym3 {
    pub(super) d: [f64; 3],
    pub(super) o: [f64; 3],
}

impl Sym3 {
    pub(super) fn times(&self, v: [f64; 3]) -> [f64; 3] {
        let ([a, b, c], [ab, ac, bc]) = (self.d, self.o);
        [a * v[0] + ab * v[1] + ac * v[2], ab * v[0] + b * v[1] + bc * v[2], ac * v[0] + bc * v[1] + c * v[2]]
    }

    /// Adds `by`·JᵀJ, the columns of J turning these levers.
    pub(super) fn add_tip(&mut self, levers: [Vec2<f64>; 3], by: f64) {
        let [a, b, c] = levers;
        self.d =
            [self.d[0] + by * a.norm_squared(), self.d[1] + by * b.norm_squared(), self.d[2] + by * c.norm_squared()];
        self.o = [self.o[0] + by * a.dot(b), self.o[1] + by * a.dot(c), self.o[2] + by * b.dot(c)];
    }

    /// From absolute to relative angles.
    pub(super) fn relative(&self) -> Self {
        let ([a, b, c], [ab, ac, bc]) = (self.d, self.o);
        let outer = b + c + 2.0 * bc;
        Self { d: [a + 2.0 * (ab + ac) + outer, outer, c], o: [ab + ac + outer, ac + bc + c, bc + c] }
    }
}

/// A·x = right for a positive definite A, by elimination.
pub(super) fn solve(matrix: &Sym3, right: [f64; 3]) -> [f64; 3] {
    let ([a, b, c], [ab, ac, bc]) = (matrix.d, matrix.o);
    let (l1, l2) = (ab / a, ac / a);
    let (b, bc) = (b - l1 * ab, bc - l1 * ac);
    let l3 = bc / b;
    let c = c - l2 * ac - l3 * bc;
    let y1 = right[1] - l1 * right[0];
    let z = (right[2] - l2 * right[0] - l3 * y1) / c;
    let y = y1 / b - l3 * z;
    [right[0] / a - l1 * y - l2 * z, y, z]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_solved_gives_the_right_side_again() {
        let m = Sym3 { d: [5.0, 4.0, 3.0], o: [1.0, -0.5, 0.7] };
        let x = solve(&m, [1.0, 2.0, 3.0]);
        for (found, wanted) in m.times(x).into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - wanted).abs() < 1e-14);
        }
    }

    #[test]
    fn relative_and_absolute_angles_have_the_same_energy() {
        let m = Sym3 { d: [5.0, 4.0, 3.0], o: [1.0, -0.5, 0.7] };
        let energy = |m: Sym3, w: [f64; 3]| m.times(w).iter().zip(w).map(|(a, b)| a * b).sum::<f64>();
        let relative = [0.3, -0.8, 1.1];
        assert!((energy(m, [0.3, -0.5, 0.6]) - energy(m.relative(), relative)).abs() < 1e-14);
    }
}
