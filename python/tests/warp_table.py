# SPDX-License-Identifier: Apache-2.0
"""Prints how near warped valves come to random patients, whether they cross or leak, and how accurate velocities are.

warp_table.py [N] takes N random patients, by default 100. warp_table.py factors [N] tries other factors of the noise. Lengths are
in centimetres, results in millimetres.
"""

import sys

import numpy

import riis

HALVES = [(cusp, side) for cusp in range(3) for side in (1, -1)]


class Root:
    """The attachment of a trileaflet valve in a random patient. Angles, radii and heights of the three cusps differ."""

    def __init__(self, random):
        self.radius = random.uniform(1.1, 1.4)
        self.outer_radius, self.height = self.radius * random.uniform(0.9, 1.1), self.radius * random.uniform(0.85, 1.15)
        self.nadir = numpy.radians([0.0, 120.0, 240.0] + random.normal(0.0, 6.0, 3))
        middle = 0.5 * (self.nadir + numpy.append(self.nadir[1:], self.nadir[0] + 2.0 * numpy.pi))
        self.commissure = middle + numpy.radians(random.normal(0.0, 4.0, 3))
        self.nadir_radius = self.radius * (1.0 + random.normal(0.0, 0.05, 3))
        self.commissure_radius = self.outer_radius * (1.0 + random.normal(0.0, 0.05, 3))
        self.nadir_height, self.commissure_height = random.normal(0.0, 0.1, 3), self.height + random.normal(0.0, 0.12, 3)

    def half(self, cusp, side, n=400):
        """Returns n points of half a cusp's attachment, from its nadir to a commissure, evenly by length."""
        s, end = numpy.linspace(0.0, 1.0, 1000), cusp if side > 0 else (cusp + 2) % 3
        to = self.commissure[end] - (2.0 * numpy.pi if side < 0 and cusp == 0 else 0.0)
        angle = self.nadir[cusp] + (to - self.nadir[cusp]) * (1.25 * s - 0.25 * s**3)
        radius = self.nadir_radius[cusp]
        radius = radius + (self.commissure_radius[end] - radius) * s**2 * (1.3 - 0.3 * s)
        height = self.nadir_height[cusp]
        height = height + (self.commissure_height[end] - height) * (0.25 * s + 0.75 * s**2) - 1.2
        return evenly(numpy.stack([radius * numpy.cos(angle), radius * numpy.sin(angle), height], 1), n)

    def valve(self):
        R, Rc, h = self.radius, self.outer_radius, self.height
        return riis.Valve("trileaflet", root_radius=R, leaflet_radius_out=Rc, leaflet_height=h, bending_height=0.5 * h,
                          bending_radius_in=0.32 * R, bending_radius_out=0.51 * (R + Rc), t0_bending=0.2 * R, t3_bending=0.2 * R)


def evenly(line, n):
    """Returns n points of a polyline, evenly by length."""
    at = numpy.append(0.0, numpy.cumsum(numpy.linalg.norm(numpy.diff(line, axis=0), axis=1)))
    return numpy.stack([numpy.interp(numpy.linspace(0.0, at[-1], n), at, line[:, k]) for k in range(3)], 1)


def half_of(surface, cusp, side):
    """Returns the attachment of half a cusp of a surface, from its root to the commissure."""
    attachment, first = surface.attachment, 4 * cusp + (0 if side > 0 else 2)
    parts = [attachment.edges[attachment.patch_id == first + k] for k in (0, 1)]
    return numpy.concatenate([parts[0][:, 0], parts[1][:, 0], parts[1][-1:, 1]])


def distances(points, line):
    """Returns the distances of points from a polyline."""
    a, b = line[:-1], line[1:]
    t = numpy.clip(((points[:, None] - a) * (b - a)).sum(2) / ((b - a) ** 2).sum(1), 0.0, 1.0)
    return numpy.linalg.norm(points[:, None] - (a + t[..., None] * (b - a)), axis=2).min(1)


def landmarks(half, n):
    """Returns n landmarks of each half cusp. Halves share their ends."""
    made = []
    for cusp, side in HALVES:
        made += list(half(cusp, side) if side > 0 else half(cusp, side)[1 : n - 1])
    return numpy.array(made)


def patient(random, noise, n_landmarks=5):
    """Returns a random root, its valve, and landmarks on the valve and in the patient."""
    root = Root(random)
    valve = root.valve()
    surface = riis.Surface(valve)
    sources = landmarks(lambda cusp, side: evenly(half_of(surface, cusp, side), n_landmarks), n_landmarks)
    targets = landmarks(lambda cusp, side: root.half(cusp, side, n_landmarks), n_landmarks)
    return root, valve, sources, targets + noise * random.standard_normal(targets.shape)


def fitted(random, noise, n_landmarks=5):
    """Returns a random root, its warped valve, and the warp."""
    root, valve, sources, targets = patient(random, noise, n_landmarks)
    warp = riis.Warp(sources, noise=noise)
    warp.set_targets(targets)
    valve.set_warp(warp)
    return root, valve, warp


def attachment_off(root, surface):
    """Returns the distances of the attachment's vertices from the patient's attachment."""
    return numpy.concatenate([distances(half_of(surface, *half), root.half(*half)) for half in HALVES])


def factors(n, noise, seed, n_landmarks):
    """Tries factors of the noise. The noise times sqrt(f / 0.6) has the same effect as a factor f of docs/theory/warp.md.
    A patient whose warp folds counts as 99 mm away."""
    random, tried = numpy.random.default_rng(seed), (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
    off = [[] for _ in tried]
    for _ in range(n):
        root, valve, sources, targets = patient(random, noise, n_landmarks)
        for factor, list_of in zip(tried, off, strict=True):
            warp = riis.Warp(sources, noise=noise * (factor / 0.6) ** 0.5)
            try:
                warp.set_targets(targets)
                valve.set_warp(warp)
                list_of.append(10.0 * attachment_off(root, riis.Surface(valve)))
            except riis.InvalidParameterError:  # it folds
                list_of.append(numpy.array([99.0]))
    of_patients = numpy.array([[numpy.percentile(one, 95) for one in list_of] for list_of in off])
    print(f"seed {seed}, noise {10 * noise:.1f} mm, {n_landmarks} landmarks of each half cusp")
    for factor, list_of, worst in zip(tried, off, of_patients.max(1), strict=True):
        together = numpy.percentile(numpy.concatenate(list_of), 95)
        print(f"  factor {factor}: within {together:.3f} mm at 95 % of points, {worst:.2f} mm in the worst patient")
    best = of_patients.min(0)
    print(f"  the best factor of each patient: within {best.mean():.3f} mm on average, {best.max():.2f} mm in the worst patient; "
          f"0.6: {of_patients[tried.index(0.6)].mean():.3f} mm on average", flush=True)


def attachment_and_crossings(n, noise, seed):
    random = numpy.random.default_rng(seed)
    off, n_crossing = [], 0
    for _ in range(n):
        root, valve, _ = fitted(random, noise)
        surface = riis.Surface(valve)
        off.append(attachment_off(root, surface))
        crosses = False
        for opening in numpy.linspace(0.0, 1.0, 11):
            valve["opening"] = opening
            surface.update(valve)
            crosses = crosses or riis.find_crossings(surface).n_pairs > 0
        n_crossing += crosses
    together, of_patients = 10.0 * numpy.concatenate(off), [10.0 * numpy.percentile(one, 95) for one in off]
    print(f"noise {10 * noise:.1f} mm, {n} patients: attachment within {numpy.percentile(together, 95):.2f} mm "
          f"at 95 % of points, {max(of_patients):.2f} mm in the worst patient, mean {together.mean():.2f} mm, "
          f"largest {together.max():.2f} mm; {n_crossing} cross at 11 openings")


def mitral_annuli(n, noise, seed, n_landmarks=16):
    """The annulus of random patients, closed and open, each with separate landmarks. The patient's annulus is the model's
    annulus after an affine map and a bend."""
    random = numpy.random.default_rng(seed)
    off, n_crossing = [], 0
    for _ in range(n):
        valve = riis.Valve("mitral")
        linear, bend = numpy.eye(3) + random.normal(0.0, 0.06, (3, 3)), random.normal(0.0, 0.03, (3, 3, 3))
        warps, lines = [], []
        for opening in (0.0, 1.0):
            valve["opening"] = opening
            edges = riis.Surface(valve, tolerance=0.01).attachment.edges
            line = ordered(edges)
            true = line @ linear + numpy.einsum("ni,nj,ijk->nk", line, line, bend)
            some = numpy.linspace(0, len(line) - 1, n_landmarks, endpoint=False).astype(int)
            warp = riis.Warp(line[some], noise=noise)
            warp.set_targets(true[some] + noise * random.standard_normal((n_landmarks, 3)))
            warps.append(warp)
            lines.append(true)
        valve.set_warp(*warps)
        for opening in numpy.linspace(0.0, 1.0, 11):
            valve["opening"] = opening
            surface = riis.Surface(valve)
            if opening in (0.0, 1.0):
                off.append(distances(surface.attachment.edges[:, 0], lines[int(opening)]))
            n_crossing += riis.find_crossings(surface).n_pairs > 0
    together = 10.0 * numpy.concatenate(off)
    print(f"mitral, noise {10 * noise:.1f} mm, {n} patients, {n_landmarks} landmarks a state: annulus within "
          f"{numpy.percentile(together, 95):.2f} mm at 95 % of all points, mean {together.mean():.2f} mm, largest "
          f"{together.max():.2f} mm; {n_crossing} of {11 * n} states cross")


def ordered(edges):
    """Returns the points of a closed line of edges, in their order along it."""
    left, line = list(edges[1:]), [edges[0, 0], edges[0, 1]]
    while left:
        gaps = [min(numpy.linalg.norm(edge - line[-1], axis=1)) for edge in left]
        edge = left.pop(int(numpy.argmin(gaps)))
        first = int(numpy.argmin(numpy.linalg.norm(edge - line[-1], axis=1)))
        line.append(edge[1 - first])
    return numpy.array(line)


def sealing(n, seed):
    """Counts valves that seal a mesh of their root when closed, and leave a passage at opening 0.3."""
    random = numpy.random.default_rng(seed)
    spacing, n_sealed, n_open = 0.1, 0, 0
    axis = numpy.arange(-1.2, 1.21, spacing)
    grid = numpy.stack(numpy.meshgrid(axis, axis, numpy.arange(-2.4, 1.51, spacing), indexing="ij"), -1)
    inside = grid[..., 0] ** 2 + grid[..., 1] ** 2 <= 1.0
    number = numpy.where(inside, numpy.cumsum(inside).reshape(inside.shape) - 1, -1)
    pairs = [(number[1:], number[:-1]), (number[:, 1:], number[:, :-1]), (number[:, :, 1:], number[:, :, :-1])]
    pairs = numpy.concatenate([numpy.stack([a[(a >= 0) & (b >= 0)], b[(a >= 0) & (b >= 0)]], 1) for a, b in pairs])
    both = numpy.concatenate([pairs, pairs[:, ::-1]])
    both = both[numpy.argsort(both[:, 0], kind="stable")]
    offsets = numpy.searchsorted(both[:, 0], numpy.arange(inside.sum() + 1))
    for _ in range(n):
        _, valve, warp = fitted(random, 0.0)
        nodes = grid[inside] * [1.05, 1.05, 1.0]
        mesh = riis.Mesh(warp.map(nodes))
        mesh.set_adjacency(offsets=offsets.astype(numpy.int64), columns=both[:, 1].astype(numpy.int64))
        ends = [numpy.flatnonzero(nodes[:, 2] == nodes[:, 2].min()), numpy.flatnonzero(nodes[:, 2] == nodes[:, 2].max())]
        for opening in (0.0, 0.3):
            valve["opening"] = opening
            surface = riis.Surface(valve, half_thickness=0.14)
            is_open = riis.find_passage(surface, mesh, ends[0].astype(numpy.int64), ends[1].astype(numpy.int64)).state == "open"
            n_sealed += opening == 0.0 and not is_open
            n_open += opening == 0.3 and is_open
    print(f"{n_sealed} of {n} seal closed, {n_open} pass flow at 0.3")


def beat(x, t):
    """A root that widens unevenly, tilts and shifts."""
    a, angle = numpy.radians(4.0 * numpy.sin(2 * numpy.pi * t)), numpy.arctan2(x[:, 1], x[:, 0])
    wide = 1.0 + 0.05 * numpy.sin(2 * numpy.pi * t + 0.3) * (1.0 + 0.5 * numpy.cos(2 * angle))
    lifted = x[:, 2] + 0.08 * numpy.sin(2 * numpy.pi * t) * numpy.cos(angle)
    y = numpy.stack([x[:, 0] * wide, x[:, 1] * wide, lifted], 1)
    c, s = numpy.cos(a), numpy.sin(a)
    shift = [0.2 * numpy.sin(2 * numpy.pi * t), 0.1 * numpy.cos(2 * numpy.pi * t), 0.0]
    return y @ numpy.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]).T + shift


def velocities(kind, n_steps=20):
    """Compares velocities with the motion of the points that the warp takes to the vertices."""
    valve = riis.Valve(kind, opening=0.5)
    sources = numpy.unique(riis.Surface(valve).attachment.edges.reshape(-1, 3).round(9), axis=0)[::2].copy()
    now, before = riis.Warp(sources), riis.Warp(sources)
    states, off, largest, n_crossing = [valve.copy(), valve.copy()], [], 0.0, 0
    surface, dt = None, 0.01
    for k in range(n_steps):
        time = k / n_steps
        before.set_targets(beat(sources, time))
        now.set_targets(beat(sources, time + dt))
        states[0].set_warp(before)
        states[1].set_warp(now)
        surface = surface or riis.Surface(states[0])
        surface.update_moving(states[1], states[0], dt)
        n_crossing += riis.find_crossings(surface).n_pairs > 0
        y = surface.vertices
        x = y.copy()
        for _ in range(60):
            x += y - now.map(x)
        true = (y - before.map(x)) / dt
        off.append(numpy.linalg.norm(surface.velocities - true, axis=1))
        largest = max(largest, numpy.linalg.norm(true, axis=1).max())
    off = numpy.concatenate(off)
    print(f"{kind}, {n_steps} steps: velocities differ by {100 * off.max() / largest:.1f} % of the largest, rms "
          f"{100 * numpy.sqrt((off**2).mean()) / largest:.2f} %, {10 * dt * off.max():.4f} mm over a step; {n_crossing} cross")


if __name__ == "__main__":
    if sys.argv[1:2] == ["factors"]:
        for case in ((0.03, 2, 5), (0.03, 21, 5), (0.03, 22, 5), (0.03, 23, 9), (0.06, 24, 5)):
            factors(int(sys.argv[2]) if len(sys.argv) > 2 else 100, *case)
        sys.exit()
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    attachment_and_crossings(count, 0.0, 1)
    attachment_and_crossings(count, 0.03, 2)
    mitral_annuli(max(1, count // 5), 0.0, 4)
    mitral_annuli(max(1, count // 5), 0.03, 5)
    sealing(max(1, count // 10), 3)
    for name in ("trileaflet", "coapting", "aortic", "mitral"):
        velocities(name)
