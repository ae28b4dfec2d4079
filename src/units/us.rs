//! US customary units in SI, exact (NIST SP 811).

/// Foot, m.
pub const FOOT: f64 = 0.3048;
/// Inch, m.
pub const INCH: f64 = 0.0254;
/// Statute mile, m.
pub const MILE: f64 = 1609.344;
/// Avoirdupois pound (mass), kg.
pub const LBM: f64 = 0.453_592_37;
/// Pound-force, N.
pub const LBF: f64 = LBM * 9.806_65;
/// Slug, kg: the mass that one pound-force accelerates by 1 ft/s².
pub const SLUG: f64 = LBF / FOOT;
