/* SPDX-License-Identifier: Apache-2.0
 * The neighbour search is compared with the exhaustive search bit by bit, and nodes of both with brute force in extended
 * precision. Meshes, surfaces, placements, half thicknesses, limits, masks and threads are random. RIIS_TEST_LONG=1 goes on
 * until ten million pairs of a node and a surface have been compared with brute force. */
#include <riis/riis.h>

#include "oracle.h"
#include "test_support.h"

#include "handles.h"
#include "searches.h"

static random_source rng;

static int64_t random_integer(int64_t low, int64_t high) {
  return low + (int64_t)(random_bits(&rng) % (uint64_t)(high - low + 1));
}
static int one_in(int n) { return random_integer(1, n) == 1; }

/* --- Brute force ------------------------------------------------------------------------------------------------------ */

/* Triangles in blocks with boxes. A triangle whose box is farther than the closest so far, by more than any rounding, is left
 * out. The distance of every other triangle is computed in extended precision. */
enum { per_block = 16 };
typedef struct brute_force {
  int64_t n;
  double *corners; /* (9, n) */
  double *boxes;   /* (6, n): lower, upper */
  double *blocks;  /* (6, blocks of per_block triangles) */
} brute_force;

static void grow(double *box, const double *by) {
  for (int c = 0; c < 3; ++c) {
    if (by[c] < box[c]) box[c] = by[c];
    if (by[3 + c] > box[3 + c]) box[3 + c] = by[3 + c];
  }
}

static brute_force brute_force_of(const riis_surface *surface) {
  brute_force b;
  const int64_t *vertex_id;
  const double *vertices;
  CHECK_OK(riis_surface_vertices(surface, NULL, &vertices));
  CHECK_OK(riis_surface_triangles(surface, &b.n, &vertex_id, NULL, NULL, NULL));
  b.corners = malloc((size_t)b.n * 9 * sizeof(double));
  b.boxes = malloc((size_t)b.n * 6 * sizeof(double));
  b.blocks = malloc((size_t)(b.n / per_block + 1) * 6 * sizeof(double));
  for (int64_t t = 0; t < b.n; ++t) {
    double *box = b.boxes + 6 * t, *block = b.blocks + t / per_block * 6;
    for (int k = 0; k < 3; ++k) {
      const double *v = vertices + 3 * vertex_id[3 * t + k];
      double point[6];
      for (int c = 0; c < 3; ++c) b.corners[9 * t + 3 * k + c] = point[c] = point[3 + c] = v[c];
      if (k == 0) memcpy(box, point, sizeof point);
      grow(box, point);
    }
    if (t % per_block == 0) memcpy(block, box, 6 * sizeof *box);
    grow(block, box);
  }
  return b;
}

static void free_brute_force(brute_force *b) { free(b->corners), free(b->boxes), free(b->blocks); }

/* The square of the distance to a box. */
static double to_box_sq(const double *p, const double *box) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = fmax(fmax(box[c] - p[c], p[c] - box[3 + c]), 0);
    sum += d * d;
  }
  return sum;
}

/* Returns the distance to the closest triangle if it is at most reach, and any number above reach otherwise. */
static long double brute_force_distance(const brute_force *b, const double *p, double reach) {
  long double least = INFINITY;
  double least_sq = reach * reach * (1 + 1e-9);
  for (int64_t first = 0; first < b->n; first += per_block) {
    if (to_box_sq(p, b->blocks + first / per_block * 6) > least_sq) continue;
    for (int64_t t = first; t < first + per_block && t < b->n; ++t) {
      if (to_box_sq(p, b->boxes + 6 * t) > least_sq) continue;
      const long double distance = oracle_point_triangle(p, b->corners + 9 * t);
      if (distance >= least) continue;
      least = distance;
      const double sq = (double)(distance * distance) * (1 + 1e-9) + 1e-300;
      if (sq < least_sq) least_sq = sq;
    }
  }
  return least;
}

/* --- Meshes ----------------------------------------------------------------------------------------------------------- */

enum { structured, tetrahedra, graded, jittered, with_holes, scattered, wrongly_joined, n_kinds };
static const char *const kind_names[n_kinds] = {
    "structured", "tetrahedra", "graded", "jittered", "with holes, in pieces", "scattered", "wrongly joined"};

static int64_t *pairs_of_rows(const test_mesh *mesh, int64_t *n_pairs) {
  int64_t *pairs = malloc((size_t)(mesh->offsets[mesh->n] + 1) * sizeof *pairs);
  *n_pairs = 0;
  for (int64_t i = 0; i < mesh->n; ++i)
    for (int64_t k = mesh->offsets[i]; k < mesh->offsets[i + 1]; ++k)
      if (mesh->columns[k] > i) pairs[2 * *n_pairs] = i, pairs[2 * (*n_pairs)++ + 1] = mesh->columns[k];
  return pairs;
}

/* Keeps the wanted nodes and the pairs of wanted nodes. */
static void keep(test_mesh *mesh, const uint8_t *wanted) {
  int64_t n_pairs, m = 0, n = 0, *number = malloc((size_t)mesh->n * sizeof *number),
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
  free(pairs);
  free(number);
}

/* Puts the nodes into another order. */
static void shuffle(test_mesh *mesh) {
  int64_t n_pairs, *pairs = pairs_of_rows(mesh, &n_pairs), *number = malloc((size_t)mesh->n * sizeof *number);
  double *xyz = malloc((size_t)mesh->n * 3 * sizeof *xyz);
  for (int64_t i = 0; i < mesh->n; ++i) number[i] = i;
  for (int64_t i = mesh->n - 1; i > 0; --i) {
    const int64_t j = random_integer(0, i), swap = number[i];
    number[i] = number[j], number[j] = swap;
  }
  for (int64_t i = 0; i < mesh->n; ++i) memcpy(xyz + 3 * number[i], mesh->xyz + 3 * i, 3 * sizeof *xyz);
  for (int64_t k = 0; k < 2 * n_pairs; ++k) pairs[k] = number[pairs[k]];
  set_rows(mesh, n_pairs, pairs);
  free(mesh->xyz);
  mesh->xyz = xyz;
  free(pairs);
  free(number);
}

/* Joins each node to the k nearest nodes in the cells around its own, which are mostly the neighbours in a Delaunay mesh. */
static void join_near_nodes(test_mesh *mesh, const double *lower, const double *upper, int k) {
  int64_t counts[3], n_cells = 1;
  double size = 1;
  for (int c = 0; c < 3; ++c) size *= upper[c] - lower[c];
  size = cbrt(size / (double)mesh->n * 4);
  for (int c = 0; c < 3; ++c) n_cells *= counts[c] = 1 + (int64_t)((upper[c] - lower[c]) / size);
  int64_t *first = malloc((size_t)n_cells * sizeof *first), *next = malloc((size_t)mesh->n * sizeof *next);
  int64_t *pairs = malloc((size_t)mesh->n * (size_t)k * 2 * sizeof *pairs), n_pairs = 0;
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
    int64_t near[32];
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
  free(first), free(next), free(pairs);
}

/* Cuts each cube into six tetrahedra, and takes their edges from the library's builder. */
static void join_by_tetrahedra(test_mesh *mesh, const int64_t *counts) {
  static const int corners[6][4][3] = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {1, 1, 1}},
      {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}}, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}},
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
  int32_t *ids = malloc((size_t)mesh->n * 24 * sizeof *ids);
  int64_t n_ids = 0;
  for (int64_t k = 0; k + 1 < counts[2]; ++k)
    for (int64_t j = 0; j + 1 < counts[1]; ++j)
      for (int64_t i = 0; i + 1 < counts[0]; ++i)
        for (int t = 0; t < 24; ++t) {
          const int *c = corners[t / 4][t % 4];
          ids[n_ids++] = (int32_t)(i + c[0] + counts[0] * (j + c[1] + counts[1] * (k + c[2])));
        }
  riis_cells cells;
  riis_csr csr;
  riis_adjacency *adjacency = NULL;
  CHECK_OK(riis_cells_init(&cells, sizeof cells));
  cells.n_nodes = mesh->n;
  cells.n_cells = n_ids / 4;
  cells.node_ids = ids;
  cells.n_threads = (int32_t)random_integer(1, 3);
  CHECK_OK(riis_adjacency_create_from_cells(&cells, &adjacency));
  CHECK_OK(riis_adjacency_csr(adjacency, &csr, sizeof csr));
  const int64_t *offsets = csr.offsets;
  const int32_t *columns = csr.columns;
  mesh->columns = realloc(mesh->columns, (size_t)(offsets[mesh->n] + 1) * sizeof *mesh->columns);
  memcpy(mesh->offsets, offsets, (size_t)(mesh->n + 1) * sizeof *offsets);
  for (int64_t k = 0; k < offsets[mesh->n]; ++k) mesh->columns[k] = columns[k];
  riis_adjacency_destroy(&adjacency);
  free(ids);
}

/* Returns about n_wanted nodes in the box. *spacing becomes the length of most edges. */
static test_mesh random_mesh(int kind, int64_t n_wanted, const double *lower, const double *upper, double *spacing) {
  int64_t counts[3];
  double volume = 1;
  for (int c = 0; c < 3; ++c) volume *= upper[c] - lower[c];
  *spacing = cbrt(volume / (double)n_wanted);
  for (int c = 0; c < 3; ++c) counts[c] = 2 + (int64_t)((upper[c] - lower[c]) / *spacing);
  test_mesh mesh = lattice(counts, lower, upper);
  if (kind == tetrahedra || (kind == jittered && one_in(2))) join_by_tetrahedra(&mesh, counts);
  if (kind == graded) { /* finer towards one place, up to a hundredfold */
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
    uint8_t *wanted = malloc((size_t)mesh.n);
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
    free(wanted);
  }
  if (kind == scattered) {
    for (int64_t i = 0; i < 3 * mesh.n; ++i) mesh.xyz[i] = random_between(&rng, lower[i % 3], upper[i % 3]);
    join_near_nodes(&mesh, lower, upper, (int)random_integer(2, 14));
  }
  if (kind == wrongly_joined) {
    const int64_t n_pairs = random_integer(0, 3 * mesh.n);
    int64_t *pairs = malloc((size_t)(2 * n_pairs + 1) * sizeof *pairs);
    for (int64_t k = 0; k < 2 * n_pairs; ++k) pairs[k] = random_integer(0, mesh.n - 1);
    set_rows(&mesh, n_pairs, pairs);
    free(pairs);
  }
  if (one_in(2)) shuffle(&mesh);
  return mesh;
}

/* --- Surfaces --------------------------------------------------------------------------------------------------------- */

typedef struct placement {
  double axis[3], angle, translation[3]; /* unit axis, degrees */
} placement;

static placement random_placement(void) {
  placement p;
  double sum = 0;
  const double far = one_in(3) ? 0 : 300;
  for (int c = 0; c < 3; ++c) p.axis[c] = random_between(&rng, -1, 1), sum += p.axis[c] * p.axis[c];
  for (int c = 0; c < 3; ++c) p.axis[c] /= sqrt(sum), p.translation[c] = random_between(&rng, -far, far);
  p.angle = random_between(&rng, -180, 180);
  return p;
}

static void place(const placement *p, test_mesh *mesh) {
  const double angle = p->angle * 3.14159265358979323846 / 180, s = sin(angle), k = cos(angle), *axis = p->axis;
  for (int64_t i = 0; i < mesh->n; ++i) { /* v cos + (axis x v) sin + axis (axis . v) (1 - cos) */
    double *to = mesh->xyz + 3 * i;
    const double v[3] = {to[0], to[1], to[2]}, along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      to[c] = v[c] * k + (axis[d] * v[e] - axis[e] * v[d]) * s + axis[c] * along * (1 - k) + p->translation[c];
    }
  }
}

/* A valve, or triangles, from which surfaces can be made again at other places. */
typedef struct shape {
  riis_valve *valve; /* or NULL */
  int is_mitral;
  double opening, step;
  int64_t n_triangles;
  double *xyz;
  int32_t *ids;
} shape;

static shape random_shape(void) {
  shape s = {0};
  const int64_t kind = random_integer(0, 2);
  if (kind == 2) {
    s.n_triangles = one_in(4) ? random_integer(1, 4) : random_integer(5, 3000);
    random_soup(&rng, s.n_triangles, pow(10, random_between(&rng, -3, 0.3)), &s.xyz, &s.ids);
    return s;
  }
  s.is_mitral = kind == 1;
  CHECK_OK(riis_valve_create(s.is_mitral ? "mitral" : "aortic", &s.valve));
  s.opening = random_between(&rng, 0, 1);
  s.step = random_between(&rng, -0.2, 0.2);
  return s;
}

static void free_shape(shape *s) {
  riis_valve_destroy(&s->valve);
  free(s->xyz), free(s->ids);
}

/* Makes the surface, or updates it to the next step. */
static void update_surface(riis_surface **surface, shape *s, const riis_surface_options *options) {
  if (s->valve) {
    s->opening += s->step;
    if (s->opening < 0 || s->opening > 1) s->step = -s->step, s->opening = fmin(1, fmax(0, s->opening));
    if (s->is_mitral) CHECK_OK(riis_valve_set_scalar(s->valve, "opening", s->opening));
    if (*surface)
      CHECK_OK(riis_surface_update(*surface, s->valve, options));
    else
      CHECK_OK(riis_surface_create(s->valve, options, surface));
  } else {
    for (int64_t i = 0; i < 9 * s->n_triangles; ++i) s->xyz[i] += random_between(&rng, -0.01, 0.01);
    const riis_surface_arrays arrays = triangle_arrays(3 * s->n_triangles, s->xyz, s->n_triangles, s->ids);
    if (*surface)
      CHECK_OK(riis_surface_update_from_arrays(*surface, &arrays, options));
    else
      CHECK_OK(riis_surface_create_from_arrays(&arrays, options, surface));
  }
}

/* --- The suite -------------------------------------------------------------------------------------------------------- */

static struct totals {
  int64_t meshes[n_kinds], markings, nodes, pairs, pairs_within, marked, undecided;
  int64_t different_bits, different_distances, different_marks, incomplete;
  int64_t unreached, most_threads;
  int64_t by_instructions[RIIS_INSTRUCTIONS_AVX512 + 1]; /* markings over clusters */
  double largest;                                        /* error, relative to the coordinates */
} totals;

/* Compares a share of the nodes with brute force. */
static void compare_with_brute_force(const riis_surface *surface, const test_mesh *nodes, const uint8_t *mask,
                                     const riis_mark_result *result, double limit, int64_t n_wanted) {
  const double half_thickness = info_of(surface).half_thickness;
  brute_force b = brute_force_of(surface);
  double size = 1;
  for (int64_t k = 0; k < 9 * b.n; ++k) size = fmax(size, fabs(b.corners[k]));
  uint8_t *mark = malloc((size_t)nodes->n);
  double *distance = malloc((size_t)nodes->n * sizeof *distance);
  CHECK_OK(riis_mark_result_dense(result, nodes->n, 1e30, mark, distance, NULL, NULL));
  const int64_t stride = n_wanted < nodes->n ? nodes->n / n_wanted : 1, first = random_integer(0, stride - 1);
  int64_t pairs = 0, within = 0, undecided = 0, bad_distances = 0, bad_marks = 0;
  double largest = 0;
#pragma omp parallel for num_threads(2) schedule(dynamic, 64) reduction(+ : pairs, within, undecided, bad_distances, bad_marks) reduction(max : largest)
  for (int64_t i = first; i < nodes->n; i += stride) {
    if (mask && !mask[i]) { /* must be left out, wherever it is */
      bad_marks += mark[i] != 0 || distance[i] != 1e30;
      continue;
    }
    ++pairs;
    const double *p = nodes->xyz + 3 * i;
    const double tolerance = 1e-12 * fmax(size, fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2]))));
    const long double expected = brute_force_distance(&b, p, limit + 2 * tolerance);
    const int is_within = distance[i] < 1e30;
    within += is_within;
    if (is_within) {
      const double difference = (double)fabsl(expected - distance[i]);
      bad_distances += !(difference <= tolerance);
      largest = fmax(largest, difference / (tolerance * 1e12));
    } else if (fabsl(expected - limit) <= tolerance) {
      ++undecided;
    } else {
      bad_distances += expected <= limit;
    }
    if (fabsl(expected - half_thickness) <= tolerance)
      ++undecided;
    else
      bad_marks += mark[i] != (expected <= half_thickness);
  }
  totals.pairs += pairs, totals.pairs_within += within, totals.undecided += undecided;
  totals.different_distances += bad_distances, totals.different_marks += bad_marks;
  totals.largest = fmax(totals.largest, largest);
  free(mark);
  free(distance);
  free_brute_force(&b);
}

/* Checks that clusters with every instruction set give the exhaustive search's result, bit by bit. */
static void compare_clusters(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *asked,
                             const riis_mark_result *exhaustive, riis_mark_result *clustered) {
  riis_mark_options options = *asked;
  options.search = RIIS_SEARCH_CLUSTERS;
  for (options.instructions = RIIS_INSTRUCTIONS_BASELINE; options.instructions <= RIIS_INSTRUCTIONS_AVX512;
       ++options.instructions) {
    options.n_threads = (int32_t)random_integer(1, 4);
    const riis_status status = riis_mark_nodes(surface, mesh, &options, clustered);
    if (status == RIIS_UNAVAILABLE) continue;
    CHECK_OK(status);
    const riis_mark_stats stats = stats_of(clustered);
    assert_int_equal(stats.search, RIIS_SEARCH_CLUSTERS);
    assert_int_equal(stats.instructions, options.instructions);
    ++totals.by_instructions[options.instructions];
    totals.incomplete += stats.complete != 1;
    if (same_results(clustered, exhaustive)) continue;
    ++totals.different_bits;
    printf("clusters, instructions %d, %lld nodes: %lld within the limit instead of %lld\n", options.instructions,
           (long long)stats.n_nodes, (long long)stats.n_within_limit, (long long)stats_of(exhaustive).n_within_limit);
  }
}

static void one_case(int kind, int64_t n_nodes, int64_t n_compared) {
  shape s = random_shape();
  riis_surface *surface = NULL;
  update_surface(&surface, &s, NULL);
  /* The box is around the surface, or the surface sticks out of it. */
  riis_surface_info info = info_of(surface);
  double lower[3], upper[3], spacing;
  for (int c = 0; c < 3; ++c) {
    const double extent = fmax(0.3, info.upper[c] - info.lower[c]);
    lower[c] = info.lower[c] - extent * random_between(&rng, -0.2, 0.4);
    upper[c] = lower[c] + extent * random_between(&rng, 0.7, 1.6);
  }
  test_mesh nodes = random_mesh(kind, n_nodes, lower, upper, &spacing);
  placement where = random_placement();
  riis_surface_options options = surface_options();
  for (int c = 0; c < 3; ++c) options.rotation_axis[c] = where.axis[c], options.translation[c] = where.translation[c];
  options.rotation_angle = where.angle;
  options.half_thickness = spacing * pow(10, random_between(&rng, -3, 0.7));
  options.tolerance = fmin(1, fmax(1e-4, 0.005 / options.half_thickness)) * random_between(&rng, 0.8, 1);
  place(&where, &nodes);

  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *neighbor = new_result(), *exhaustive = new_result(), *clustered = new_result();
  uint8_t *mask = NULL;
  for (int64_t step = 0, n_steps = random_integer(1, 4); step < n_steps; ++step) {
    update_surface(&surface, &s, &options);
    if (step > 0 && one_in(4)) { /* the mesh also moves */
      for (int64_t i = 0; i < 3 * nodes.n; ++i) nodes.xyz[i] += random_between(&rng, -0.1, 0.1) * spacing;
      CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
    }
    free(mask);
    mask = NULL;
    if (one_in(3)) {
      const uint64_t share = (uint64_t)random_integer(0, 8);
      mask = malloc((size_t)nodes.n);
      for (int64_t i = 0; i < nodes.n; ++i) mask[i] = random_bits(&rng) % 8 < share;
    }
    riis_mark_options marking = mark_options();
    marking.node_mask = mask;
    double limit = options.half_thickness;
    if (one_in(3)) limit = marking.distance_limit = limit * pow(10, random_between(&rng, 0, 2));
    marking.search = RIIS_SEARCH_EXHAUSTIVE;
    marking.n_threads = (int32_t)random_integer(1, 4);
    CHECK_OK(riis_mark_nodes(surface, mesh, &marking, exhaustive));
    marking.search = RIIS_SEARCH_NEIGHBOR;
    marking.n_threads = (int32_t)random_integer(1, 4);
    CHECK_OK(riis_mark_nodes(surface, mesh, &marking, neighbor));
    const riis_mark_stats stats = stats_of(neighbor);
    assert_int_equal(stats.search, RIIS_SEARCH_NEIGHBOR);
    assert_true(stats.n_threads >= 1 && stats.n_threads <= marking.n_threads);
    if (stats.n_threads > totals.most_threads) totals.most_threads = stats.n_threads;
    totals.incomplete += stats.complete != 1;
    if (!same_results(neighbor, exhaustive)) {
      ++totals.different_bits;
      printf("%s, %lld nodes, step %lld, limit %.17g, mask %d: %lld within the limit instead of %lld\n",
             kind_names[kind], (long long)nodes.n, (long long)step, limit, mask != NULL,
             (long long)stats.n_within_limit, (long long)stats_of(exhaustive).n_within_limit);
    }
    compare_clusters(surface, mesh, &marking, exhaustive, clustered);
    ++totals.markings;
    totals.nodes += nodes.n;
    totals.marked += stats.n_marked;
    totals.unreached += stats.n_unreached;
    compare_with_brute_force(surface, &nodes, mask, one_in(2) ? neighbor : clustered, limit, n_compared);
  }
  ++totals.meshes[kind];
  free(mask);
  riis_mark_result_destroy(&neighbor);
  riis_mark_result_destroy(&exhaustive);
  riis_mark_result_destroy(&clustered);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  free_shape(&s);
  free_test_mesh(&nodes);
}

static void random_cases_equal_brute_force(void **state) {
  (void)state;
  const char *given = getenv("RIIS_TEST_LONG");
  const int is_long = given && strcmp(given, "1") == 0;
  const int64_t n_cases = 140, n_pairs = is_long ? 10000000 : 0;
  int64_t n_meshes = 0;
  for (; n_meshes < n_cases || totals.pairs < n_pairs; ++n_meshes)
    one_case((int)(n_meshes % n_kinds), (int64_t)pow(10, random_between(&rng, 0.5, is_long ? 4.7 : 4)),
             is_long ? INT64_MAX : 1000);
  printf("%lld meshes:", (long long)n_meshes);
  for (int kind = 0; kind < n_kinds; ++kind)
    printf(" %lld %s%s", (long long)totals.meshes[kind], kind_names[kind], kind + 1 < n_kinds ? ";" : "\n");
  printf(
      "%lld markings of %lld nodes by both searches, %lld nodes marked, %lld found by the proof, up to %lld threads; "
      "%lld not bit for "
      "bit, %lld not complete\n",
      (long long)totals.markings, (long long)totals.nodes, (long long)totals.marked, (long long)totals.unreached,
      (long long)totals.most_threads, (long long)totals.different_bits, (long long)totals.incomplete);
  printf("%lld markings over clusters by the baseline's instructions, %lld by AVX2, %lld by AVX-512\n",
         (long long)totals.by_instructions[RIIS_INSTRUCTIONS_BASELINE],
         (long long)totals.by_instructions[RIIS_INSTRUCTIONS_AVX2],
         (long long)totals.by_instructions[RIIS_INSTRUCTIONS_AVX512]);
  printf(
      "%lld pairs of node and surface by brute force, %lld within the limit: %lld distances and %lld marks differ; "
      "%lld too close to "
      "decide; largest error %.2g of the coordinates\n",
      (long long)totals.pairs, (long long)totals.pairs_within, (long long)totals.different_distances,
      (long long)totals.different_marks, (long long)totals.undecided, totals.largest);
  assert_int_equal(totals.different_bits, 0);
  assert_int_equal(totals.incomplete, 0);
  assert_int_equal(totals.different_distances, 0);
  assert_int_equal(totals.different_marks, 0);
  /* The cases are not trivial. */
  assert_true(totals.pairs >= (is_long ? n_pairs : 50000));
  assert_true(totals.pairs_within > totals.pairs / 50);
  assert_true(totals.undecided < totals.pairs / 1000);
}

/* Brute force with boxes equals the plain loop. */
static void boxes_leave_nothing_out(void **state) {
  (void)state;
  for (int trial = 0; trial < 12; ++trial) {
    shape s = random_shape();
    riis_surface *surface = NULL;
    update_surface(&surface, &s, NULL);
    const riis_surface_info info = info_of(surface);
    brute_force b = brute_force_of(surface);
    int64_t n_triangles;
    const int64_t *vertex_id;
    const double *vertices;
    CHECK_OK(riis_surface_vertices(surface, NULL, &vertices));
    CHECK_OK(riis_surface_triangles(surface, &n_triangles, &vertex_id, NULL, NULL, NULL));
    for (int k = 0; k < 40; ++k) {
      double p[3];
      int64_t triangle;
      for (int c = 0; c < 3; ++c) p[c] = random_between(&rng, info.lower[c] - 0.5, info.upper[c] + 0.5);
      const long double expected = oracle_distance(p, n_triangles, vertex_id, vertices, &triangle);
      const double reach = random_between(&rng, 0, 1);
      assert_true(brute_force_distance(&b, p, 1e9) == expected);
      const long double got = brute_force_distance(&b, p, reach);
      assert_true(expected <= reach ? got == expected : got > reach);
    }
    free_brute_force(&b);
    free_shape(&s);
    riis_surface_destroy(&surface);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boxes_leave_nothing_out),
      cmocka_unit_test(random_cases_equal_brute_force),
  };
  rng = random_start("test_search_suite");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
