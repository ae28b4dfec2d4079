//! One-third-octave bands, exact in base ten (IEC 61260): centres 10^(n/10) Hz.

/// Lowest band that is resolved, n of 10^(n/10): 0.5 Hz.
const LOWEST: i32 = -3;
/// Highest band worth resolving: 100 Hz.
const HIGHEST: i32 = 20;
/// Below the lowest band the spectrum is divided only for the sake of integration, Hz.
const COARSE: [f64; 4] = [0.04, 0.08, 0.16, 0.28];

/// Edge between bands n − 1 and n, Hz.
fn edge(n: i32) -> f64 {
    10_f64.powf((f64::from(n) - 0.5) / 10.0)
}

/// Ascending frequencies from `low` to `high` with every band edge between them.
pub fn edges_between(low: f64, high: f64) -> Vec<f64> {
    let inner = COARSE.into_iter().chain((LOWEST..=HIGHEST + 1).map(edge));
    let mut edges = vec![low];
    edges.extend(inner.filter(|&f| f > low && f < high));
    edges.push(high);
    edges
}

/// Centre of the band with these edges, Hz; `None` if they are not those of a band.
pub fn centre_of(low: f64, high: f64) -> Option<f64> {
    let n = (LOWEST..=HIGHEST).find(|&n| (edge(n) / low - 1.0).abs() < 1e-9)?;
    ((edge(n + 1) / high - 1.0).abs() < 1e-9).then(|| 10_f64.powf(f64::from(n) / 10.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_bands_only() {
        let edges = edges_between(0.02, 50.0);
        assert!(edges.windows(2).all(|w| w[0] < w[1]));
        let centres: Vec<f64> = edges
            .windows(2)
            .filter_map(|w| centre_of(w[0], w[1]))
            .collect();
        // 0.5 … 40 Hz: the 50 Hz band reaches beyond 50 Hz.
        assert_eq!(centres.len(), 20);
        assert!((centres[3] - 1.0).abs() < 1e-12 && (centres[19] - 39.81).abs() < 0.01);
        assert_eq!(edges_between(1.0, 1.05), [1.0, 1.05]);
    }
}
