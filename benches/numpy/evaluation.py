"""One evaluation of a design with NumPy, written for speed."""

import math

import numpy as np

from models import FT, Prototype, curving

# Speeds at which the whole spectrum is looked at, from the lowest upwards: as many as bogie's own
# search by full spectra takes. That nothing hunts at these is all the certificate there is. One
# after the other: to stop at the first that hunts saves more than a batch of all would.
SPEEDS = 20
# Points of the Gauss–Legendre rule in a panel, and the panels: no pole within the ellipse of this
# size around a panel, ends at most in this ratio, at most this phase between first and last
# wheelset over half a panel. The fewest points of many such rules that leave RMS values to 4e-7.
POINTS, CLEARANCE, RATIO, PHASE = 10, 1.3, 3.0, 7.0
NODES, WEIGHTS = np.polynomial.legendre.leggauss(POINTS)
MAX_DEGREE = 25.0


def critical_speed(system, speeds):
    """The lowest speed at which a mode loses its damping, m/s; None if none does."""
    low, high = speeds
    grid = low * (high / low) ** (np.arange(SPEEDS) / (SPEEDS - 1))
    last = None
    for v in grid:
        s = np.linalg.eigvals(system.state_matrix(v))
        top = s.real.max()
        if top >= 0:
            break
        last = v, top
    else:
        return None
    if last is None:
        return low
    for _ in range(20):
        guess = last[0] + (v - last[0]) * last[1] / (last[1] - top)
        found = hopf(system, guess)
        below = found * (1 - 1e-4)
        s = np.linalg.eigvals(system.state_matrix(below)).real.max()
        if s < 0 and last[0] < found <= v:
            return found
        # Another mode is first: it is unstable already here, or the guess was too far off.
        if s >= 0 and last[0] < below < v:
            v, top = below, s
        else:
            v_mid = 0.5 * (last[0] + v)
            s = np.linalg.eigvals(system.state_matrix(v_mid)).real.max()
            last, v, top = ((v_mid, s), v, top) if s < 0 else (last, v_mid, s)
    raise ArithmeticError("no onset found in a bracket")


def hopf(system, v):
    """The speed near v at which the least damped mode has Re s = 0, by Newton's method on the
    bordered system [[D(iω, V), b], [cᴴ, 0]] [x, f] = [0, 1], with f = 0 at an eigenvalue."""
    n = system.n
    values, vectors = np.linalg.eig(system.state_matrix(v))
    k = np.argmax(np.where(values.imag > 0, values.real, -np.inf))
    omega = values[k].imag
    x = vectors[:n, k]
    x = x / np.linalg.norm(x)
    stiffness = system.k[:, :n]
    c0, c1, c2 = (c[:, :n] for c in (system.c0, system.c1, system.c2))
    # Equations divided by the masses, so that the unknowns are of one size.
    inverse = 1 / system.mass[:, None]
    kk, c0, c1, c2 = stiffness * inverse, c0 * inverse, c1 * inverse, c2 * inverse
    eye = np.eye(n)
    bordered = np.zeros((2, n + 1, n + 1), complex)
    right = np.zeros((2, n + 1, 1), complex)
    right[:, n] = 1
    left = None
    for _ in range(30):
        d = kk - omega**2 * eye + 1j * omega * (c0 + c1 / v + c2 * v)
        if left is None:
            left = np.linalg.solve(d.conj().T, x)
            left /= np.linalg.norm(left)
        bordered[0, :n, :n], bordered[0, :n, n], bordered[0, n, :n] = d, left, x.conj()
        bordered[1] = bordered[0].conj().T
        solution = np.linalg.solve(bordered, right)[..., 0]
        (right_vector, f), left_vector = (solution[0, :n], solution[0, n]), solution[1, :n].conj()
        by_omega = -left_vector @ (
            1j * (c0 + c1 / v + c2 * v) @ right_vector - 2 * omega * right_vector
        )
        by_speed = -left_vector @ (1j * omega * (c2 - c1 / v**2) @ right_vector)
        # f + f_ω dω + f_V dV = 0 in real and imaginary parts.
        determinant = by_omega.real * by_speed.imag - by_omega.imag * by_speed.real
        d_omega = -(f.real * by_speed.imag - f.imag * by_speed.real) / determinant
        d_v = -(by_omega.real * f.imag - by_omega.imag * f.real) / determinant
        omega, v = omega + d_omega, v + d_v
        if abs(d_v) < 1e-9 * abs(v):
            return v
    return v


def panels(p, poles):
    """Edges of panels over frequency, Hz, as wide as the poles allow."""
    low, high = p.band
    z = poles[poles.imag >= 0]
    hertz = p.speed / (2 * math.pi)
    re = np.concatenate([z.imag / (2 * math.pi), [0, 0]])
    im = np.concatenate([np.abs(z.real) / (2 * math.pi), [p.omega_c * hertz, p.omega_s * hertz]])
    lag = 2 * (p.l_s + p.b) / p.speed
    step, scale = PHASE / (math.pi * lag), 2 / (CLEARANCE**2 - 1)
    edges, at = [low], low
    im2 = im * im
    while at < high:
        to = re - at
        width = scale * (CLEARANCE * np.sqrt(to * to + im2) - to).min()
        at = max(min(at * RATIO, at + step, at + width), at * 1.001)
        if at > high * (1 - 1e-3):
            at = high
        edges.append(at)
    return np.array(edges)


def quadrature(edges):
    half = (edges[1:] - edges[:-1]) / 2
    f = (half + edges[:-1])[:, None] + half[:, None] * NODES
    return f.ravel(), (half[:, None] * WEIGHTS).ravel()


def inputs(p, system, f):
    """ω, the inputs at the wheelsets, and the spectra in frequency of the two irregularities."""
    omega = 2 * math.pi * f
    lags = np.array([0, 2 * p.b, 2 * p.l_s, 2 * (p.l_s + p.b)]) / p.speed
    phases = np.exp(-1j * omega * lags[:, None])
    spectra = p.spectra(system.kind, omega / p.speed) * (2 * math.pi / p.speed)
    spectra[1] *= system.roll**2
    return omega, phases, spectra


def ride_modal(p, system):
    """RMS accelerations and strokes, from the modes: (iω − A)⁻¹ = V (iω − Λ)⁻¹ V⁻¹."""
    n = system.n
    values, vectors = np.linalg.eig(system.state_matrix(p.speed))
    if values.real.max() >= 0:
        return None
    f, weights = quadrature(panels(p, values))
    omega, phases, spectra = inputs(p, system, f)
    forces = np.zeros((2 * n, 16))
    forces[n:, :8] = -system.k[:, n:] / system.mass[:, None]
    forces[n:, 8:] = -system.damping(p.speed)[:, n:] / system.mass[:, None]
    forces = np.linalg.solve(vectors, forces)
    by_mode = 1 / (1j * omega - values[:, None])
    # Both irregularities side by side: (modes, 2, frequencies).
    shape = (2 * n, 2, len(f))
    modal = (forces.reshape(-1, 4) @ phases).reshape(2 * n, 2, 2, -1)
    modal = (modal[:, 0] + 1j * omega * modal[:, 1]) * by_mode[:, None]
    outputs = np.vstack([system.displacement[:, :n], system.acceleration]) @ vectors[:n]
    transfer = (outputs @ modal.reshape(2 * n, -1)).reshape(-1, *shape[1:])
    m = len(system.displacement)
    transfer[:m] += (system.displacement[:, n:].reshape(-1, 4) @ phases).reshape(m, *shape[1:])
    return rms(transfer, omega, spectra, weights, m)


def ride_direct(p, system):
    """The same, by a solution of D(iω) q = F at every frequency."""
    n = system.n
    values = np.linalg.eigvals(system.state_matrix(p.speed))
    if values.real.max() >= 0:
        return None
    f, weights = quadrature(panels(p, values))
    omega, phases, spectra = inputs(p, system, f)
    damping = system.damping(p.speed)
    i_omega = 1j * omega[:, None, None]
    d = system.k[:, :n] + i_omega * damping[:, :n]
    d[:, range(n), range(n)] -= (omega * omega)[:, None] * system.mass
    columns = phases.T[:, :, None]
    force = -(system.k[:, n:] + i_omega * damping[:, n:])
    force = np.concatenate([force[:, :, :4] @ columns, force[:, :, 4:] @ columns], axis=2)
    q = np.linalg.solve(d, force)
    outputs = np.vstack([system.displacement[:, :n], system.acceleration])
    transfer = np.moveaxis(outputs @ q, 0, 2)
    m = len(system.displacement)
    transfer[:m] += (system.displacement[:, n:].reshape(-1, 4) @ phases).reshape(m, 2, -1)
    return rms(transfer, omega, spectra, weights, m)


def rms(transfer, omega, spectra, weights, strokes):
    squares = transfer.real**2 + transfer.imag**2
    squares[strokes:] *= omega**4
    return np.sqrt(squares.reshape(len(squares), -1) @ (spectra * weights).ravel())


def degree_curves(p: Prototype):
    """Flange- and slip-limited curves in degrees at zero cant deficiency; None where not met."""
    stiffness, load = curving(p)
    limit = 2 * math.sin(math.radians(MAX_DEGREE) / 2) / (100 * FT)
    flange = slip = None
    state, start = [0, 0], 0.0
    a, r0 = p.a, p.r0
    mu_n = p.friction * p.axle_load / 2
    s = np.array([1.0, -1.0])[:, None]
    for _ in range(9):
        matrix, constant, slope = stiffness.copy(), np.zeros(15), load.copy()
        for j in (0, 1):
            c, t, offset = 13, 10 + j, p.l_s if j == 0 else -p.l_s
            if state[j] == 0:
                matrix[c, c] += p.k_spsi
                matrix[t, t] += p.k_spsi
                matrix[c, t] -= p.k_spsi
                matrix[t, c] -= p.k_spsi
                slope[c] -= p.k_spsi * offset
                slope[t] += p.k_spsi * offset
            else:
                constant[c] -= state[j] * p.t_spsi
                constant[t] += state[j] * p.t_spsi
        zero, one = np.linalg.solve(matrix, np.array([constant, slope]).T).T
        # Where this state of the yaw elements ends, and which comes next.
        end, following = limit, None
        for j in (0, 1):
            offset = p.l_s if j == 0 else -p.l_s
            torque = p.k_spsi * (zero[13] - zero[10 + j])
            rate = p.k_spsi * (one[13] - one[10 + j] + offset)
            for bound in (p.t_spsi, -p.t_spsi):
                if rate != 0 and (state[j] == 0 or bound * state[j] > 0):
                    at = (bound - torque) / rate
                    if start * (1 + 1e-9) < at < end:
                        end = at
                        following = (j, 0 if state[j] else int(math.copysign(1, bound)))
        if flange is None:
            flange = first(zero[:4], one[:4], 0, 0, p.clearance, start, end)
        if slip is None:
            x = -s * p.f33 * p.conicity / r0
            spin = s * p.delta_0 / r0
            slip = first(
                x * zero[:4],
                x * one[:4] + s * p.f33 * a,
                p.f11 * zero[4:8] + p.f12 * (spin + p.delta * zero[:4] / (a * r0)),
                p.f11 * one[4:8] + p.f12 * (1 + p.delta * one[:4] / (a * r0)),
                mu_n,
                start,
                end,
            )
        if following is None or (flange is not None and slip is not None):
            break
        state[following[0]], start = following[1], end
    return [None if k is None else math.degrees(2 * math.asin(50 * FT * k)) for k in (flange, slip)]


def first(p_x, q_x, p_y, q_y, bound, low, high):
    """The smallest curvature between two at which |P + κ Q| passes a bound."""
    square, cross = q_x * q_x + q_y * q_y, p_x * q_x + p_y * q_y
    constant = p_x * p_x + p_y * p_y - bound * bound
    root = (np.sqrt(np.maximum(cross * cross - square * constant, 0)) - cross) / square
    kappa = max(root.min(), low)
    return kappa if kappa <= high else None
