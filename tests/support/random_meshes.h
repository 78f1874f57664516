/* SPDX-License-Identifier: Apache-2.0
 * Makes random meshes of several kinds. Include after searches.h. */
#ifndef RIIS_TEST_RANDOM_MESHES_H
#define RIIS_TEST_RANDOM_MESHES_H

static random_source rng;

static inline int64_t random_integer(int64_t low, int64_t high) {
  return low + (int64_t)(random_bits(&rng) % (uint64_t)(high - low + 1));
}
static int one_in(int n) { return random_integer(1, n) == 1; }

enum { structured, tetrahedra, graded, jittered, with_holes, scattered, wrongly_joined, n_kinds };
static const char *const kind_names[n_kinds] = {
    "structured", "tetrahedra", "graded", "jittered", "with holes, in pieces", "scattered", "wrongly joined"};

static inline int64_t *pairs_of_rows(const test_mesh *mesh, int64_t *n_pairs) {
  int64_t *pairs = own(malloc((size_t)(mesh->offsets[mesh->n] + 1) * sizeof *pairs));
  *n_pairs = 0;
  for (int64_t i = 0; i < mesh->n; ++i)
    for (int64_t k = mesh->offsets[i]; k < mesh->offsets[i + 1]; ++k)
      if (mesh->columns[k] > i) pairs[2 * *n_pairs] = i, pairs[2 * (*n_pairs)++ + 1] = mesh->columns[k];
  return pairs;
}

/* Keeps only the wanted nodes and the pairs of wanted nodes. */
static inline void keep(test_mesh *mesh, const uint8_t *wanted) {
  int64_t n_pairs, m = 0, n = 0, *number = own(malloc((size_t)mesh->n * sizeof *number)),
                   *pairs = pairs_of_rows(mesh, &n_pairs);
  for (int64_t i = 0; i < mesh->n; ++i) {
    number[i] = wanted[i] ? n : -1;
    if (wanted[i]) memmove(mesh->xyz + 3 * n++, mesh->xyz + 3 * i, 3 * sizeof *mesh->xyz);
  }
  for (int64_t k = 0; k < n_pairs; ++k) {
    const int64_t a = number[pairs[2 * k]], b = number[pairs[2 * k + 1]];
    if (a >= 0 && b >= 0) pairs[2 * m] = a, pairs[2 * m++ + 1] = b;
  }
  mesh->n = n;
  set_rows(mesh, m, pairs);
}

/* Shuffles the nodes. */
static inline void shuffle(test_mesh *mesh) {
  int64_t n_pairs, *pairs = pairs_of_rows(mesh, &n_pairs), *number = own(malloc((size_t)mesh->n * sizeof *number));
  double *xyz = own(malloc((size_t)mesh->n * 3 * sizeof *xyz));
  for (int64_t i = 0; i < mesh->n; ++i) number[i] = i;
  for (int64_t i = mesh->n - 1; i > 0; --i) {
    const int64_t j = random_integer(0, i), swap = number[i];
    number[i] = number[j], number[j] = swap;
  }
  for (int64_t i = 0; i < mesh->n; ++i) memcpy(xyz + 3 * number[i], mesh->xyz + 3 * i, 3 * sizeof *xyz);
  for (int64_t k = 0; k < 2 * n_pairs; ++k) pairs[k] = number[pairs[k]];
  set_rows(mesh, n_pairs, pairs);
  mesh->xyz = xyz;
}

/* Joins each node to the k nearest nodes in its own grid cell and in the adjacent cells. Most neighbours in a Delaunay mesh are
 * such nodes. */
static inline void join_near_nodes(test_mesh *mesh, const double *lower, const double *upper, int k) {
  int64_t counts[3], n_cells = 1;
  double size = 1;
  for (int c = 0; c < 3; ++c) size *= upper[c] - lower[c];
  size = cbrt(size / (double)mesh->n * 4);
  for (int c = 0; c < 3; ++c) n_cells *= counts[c] = 1 + (int64_t)((upper[c] - lower[c]) / size);
  int64_t *first = own(malloc((size_t)n_cells * sizeof *first)), *next = own(malloc((size_t)mesh->n * sizeof *next));
  int64_t *pairs = own(malloc((size_t)mesh->n * (size_t)k * 2 * sizeof *pairs)), n_pairs = 0;
  for (int64_t i = 0; i < n_cells; ++i) first[i] = -1;
#define CELL(p, c) ((int64_t)fmin((double)(counts[c] - 1), fmax(0, ((p)[c] - lower[c]) / size)))
  for (int64_t i = 0; i < mesh->n; ++i) {
    const double *p = mesh->xyz + 3 * i;
    const int64_t cell = CELL(p, 0) + counts[0] * (CELL(p, 1) + counts[1] * CELL(p, 2));
    next[i] = first[cell], first[cell] = i;
  }
  for (int64_t i = 0; i < mesh->n; ++i) {
    const double *p = mesh->xyz + 3 * i;
    double best[32];
    int64_t near[32] = {0}; /* so that gcc for ARM does not suspect the entries from n_near on */
    int n_near = 0;
    for (int64_t z = CELL(p, 2) - 1; z <= CELL(p, 2) + 1; ++z)
      for (int64_t y = CELL(p, 1) - 1; y <= CELL(p, 1) + 1; ++y)
        for (int64_t x = CELL(p, 0) - 1; x <= CELL(p, 0) + 1; ++x) {
          if (x < 0 || y < 0 || z < 0 || x >= counts[0] || y >= counts[1] || z >= counts[2]) continue;
          for (int64_t j = first[x + counts[0] * (y + counts[1] * z)]; j >= 0; j = next[j]) {
            if (j == i) continue;
            const double *q = mesh->xyz + 3 * j;
            const double sq =
                (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]);
            if (n_near == k && sq >= best[k - 1]) continue;
            int at = n_near < k ? n_near++ : k - 1;
            for (; at > 0 && best[at - 1] > sq; --at) best[at] = best[at - 1], near[at] = near[at - 1];
            best[at] = sq, near[at] = j;
          }
        }
    for (int m = 0; m < n_near; ++m) pairs[2 * n_pairs] = i, pairs[2 * n_pairs++ + 1] = near[m];
  }
#undef CELL
  set_rows(mesh, n_pairs, pairs);
}

/* Cuts each cube into six tetrahedra. The library joins nodes along the edges of the tetrahedra. */
static inline void join_by_tetrahedra(test_mesh *mesh, const int64_t *counts) {
  static const int corners[6][4][3] = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {1, 1, 1}},
      {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}}, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}},
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
  int32_t *ids = own(malloc((size_t)mesh->n * 24 * sizeof *ids));
  int64_t n_ids = 0;
  for (int64_t k = 0; k + 1 < counts[2]; ++k)
    for (int64_t j = 0; j + 1 < counts[1]; ++j)
      for (int64_t i = 0; i + 1 < counts[0]; ++i)
        for (int t = 0; t < 24; ++t) {
          const int *c = corners[t / 4][t % 4];
          ids[n_ids++] = (int32_t)(i + c[0] + counts[0] * (j + c[1] + counts[1] * (k + c[2])));
        }
  riis_mesh_cells cells;
  riis_csr csr;
  riis_adjacency *adjacency = NULL;
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = mesh->n;
  cells.n_cells = n_ids / 4;
  cells.node_ids = ids;
  cells.n_threads = (int32_t)random_integer(1, 3);
  CHECK_OK(riis_adjacency_create_from_cells(&cells, &adjacency));
  own(adjacency);
  CHECK_OK(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  const int64_t *offsets = csr.offsets;
  const int32_t *columns = csr.columns;
  mesh->columns = own(malloc((size_t)(offsets[mesh->n] + 1) * sizeof *mesh->columns));
  memcpy(mesh->offsets, offsets, (size_t)(mesh->n + 1) * sizeof *offsets);
  for (int64_t k = 0; k < offsets[mesh->n]; ++k) mesh->columns[k] = columns[k];
}

/* Makes about n_wanted nodes in the box. *spacing gets the length of most edges. */
static inline test_mesh random_mesh(int kind, int64_t n_wanted, const double *lower, const double *upper,
                                    double *spacing) {
  int64_t counts[3];
  double volume = 1;
  for (int c = 0; c < 3; ++c) volume *= upper[c] - lower[c];
  *spacing = cbrt(volume / (double)n_wanted);
  for (int c = 0; c < 3; ++c) counts[c] = 2 + (int64_t)((upper[c] - lower[c]) / *spacing);
  test_mesh mesh = lattice(counts, lower, upper);
  if (kind == tetrahedra || (kind == jittered && one_in(2))) join_by_tetrahedra(&mesh, counts);
  if (kind == graded) { /* up to a hundred times finer near one point */
    double centre[3];
    for (int c = 0; c < 3; ++c) centre[c] = random_between(&rng, 0, 1);
    const double power = random_between(&rng, 1.2, 4);
    for (int64_t i = 0; i < 3 * mesh.n; ++i) {
      const int c = (int)(i % 3);
      const double at = (mesh.xyz[i] - lower[c]) / (upper[c] - lower[c]) - centre[c];
      const double end = at < 0 ? centre[c] : 1 - centre[c];
      mesh.xyz[i] = lower[c] + (upper[c] - lower[c]) * (centre[c] + copysign(end * pow(fabs(at) / end, power), at));
    }
  }
  if (kind == jittered || kind == with_holes) {
    const double by = *spacing * random_between(&rng, 0, 0.6);
    for (int64_t i = 0; i < 3 * mesh.n; ++i) mesh.xyz[i] += random_between(&rng, -by, by);
  }
  if (kind == with_holes) {
    uint8_t *wanted = own(malloc((size_t)mesh.n));
    memset(wanted, 1, (size_t)mesh.n);
    for (int64_t hole = random_integer(1, 8); hole > 0; --hole) {
      const int is_slab = one_in(3), axis = (int)random_integer(0, 2);
      const double *p = mesh.xyz + 3 * random_integer(0, mesh.n - 1), centre[3] = {p[0], p[1], p[2]};
      const double radius = *spacing * (is_slab ? 1 : random_between(&rng, 0.5, 5));
      for (int64_t i = 0; i < mesh.n; ++i) {
        double sum = 0;
        for (int c = 0; c < 3; ++c)
          if (!is_slab || c == axis) sum += (mesh.xyz[3 * i + c] - centre[c]) * (mesh.xyz[3 * i + c] - centre[c]);
        if (sum < radius * radius) wanted[i] = 0;
      }
    }
    wanted[random_integer(0, mesh.n - 1)] = 1;
    keep(&mesh, wanted);
  }
  if (kind == scattered) {
    for (int64_t i = 0; i < 3 * mesh.n; ++i) mesh.xyz[i] = random_between(&rng, lower[i % 3], upper[i % 3]);
    join_near_nodes(&mesh, lower, upper, (int)random_integer(2, 14));
  }
  if (kind == wrongly_joined) {
    const int64_t n_pairs = random_integer(0, 3 * mesh.n);
    int64_t *pairs = own(malloc((size_t)(2 * n_pairs + 1) * sizeof *pairs));
    for (int64_t k = 0; k < 2 * n_pairs; ++k) pairs[k] = random_integer(0, mesh.n - 1);
    set_rows(&mesh, n_pairs, pairs);
  }
  if (one_in(2)) shuffle(&mesh);
  return mesh;
}

#endif
