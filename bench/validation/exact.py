# SPDX-License-Identifier: Apache-2.0
"""Has the closed forms of ./run validate. The function check() tests each closed form by its equations.

If phi is harmonic, u = phi e_z - z grad(phi) and p = -2 mu phi_z solve the Stokes equations. Happel and Brenner, Low Reynolds
number hydrodynamics, 1965, derive the same flows from stream functions. The two flows below use oblate spheroidal coordinates
l >= 0 and c, with r^2 = a^2 (1 + l^2)(1 - c^2) and z = a l c:
  disc  phi = (2/pi) arccot l. u = e_z on the disc, 0 at infinity. F = 16 mu a
  hole  phi = C a |c| (1 + l arctan l). u = 0 on the plate z = 0, r > a. Q = 2 pi C a^3 / 3, drop 2 pi mu C"""

import numpy as np


def spheroidal(a, r, z):
    """Returns l and c. l is at least 0, and c has the sign of z.

    a^2 l^2 is a root of t^2 - s t - a^2 z^2 with s = r^2 + z^2 - a^2. The formulas avoid cancellation."""
    s, root = r * r + z * z - a * a, np.hypot(r * r + z * z - a * a, 2 * a * z)
    t = np.where(s > 0, (s + root) / 2, 2 * (a * z) ** 2 / np.maximum(root - s, 1e-300))
    l = np.sqrt(t) / a
    c2 = np.where(s < 0, (root - s) / (2 * a * a), z * z / np.maximum(t, 1e-300))
    return l, np.copysign(np.sqrt(np.clip(c2, 0, 1)), z)


def disc(a, r, z):
    """Returns u_r, u_z and p/mu of the flow around a disc that moves broadside with speed 1."""
    l, c = spheroidal(a, r, z)
    d = np.maximum(l * l + c * c, 1e-300)
    phi_r = -2 / np.pi * r * l / (a * a * d * (1 + l * l))
    phi_z = -2 / np.pi * c / (a * d)
    return -z * phi_r, 2 / np.pi * np.arctan2(1, l) - z * phi_z, -2 * phi_z


def hole(a, r, z):
    """Returns u_r, u_z and p/mu of the flow Q = 1 through a hole, towards +z. The drop over mu is 3 / a^3."""
    l, c = spheroidal(a, r, z)
    d, C = np.maximum(l * l + c * c, 1e-300), 3 / (2 * np.pi * a**3)
    phi = C * a * abs(c) * (1 + l * np.arctan(l))
    phi_r = -C * r * abs(c) / (a * d * (1 + l * l))
    phi_z = np.where(z < 0, -1, 1) * C * (np.arctan(l) + l / d)
    return -z * phi_r, phi - z * phi_z, -2 * phi_z


def contraction(m):
    """Returns the contraction C of a plane free jet from a slit. m is the slit's width divided by the channel's width. If m is 0,
    the jet comes from a half space.

    The formula comes from the theory of free streamlines (Helmholtz, Kirchhoff). Von Mises 1917 has a table of C. The hodograph w
    = (u - i v)/U of half the jet is a quarter of the unit disc. The quarter has a source at k = C m, which is the speed far
    upstream divided by U, and a sink at 1. Therefore W = (Q/pi) (log(w^2 - k^2) + log(w^2 - 1/k^2) - 2 log(w^2 - 1)). dz = dW /
    (U w) is integrated along the free streamline from the edge, w = i, to w = 1. The integral gives 1/C = 1 + (2/pi) (1/k - k)
    arctan k."""
    if m == 0:
        return np.pi / (np.pi + 2)
    C = 0.6
    for _ in range(500):
        k = C * m
        C += 0.5 * (1 / (1 + 2 / np.pi * (1 / k - k) * np.arctan(k)) - C)
    return C


def contraction_by_streamline(m, n=200_000):
    """Returns the value of contraction(m) from a numerical integral along the free streamline. The integral is the height of the
    edge minus the half width of the jet."""
    C = contraction(m)
    k = max(C * m, 1e-7)
    # t goes from the sink to the edge, and w = exp(i s) with s = pi/2 t^2. The variable t removes the factor 1/s of the
    # integrand.
    t = (np.arange(n) + 0.5) / n
    s = np.pi / 2 * t * t
    w = np.exp(1j * s)
    dW = 2 * w * (1 / (w * w - k * k) + 1 / (w * w - 1 / k**2) - 2 / (w * w - 1)) / np.pi * 1j * w
    y = np.sum((dW / w).imag * np.pi * t) / n  # with Q = U = 1, the jet's half width is 1
    return 1 / (1 + abs(y))


def check(say=print, tolerance=1e-5):
    """Raises AssertionError if a closed form does not solve its equations."""
    generator = np.random.default_rng(1)
    e = 1e-4
    for name, flow in (("disc", disc), ("hole", hole)):
        a = 0.7
        r, z = generator.uniform(0.05, 3, 2000), generator.uniform(-3, 3, 2000)
        far = np.abs(z) > 0.05
        r, z = r[far], z[far]
        near = lambda dr, dz: np.array(flow(a, r + dr, z + dz))
        middle, up, down, out, inner = near(0, 0), near(0, e), near(0, -e), near(e, 0), near(-e, 0)
        d_r, d_z, laplace = (out - inner) / (2 * e), (up - down) / (2 * e), (out + inner + up + down - 4 * middle) / e**2
        scale = np.abs(d_r).max() + np.abs(d_z).max()
        divergence = np.abs(d_r[0] + middle[0] / r + d_z[1]).max() / scale
        laplace += d_r / r
        laplace[0] -= middle[0] / r**2
        balance = max(np.abs(laplace[0] - d_r[2]).max(), np.abs(laplace[1] - d_z[2]).max()) / np.abs(laplace).max()
        say(f"  {name}: divergence {divergence:.1e}, balance {balance:.1e}")
        assert divergence < tolerance and balance < 100 * tolerance, name
    inside, zero = np.linspace(0, 0.999, 500), np.full(500, 0.0)
    assert np.abs(disc(1.0, inside, zero)[0]).max() < 1e-9 and np.abs(disc(1.0, inside, zero)[1] - 1).max() < 1e-9
    outside = np.linspace(1.001, 9, 500)
    assert np.abs(hole(1.0, outside, zero)[:2]).max() < 1e-9
    s = (np.arange(4000) + 0.5) / 4000  # r = 1 - s^2, because u_z is proportional to sqrt(1 - r) near the edge
    flow = np.sum(hole(1.0, 1 - s * s, zero[0] * s)[1] * 2 * np.pi * (1 - s * s) * 2 * s) / len(s)
    far = np.array([1e5])
    drop = hole(1.0, 0 * far, -far)[2] - hole(1.0, 0 * far, far)[2]
    force = 8 * np.pi * disc(1.0, far, 0 * far)[1] * far  # a point force F gives u_z = F / (8 pi mu r) at z = 0
    say(f"  hole: flow {flow:.6f}, drop/3 {drop[0] / 3:.6f}; disc: force/16 {force[0] / 16:.6f}")
    assert abs(flow - 1) < tolerance and abs(drop[0] / 3 - 1) < tolerance and abs(force[0] / 16 - 1) < tolerance
    for m in (0, 0.1, 0.3, 0.5, 0.8):
        a, b = contraction(m), contraction_by_streamline(m)
        say(f"  contraction, slit {m} of the channel: {a:.5f}, by integrating the streamline {b:.5f}")
        assert abs(a - b) < 1e-4, m
