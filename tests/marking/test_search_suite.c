/* SPDX-License-Identifier: Apache-2.0
 * Compares the neighbour search with the exhaustive search bit by bit. Some nodes are also compared with brute force in extended
 * precision. Meshes, surfaces, placements, half thicknesses, limits, masks and threads are random. RIIS_TEST_LONG=1 continues
 * until brute force has checked ten million pairs of a node and a surface. */
#include <riis/riis.h>

#include "oracle.h"
#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "random_meshes.h"

/* --- Brute force ------------------------------------------------------------------------------------------------------ */

/* Triangles are grouped into blocks with bounding boxes. A block or a triangle is skipped if its box is farther than the closest
 * triangle so far by more than rounding could cause. The distance of every other triangle is computed in extended precision. */
enum { per_block = 16 };
typedef struct brute_force {
  int64_t n;
  double *corners; /* (9, n) */
  double *boxes;   /* (6, n): lower and upper corners */
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
  const double *vertices = triangles_of(surface).xyz;
  b.n = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  b.corners = own(malloc((size_t)b.n * 9 * sizeof(double)));
  b.boxes = own(malloc((size_t)b.n * 6 * sizeof(double)));
  b.blocks = own(malloc((size_t)(b.n / per_block + 1) * 6 * sizeof(double)));
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

/* Returns the square of the distance to a box. */
static double to_box_sq(const double *p, const double *box) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = fmax(fmax(box[c] - p[c], p[c] - box[3 + c]), 0);
    sum += d * d;
  }
  return sum;
}

/* Returns the distance to the closest triangle if it is at most `reach`. Otherwise returns any number above `reach`. */
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

/* --- Surfaces --------------------------------------------------------------------------------------------------------- */

typedef struct placement {
  double axis[3], angle, translation[3]; /* unit axis, angle in degrees */
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
  for (int64_t i = 0; i < mesh->n; ++i) { /* Rodrigues' formula: v cos + (axis x v) sin + axis (axis . v) (1 - cos) */
    double *to = mesh->xyz + 3 * i;
    const double v[3] = {to[0], to[1], to[2]}, along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      to[c] = v[c] * k + (axis[d] * v[e] - axis[e] * v[d]) * s + axis[c] * along * (1 - k) + p->translation[c];
    }
  }
}

/* A valve or triangles, from which surfaces at other positions can be made. */
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
  s.valve = new_valve(s.is_mitral ? "mitral" : "aortic");
  s.opening = random_between(&rng, 0, 1);
  s.step = random_between(&rng, -0.2, 0.2);
  return s;
}

/* Makes the surface, or updates it to a later step. */
static void update_surface(riis_surface **surface, shape *s, const riis_surface_options *options) {
  if (s->valve) {
    s->opening += s->step;
    if (s->opening < 0 || s->opening > 1) s->step = -s->step, s->opening = fmin(1, fmax(0, s->opening));
    if (s->is_mitral) CHECK_OK(riis_valve_set_scalar(s->valve, "opening", s->opening));
    if (*surface)
      CHECK_OK(riis_surface_update(*surface, s->valve, options));
    else
      *surface = new_surface(s->valve, options);
  } else {
    for (int64_t i = 0; i < 9 * s->n_triangles; ++i) s->xyz[i] += random_between(&rng, -0.01, 0.01);
    const riis_surface_arrays arrays = triangle_arrays(3 * s->n_triangles, s->xyz, s->n_triangles, s->ids);
    if (*surface)
      CHECK_OK(riis_surface_update_from_arrays(*surface, &arrays, options));
    else
      *surface = surface_from(&arrays, options);
  }
}

/* --- The suite -------------------------------------------------------------------------------------------------------- */

static struct totals {
  int64_t meshes[n_kinds], markings, nodes, pairs, pairs_within, marked, undecided;
  int64_t different_bits, different_distances, different_marks, incomplete;
  int64_t unreached, most_threads;
  int64_t by_instructions[RIIS_INSTRUCTIONS_AVX512 + 1]; /* number of markings over clusters */
  double largest;                                        /* the largest error, relative to the coordinates */
} totals;

/* Compares some of the nodes with brute force. */
static void compare_with_brute_force(const riis_surface *surface, const test_mesh *nodes, const uint8_t *mask,
                                     const riis_marks *result, double limit, int64_t n_wanted) {
  const int owned_before = n_owned();
  const double half_thickness = info_of(surface).half_thickness;
  brute_force b = brute_force_of(surface);
  double size = 1;
  for (int64_t k = 0; k < 9 * b.n; ++k) size = fmax(size, fabs(b.corners[k]));
  uint8_t *mark = own(malloc((size_t)nodes->n));
  double *distance = own(malloc((size_t)nodes->n * sizeof *distance));
  CHECK_OK(dense_of(result, nodes->n, 1e30, mark, distance, NULL, NULL));
  const int64_t stride = n_wanted < nodes->n ? nodes->n / n_wanted : 1, first = random_integer(0, stride - 1);
  int64_t pairs = 0, within = 0, undecided = 0, bad_distances = 0, bad_marks = 0;
  double largest = 0;
#pragma omp parallel for num_threads(2) schedule(dynamic, 64) reduction(max : largest) \
    reduction(+ : pairs, within, undecided, bad_distances, bad_marks)
  for (int64_t i = first; i < nodes->n; i += stride) {
    if (mask && !mask[i]) { /* masked nodes must be left out, wherever they are */
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
  free_owned_after(owned_before);
}

/* Checks that the search over clusters gives the exhaustive search's result bit by bit, with every instruction set. */
static void compare_clusters(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *asked,
                             const riis_marks *exhaustive, riis_marks *clustered) {
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
  const int owned_before = n_owned();
  shape s = random_shape();
  riis_surface *surface = NULL;
  update_surface(&surface, &s, NULL);
  /* The box contains the surface, or the surface extends beyond the box. */
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
  riis_marks *neighbor = new_result(), *exhaustive = new_result(), *clustered = new_result();
  uint8_t *mask = NULL;
  for (int64_t step = 0, n_steps = random_integer(1, 4); step < n_steps; ++step) {
    update_surface(&surface, &s, &options);
    if (step > 0 && one_in(4)) { /* here the mesh also moves */
      for (int64_t i = 0; i < 3 * nodes.n; ++i) nodes.xyz[i] += random_between(&rng, -0.1, 0.1) * spacing;
      CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
    }
    mask = NULL;
    if (one_in(3)) {
      const uint64_t share = (uint64_t)random_integer(0, 8);
      mask = own(malloc((size_t)nodes.n));
      for (int64_t i = 0; i < nodes.n; ++i) mask[i] = random_bits(&rng) % 8 < share;
    }
    riis_mark_options marking = mark_options();
    marking.node_mask = mask;
    double limit = options.half_thickness;
    if (one_in(3)) limit = marking.distance_limit = limit * pow(10, random_between(&rng, 0, 2));
    if (one_in(8)) limit = marking.distance_limit = 1e20; /* every distance */
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
  free_owned_after(owned_before);
}

/* Brute force with boxes must give the distances of a plain loop. */
TEST(boxes_leave_nothing_out) {
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    shape s = random_shape();
    riis_surface *surface = NULL;
    update_surface(&surface, &s, NULL);
    const riis_surface_info info = info_of(surface);
    brute_force b = brute_force_of(surface);
    const double *vertices = triangles_of(surface).xyz;
    const int64_t n_triangles = triangles_of(surface).n_triangles;
    const int64_t *vertex_id = triangles_of(surface).vertex_id;
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
    free_owned_after(owned_before);
  }
}

TEST(random_cases_equal_brute_force) {
  const int is_long = is_long_test();
  const int64_t n_cases = trials_of(140), n_pairs = is_long ? 10000000 : 0;
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
  /* The random cases must not be trivial. */
  CHECK_MET(totals.pairs >= (is_long ? n_pairs : trials_of(50000)));
  CHECK_MET(totals.pairs_within > totals.pairs / 50);
  CHECK_MET(totals.undecided < totals.pairs / 1000);
}

int main(void) {
  rng = random_start("test_search_suite");
  return run_cases(NULL, NULL);
}
