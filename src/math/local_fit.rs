//! Local fit of a polynomial of fourth degree by least squares, with weights (1 - s²)².
//!
//! The polynomials are made orthogonal on the places of the samples by a recurrence (Forsythe 1957).
//! It takes no memory.

/// Degree of the polynomial.
const DEGREE: usize = 4;

/// Polynomials that are orthogonal on places between -1 and 1.
pub struct LocalFit {
    middles: [f64; DEGREE + 1],
    shares: [f64; DEGREE + 1],
    norms: [f64; DEGREE + 1],
    /// Their values at 0.
    here: [f64; DEGREE + 1],
}

impl LocalFit {
    /// For samples at these places.
    pub fn on(places: impl Iterator<Item = f64> + Clone) -> LocalFit {
        let [middles, shares, norms, here] = [[0.0; DEGREE + 1]; 4];
        let mut all = LocalFit { middles, shares, norms, here };
        for degree in 0..=DEGREE {
            let [norm, moment] = places.clone().fold([0.0; 2], |[norm, moment], s| {
                let part = count(s) * all.at(s)[degree].powi(2);
                [norm + part, moment + s * part]
            });
            all.middles[degree] = moment / norm;
            all.shares[degree] = degree.checked_sub(1).map_or(0.0, |last| norm / all.norms[last]);
            all.norms[degree] = norm;
        }
        all.here = all.at(0.0);
        all
    }

    /// All of them at a place.
    fn at(&self, s: f64) -> [f64; DEGREE + 1] {
        let mut values = [1.0; DEGREE + 1];
        let mut last = 0.0;
        for degree in 0..DEGREE {
            let now = values[degree];
            values[degree + 1] = (s - self.middles[degree]) * now - self.shares[degree] * last;
            last = now;
        }
        values
    }

    /// The weight of the sample at `s` in the value at 0 of the sum of polynomials with the least
    /// Σ (1 - s²)² δ².
    pub fn weight(&self, s: f64) -> f64 {
        let terms = self.here.into_iter().zip(self.at(s)).zip(self.norms);
        count(s) * terms.map(|((here, there), norm)| here * there / norm).sum::<f64>()
    }
}

fn count(s: f64) -> f64 {
    (1.0 - s * s).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_its_degree_is_met() {
        let places: Vec<f64> = (0..23).map(|k| -0.97 + 0.085 * f64::from(k)).collect();
        let of = |s: f64| 2.0 - s * (0.3 + s * (1.5 - s * (0.7 - 3.0 * s)));
        let fit = LocalFit::on(places.iter().copied());
        let value: f64 = places.iter().map(|&s| fit.weight(s) * of(s)).sum();
        assert!((value - 2.0).abs() < 1e-12, "{value}");
        let sixth: f64 = places.iter().map(|&s| fit.weight(s) * s.powi(6)).sum();
        assert!(sixth.abs() > 1e-3, "{sixth}");
    }
}
