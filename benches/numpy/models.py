"""The prototype passenger vehicle and its equations of motion, in SI units.

Every element is a pair of rows over [q, u]: where its force acts, and the stretch it feels. The
rows of all elements make up two matrices R and S; K = Rᵀ diag(k) S, and so on.
"""

import numpy as np

FT, LBF, G = 0.3048, 0.45359237 * 9.80665, 9.80665
SLUG = LBF / FT


class Prototype:
    """Table 4.1.1 of the report, at 110 mph on class 6 track."""

    speed = 110 * 1609.344 / 3600
    speeds = 5 * 1609.344 / 3600, 600 * 1609.344 / 3600
    band = 0.02, 50.0
    m_c, i_cx, i_cy, i_cz = (
        2860 * SLUG,
        76340 * SLUG * FT**2,
        1.764e6 * SLUG * FT**2,
        1.764e6 * SLUG * FT**2,
    )
    l_c, l_s, h_cs = 85 * FT, 29.75 * FT, 2.94 * FT
    flexible = ((7.1, 0.05), (12.0, 0.05), (24.0, 0.05))
    m_t, i_tx, i_ty, i_tz = 250 * SLUG, 2058 * SLUG * FT**2, 434 * SLUG * FT**2, 2486 * SLUG * FT**2
    b, d_p, d_s, h_tp, h_ts = 4.25 * FT, 2 * FT, 3.75 * FT, 0.35 * FT, 1.68 * FT
    m_w, i_wz, i_wy, r0, a = 120 * SLUG, 561 * SLUG * FT**2, 112 * SLUG * FT**2, 1.5 * FT, 2.35 * FT
    k_px, k_py, k_pz = 1e6 * LBF / FT, 5e5 * LBF / FT, 1.935e6 * LBF / FT
    k_sy, c_sy, k_sz, c_sz = 24e3 * LBF / FT, 1200 * LBF / FT, 22200 * LBF / FT, 2000 * LBF / FT
    k_spsi, t_spsi = 1e6 * LBF * FT, 7500 * LBF * FT
    p_x, p_y, h_p = 29.75 * FT, 3.75 * FT, -2.94 * FT
    # Wheel and rail at λ = 0.05, full Kalker.
    conicity, friction, clearance = 0.05, 0.2, 0.0127
    f11, f12, f22, f33 = 2.12e6 * LBF, 17500 * LBF * FT, 160 * LBF * FT**2, 2.3e6 * LBF
    a11, delta_0, delta = 0.05, 0.05, 0.0
    # FRA class 6 (3.4.2-2…4): A_v, A_a in m² rad/m, Ω_c, Ω_s in rad/m.
    a_v = a_a = 0.00159 * 0.0254**2 / FT
    omega_c, omega_s = 2 * np.pi / (25 * FT), 0.1335 / FT

    def __init__(self, **changes):
        for name, value in changes.items():
            setattr(self, name, value)

    @property
    def axle_load(self):
        return G * (self.m_c / 4 + self.m_t / 2 + self.m_w)

    def spectra(self, kind, omega):
        """S_a and S_c, or S_v and S_c, at wavenumbers Ω, rad/m."""
        w2, c2, s2 = omega * omega, self.omega_c**2, self.omega_s**2
        profile = {"lateral": self.a_a, "vertical": self.a_v}[kind] * c2 / (w2 * (w2 + c2))
        return np.stack([profile, 4 * self.a_v * c2 / ((w2 + c2) * (w2 + s2))])


class System:
    """M q̈ + C(V) q̇ + K q = −C_u(V) u̇ − K_u u with its outputs p·x and a·ẍ over x = [q, u]."""

    def __init__(self, mass, k, c0, c1, c2, displacement, acceleration, kind, roll):
        n = self.n = len(mass)
        self.mass, self.k, self.c0, self.c1, self.c2 = mass, k, c0, c1, c2
        self.displacement, self.acceleration = displacement, acceleration
        self.kind, self.roll = kind, roll
        # The parts of the state matrix A(V) = A0 + A1/V + A2 V.
        self.a0, self.a1, self.a2 = np.zeros((3, 2 * n, 2 * n))
        self.a0[:n, n:] = np.eye(n)
        self.a0[n:, :n] = -k[:, :n] / mass[:, None]
        for a, c in (self.a0, c0), (self.a1, c1), (self.a2, c2):
            a[n:, n:] = -c[:, :n] / mass[:, None]

    def damping(self, v):
        return self.c0 + self.c1 / v + self.c2 * v

    def state_matrix(self, v):
        return self.a0 + self.a1 / v + self.a2 * v


def lateral(p):
    """15 degrees of freedom: y_w1…4, ψ_w1…4, y_t1…2, ψ_t1…2, y_c, ψ_c, φ_c; y_a1…4, φ_x1…4."""
    row, stretch, phi_w, e = lateral_suspension(p)
    k, c = lateral_constants(p)
    n, w = 15, p.axle_load
    system_k = row.T @ (k[:, None] * stretch)
    c0 = row.T @ (c[:, None] * stretch)
    y, psi = slice(0, 4), slice(4, 8)
    i_psi = np.zeros((4, 23))
    i_psi[range(4), range(4, 8)] = 1
    i_y = np.zeros((4, 23))
    i_y[range(4), range(4)] = 1
    contact = i_y + p.r0 * p.a11 / p.a * e
    spin = -p.delta / (p.a * p.r0) * e
    c1, c2 = np.zeros((2, n, 23))
    c1[y] = 2 * p.f11 * contact + 2 * p.f12 * i_psi
    c1[psi] = (2 * p.a**2 * p.f33 + 2 * p.f22) * i_psi - 2 * p.f12 * contact
    system_k[y] += -2 * p.f11 * i_psi + 2 * p.f12 * spin + w / p.a * (p.a11 + p.delta) * e
    system_k[psi] += (
        2 * p.a * p.f33 * p.conicity / p.r0 * e
        + 2 * p.f12 * i_psi
        + 2 * p.f22 * spin
        - w * p.a * p.delta_0 * i_psi
    )
    c2[psi] = p.i_wy / p.r0 * phi_w
    mass = np.repeat([p.m_w, p.i_wz, p.m_t, p.i_tz, p.m_c, p.i_cz, p.i_cx], [4, 4, 2, 2, 1, 1, 1])
    acceleration = np.zeros((4, 15))
    acceleration[:3, 12] = 1
    acceleration[1:3, 13] = p.p_x, -p.p_x
    acceleration[:3, 14] = -p.h_p
    acceleration[3, 14] = 1
    displacement = np.vstack([stretch[8:10], stretch[:4], e, p.d_p * stretch[4:8]])
    return System(mass, system_k, c0, c1, c2, displacement, acceleration, "lateral", 1 / (2 * p.a))


def lateral_suspension(p):
    """Rows and stretches: primary lateral ×4, primary yaw ×4, secondary lateral ×2, roll ×2, yaw ×2,
    the carbody's weight; roll and excursion of the wheelsets."""
    row = np.zeros((15, 15))
    i, j = np.arange(4), np.array([0, 0, 1, 1])
    sign, end = np.array([1, -1, 1, -1]), np.array([1.0, -1.0])
    row[i, i], row[i, 8 + j], row[i, 10 + j] = -1, 1, sign * p.b
    row[4 + i, 4 + i], row[4 + i, 10 + j] = -1, 1
    t = np.arange(2)
    row[8 + t, 8 + t], row[8:10, 12], row[8 + t, 13], row[8:10, 14] = -1, 1, end * p.l_s, p.h_cs
    row[10:12, 14] = 1
    row[12:14, 13], row[12 + t, 10 + t] = 1, -1
    row[14, 14] = 1
    e = np.zeros((4, 23))
    e[i, i], e[i, 15 + i] = 1, -1
    phi_w = p.a11 / p.a * e
    phi_w[i, 19 + i] += 1
    phi_t = (phi_w[::2] + phi_w[1::2]) / 2
    stretch = np.zeros((15, 23))
    stretch[:, :15] = row
    stretch[:4] += p.h_tp * phi_t[j]
    stretch[8:10] += p.h_ts * phi_t
    stretch[10:12] -= phi_t
    return row, stretch, phi_w, e


def lateral_constants(p):
    k = np.repeat(
        [
            2 * p.k_py,
            2 * p.d_p**2 * p.k_px,
            2 * p.k_sy,
            2 * p.d_s**2 * p.k_sz,
            p.k_spsi,
            -p.m_c * G * p.h_cs,
        ],
        [4, 4, 2, 2, 2, 1],
    )
    c = k / 250
    c[8:10], c[10:12], c[14] = 2 * p.c_sy, 2 * p.d_s**2 * p.c_sz, 0
    return k, c


BETA_L = 4.730040744862704


def carbody_point(p, x, y):
    """w(x, y) over z_c, φ_c, θ_c, u_b, u_1, u_2; x and y are arrays."""
    xi = x / p.l_c
    bending = np.cosh(BETA_L * xi) / np.cosh(BETA_L / 2) + np.cos(BETA_L * xi) / np.cos(BETA_L / 2)
    torsion = np.sqrt(2) * y * np.array([np.sin(np.pi * xi), np.cos(2 * np.pi * xi)])
    return np.stack([np.ones_like(xi), y, -x, bending, *torsion], axis=-1)


def vertical(p):
    """12 degrees of freedom: z_c, φ_c, θ_c, u_b, u_1, u_2, (z_t, φ_t, θ_t)×2; z_v1…4, φ_x1…4."""
    row = np.zeros((12, 20))
    # Primary elements: wheelsets 1–4, left and right.
    i = np.arange(4)
    for side, y in enumerate((p.d_p, -p.d_p)):
        r, t = 4 * side + i, 6 + 3 * (i // 2)
        row[r, t], row[r, t + 1], row[r, t + 2] = 1, y, [-p.b, p.b, -p.b, p.b]
        row[r, 12 + i], row[r, 16 + i] = -1, -y
    # Secondary: leading left, trailing left, leading right, trailing right.
    x, y = np.array([1, -1, 1, -1]) * p.l_s, np.array([1, 1, -1, -1]) * p.d_s
    row[8:, :6] = carbody_point(p, x, y)
    t = 6 + 3 * np.array([0, 1, 0, 1])
    row[8 + i, t], row[8 + i, t + 1] = -1, -y
    k = np.repeat([p.k_pz, p.k_sz], [8, 4])
    c = np.repeat([p.k_pz / 250, p.c_sz], [8, 4])
    system_k = row[:, :12].T @ (k[:, None] * row)
    c0 = row[:, :12].T @ (c[:, None] * row)
    mass = np.array([p.m_c, p.i_cx, p.i_cy, p.m_c, p.i_cx, p.i_cx] + 2 * [p.m_t, p.i_tx, p.i_ty])
    f, zeta = np.array(p.flexible).T
    omega = 2 * np.pi * f
    flexible = range(3, 6)
    system_k[flexible, flexible] += mass[3:6] * omega**2
    c0[flexible, flexible] += 2 * zeta * omega * mass[3:6]
    acceleration = np.zeros((4, 12))
    acceleration[:3, :6] = carbody_point(
        p, np.array([0, p.p_x, -p.p_x]), np.array([0, p.p_y, p.p_y])
    )
    acceleration[3, 1] = 1
    displacement = np.vstack([row[8:10], row[:4]])
    none = np.zeros((12, 20))
    return System(
        mass, system_k, c0, none, none, displacement, acceleration, "vertical", 1 / (2 * p.a)
    )


def curving(p):
    """Stiffness without the secondary yaw elements, and the load per unit curvature."""
    row, stretch, _, _ = lateral_suspension(p)
    k, _ = lateral_constants(p)
    k[12:14] = 0
    sign, y, psi = np.array([1, -1, 1, -1]), np.arange(4), np.arange(4, 8)
    stiffness = row.T @ (k[:, None] * stretch[:, :15])
    stiffness[y, psi] -= 2 * p.f11
    stiffness[y, y] += p.axle_load / p.a * (p.a11 + p.delta) - 2 * p.f12 * p.delta / (p.a * p.r0)
    stiffness[psi, y] += 2 * p.a * p.f33 * p.conicity / p.r0 - 2 * p.f22 * p.delta / (p.a * p.r0)
    stiffness[psi, psi] += 2 * p.f12 - p.axle_load * p.a * p.delta_0
    offset = np.zeros(15)
    offset[:4], offset[4:8], offset[8:10] = p.b**2 / 2, sign * p.b, p.l_s**2 / 2
    load = -row.T @ (k * offset)
    load[y] += 2 * p.f12
    load[psi] += 2 * p.a**2 * p.f33 + 2 * p.f22
    return stiffness, load
