/* SPDX-License-Identifier: Apache-2.0
 * Tests velocities of nodes that are equally near to several leaflets, or to several patches of one leaflet. A node with such a
 * tie gets the mean velocity that a loop over all triangles gives. Every search gives the same bits. If a symmetric mesh is moved
 * by a rounding error or split into parts, the sums of K and K u stay the same. Nodes without ties have the velocity of their
 * closest triangle. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "oracle.h"
#include "searches.h"
#include "tie_oracle.h"

static random_source rng;

static int64_t any_of(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }
static double between(double low, double high) { return random_between(&rng, low, high); }

static riis_mark_list fields_in(const riis_marks *result) {
  riis_mark_list fields;
  CHECK_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
  return fields;
}

enum { n_kinds = 5 };
static const char *const kinds[n_kinds] = {"trileaflet", "mitral", "bileaflet", "aortic", "coapting"};

/* Makes a valve that moves from one opening to another. */
static riis_surface *moving_surface(const char *kind, double now, double before, const riis_surface_options *options) {
  riis_valve *valve = new_valve(kind), *earlier = new_valve(kind);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", now));
  CHECK_OK(riis_valve_set_scalar(earlier, "opening", before));
  riis_surface *surface = new_surface(valve, options);
  CHECK_OK(riis_surface_update_moving(surface, valve, earlier, between(0.01, 1), NULL, NULL));
  return surface;
}

/* Turns (3, n) points by an angle around the z axis, then moves them. */
static void place(int64_t n, double *xyz, double degrees, const double *offset) {
  const double c = cos(degrees * acos(-1) / 180), s = sin(degrees * acos(-1) / 180);
  for (int64_t i = 0; i < n; ++i) {
    double *p = xyz + 3 * i, x = p[0], y = p[1];
    p[0] = c * x - s * y + offset[0], p[1] = s * x + c * y + offset[1], p[2] += offset[2];
  }
}

/* Returns the centres of cells around a surface. Some centres lie in the planes of symmetry x = 0 and y = 0. */
static test_mesh symmetric_cells(const riis_surface *surface, double spacing) {
  const riis_surface_info info = info_of(surface);
  const double margin = 1.5 * info.half_thickness;
  double lower[3], upper[3];
  int64_t counts[3];
  for (int c = 0; c < 3; ++c) {
    const double reach = fmax(fabs(info.lower[c]), fabs(info.upper[c])) + margin;
    counts[c] = 1 + 2 * (int64_t)ceil(reach / spacing);
    lower[c] = -spacing * (double)(counts[c] / 2), upper[c] = -lower[c];
  }
  lower[2] = info.lower[2] - margin, upper[2] = info.upper[2] + margin;
  counts[2] = 1 + (int64_t)ceil((upper[2] - lower[2]) / spacing);
  test_mesh mesh = lattice(counts, lower, upper);
  /* The lattice's coordinates are rounded with a bias, so they are made symmetric. */
  for (int64_t i = 0; i < mesh.n; ++i) {
    mesh.xyz[3 * i] = spacing * (double)(i % counts[0] - counts[0] / 2);
    mesh.xyz[3 * i + 1] = spacing * (double)(i / counts[0] % counts[1] - counts[1] / 2);
  }
  return mesh;
}

static riis_marks *marked(const riis_surface *surface, riis_mesh *mesh, int32_t fields, int32_t search) {
  riis_mark_options options = mark_options();
  options.fields = fields;
  options.search = search;
  options.n_threads = 1;
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  return result;
}

/* --- Against the loop ------------------------------------------------------------------------------------------------ */

typedef struct tie_counts {
  int64_t nodes, leaflets, three, places, unclear;
} tie_counts;

/* Compares velocities with the oracle's, and counts the ties. */
static void check_velocities(const riis_surface *surface, const test_mesh *mesh, const riis_marks *result,
                             tie_counts *counts) {
  const riis_triangles content = triangles_of(surface);
  const double *velocity = velocity_of(surface), half_thickness = info_of(surface).half_thickness,
               largest = largest_velocity(&content, velocity);
  const found_nodes nodes = within_in(result);
  const riis_mark_list fields = fields_in(result);
  for (int64_t i = 0; i < nodes.n; ++i) {
    const double *p = mesh->xyz + 3 * nodes.node_id[i], *v = fields.velocity + 3 * i;
    const tied_velocity expected = tied_velocity_at(&content, velocity, p, nodes.distance[i], half_thickness);
    ++counts->nodes;
    counts->unclear += !expected.is_clear;
    if (!expected.is_clear) continue;
    counts->leaflets += expected.n_leaflets > 1;
    counts->three += expected.n_leaflets > 2;
    counts->places += expected.n_places > expected.n_leaflets;
    for (int c = 0; c < 3; ++c)
      if (!(fabs(v[c] - expected.mean[c]) <= 1e-9 * largest))
        fail_msg("velocity %d is %.17g, not %.17g, at (%.17g %.17g %.17g) with %d leaflets and %d places", c, v[c],
                 expected.mean[c], p[0], p[1], p[2], expected.n_leaflets, expected.n_places);
  }
}

/* Checks that other searches, threads and instructions give the same bits. A marking without velocities must give the same bits
 * in all other arrays. */
static void check_searches(const riis_surface *surface, const test_mesh *from, const riis_marks *expected) {
  static const int32_t searches[] = {RIIS_SEARCH_EXHAUSTIVE, RIIS_SEARCH_NEIGHBOR, RIIS_SEARCH_CLUSTERS};
  const int64_t n = within_in(expected).n;
  const riis_mark_list fields = fields_in(expected);
  riis_mesh *mesh = mesh_from(from);
  riis_marks *result = new_result();
  for (int k = 0; k < 12; ++k) {
    riis_mark_options options = mark_options();
    options.search = searches[k % 3];
    options.n_threads = (int32_t)(1 + any_of(4));
    options.instructions = (int32_t)(k / 3);
    options.fields = RIIS_FIELD_VELOCITY;
    const riis_status status = riis_mark_nodes(surface, mesh, &options, result);
    if (status == RIIS_UNAVAILABLE) continue;
    CHECK_OK(status);
    assert_true(same_results(expected, result));
    assert_memory_equal(fields.velocity, fields_in(result).velocity, (size_t)n * 24);
  }
  const int32_t others = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_SIDE;
  const riis_marks *without = marked(surface, mesh, others, RIIS_SEARCH_CLUSTERS),
                   *with = marked(surface, mesh, others | RIIS_FIELD_VELOCITY, RIIS_SEARCH_CLUSTERS);
  const riis_mark_list a = fields_in(without), b = fields_in(with);
  assert_true(same_results(without, with));
  assert_memory_equal(a.point, b.point, (size_t)n * 24);
  assert_memory_equal(a.normal, b.normal, (size_t)n * 24);
  assert_memory_equal(a.barycentric, b.barycentric, (size_t)n * 24);
  assert_memory_equal(a.side, b.side, (size_t)n * 4);
  assert_memory_equal(b.velocity, fields.velocity, (size_t)n * 24);
  /* Ties are also right for nodes at any other distance. */
  riis_marks *all[2];
  for (int k = 0; k < 2; ++k) {
    riis_mark_options options = mark_options();
    options.search = k ? RIIS_SEARCH_CLUSTERS : RIIS_SEARCH_EXHAUSTIVE;
    options.distance_limit = 1e60;
    options.fields = RIIS_FIELD_VELOCITY;
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, all[k] = new_result()));
  }
  assert_true(same_results(all[0], all[1]));
  assert_int_equal(within_in(all[1]).n, from->n);
  assert_memory_equal(fields_in(all[0]).velocity, fields_in(all[1]).velocity, (size_t)from->n * 24);
}

TEST(valves_have_the_means_of_their_leaflets) {
  tie_counts all = {0, 0, 0, 0, 0};
  for (int trial = 0; trial < trials_of(6 * n_kinds); ++trial) {
    const int owned_before = n_owned();
    const double now = trial < n_kinds ? 0 : between(0, 1), before = between(0, 1);
    riis_surface_options options = surface_options();
    options.tolerance = 0.2;
    options.rotation_angle = trial % 3 ? between(-180, 180) : 0;
    for (int c = 0; c < 3; ++c) options.translation[c] = trial % 3 ? between(-2, 2) : 0;
    riis_surface *surface = moving_surface(kinds[trial % n_kinds], now, before, NULL);
    test_mesh mesh = symmetric_cells(surface, between(0.09, 0.12));
    riis_surface *placed = moving_surface(kinds[trial % n_kinds], now, before, &options);
    place(mesh.n, mesh.xyz, options.rotation_angle, options.translation);
    const riis_marks *result = marked(placed, mesh_from(&mesh), RIIS_FIELD_VELOCITY, RIIS_SEARCH_EXHAUSTIVE);
    check_velocities(placed, &mesh, result, &all);
    check_searches(placed, &mesh, result);
    free_owned_after(owned_before);
  }
  printf("%lld nodes: %lld have several leaflets, %lld three, %lld several places of one, %lld are not clear\n",
         (long long)all.nodes, (long long)all.leaflets, (long long)all.three, (long long)all.places,
         (long long)all.unclear);
  CHECK_MET(all.leaflets > 100 && all.places > 100);
  CHECK_MET((double)all.unclear <= 0.02 * (double)all.nodes);
}

/* Random triangles occur three times, with permuted coordinates. A node on the diagonal is equally far from the three copies. */
TEST(three_leaflets_of_arrays_count_alike) {
  tie_counts all = {0, 0, 0, 0, 0};
  for (int trial = 0; trial < trials_of(90); ++trial) {
    const int owned_before = n_owned();
    const int64_t n = 1 + any_of(40), n_nodes = 600;
    double *xyz, *velocity = own(malloc((size_t)n * 27 * sizeof *velocity));
    int32_t *ids, *leaflet_id = own(malloc((size_t)n * 3 * sizeof *leaflet_id));
    random_soup(&rng, 3 * n, 0.3, &xyz, &ids);
    for (int64_t i = 0; i < 9 * n; ++i) velocity[i] = between(-1, 1);
    for (int turn = 1; turn < 3; ++turn)
      for (int64_t i = 0; i < 9 * n; ++i) {
        xyz[9 * n * turn + i] = xyz[i - i % 3 + (i + turn) % 3];
        velocity[9 * n * turn + i] = between(-1, 1);
      }
    for (int64_t i = 0; i < 3 * n; ++i) leaflet_id[i] = (int32_t)(i / n * 5 % 7);
    riis_surface_arrays arrays = triangle_arrays(9 * n, xyz, 3 * n, ids);
    arrays.leaflet_id = leaflet_id;
    arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2, arrays.velocity_stride = 3;
    riis_surface_options options = surface_options();
    options.half_thickness = between(0.2, 0.5);
    riis_surface *surface = surface_from(&arrays, &options);
    test_mesh mesh = {.n = n_nodes};
    mesh.xyz = own(malloc((size_t)n_nodes * 3 * sizeof *mesh.xyz));
    for (int64_t i = 0; i < n_nodes; ++i) {
      const double middle = between(-1.2, 1.2);
      for (int c = 0; c < 3; ++c) mesh.xyz[3 * i + c] = i % 2 ? middle : middle + between(-0.5, 0.5);
    }
    int64_t *pairs = own(malloc((size_t)n_nodes * 2 * sizeof *pairs));
    for (int64_t i = 0; i + 1 < n_nodes; ++i) pairs[2 * i] = i, pairs[2 * i + 1] = i + 1;
    set_rows(&mesh, n_nodes - 1, pairs);
    const riis_marks *result = marked(surface, mesh_from(&mesh), RIIS_FIELD_VELOCITY, RIIS_SEARCH_EXHAUSTIVE);
    if (within_in(result).n > 0) {
      check_velocities(surface, &mesh, result, &all);
      check_searches(surface, &mesh, result);
    }
    free_owned_after(owned_before);
  }
  printf("%lld nodes: %lld have three leaflets\n", (long long)all.nodes, (long long)all.three);
  CHECK_MET(all.three > 100);
}

/* --- Rounding -------------------------------------------------------------------------------------------------------- */

typedef struct term {
  double *k, *ku; /* k: (n), ku: (3, n) */
} term;

/* Computes K and K u of the whole mesh. The mesh is marked in parts that have separate coordinates. Each node is moved by `shift`
 * along each axis. */
static term term_of(const riis_surface *surface, const test_mesh *mesh, int n_parts, double shift) {
  const size_t n = (size_t)mesh->n;
  term made = {own(calloc(n, sizeof(double))), own(calloc(3 * n, sizeof(double)))};
  double *xyz = own(malloc(3 * n * sizeof *xyz));
  for (size_t i = 0; i < 3 * n; ++i) xyz[i] = mesh->xyz[i] + shift;
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1;
  for (int part = 0; part < n_parts; ++part) {
    const int64_t begin = mesh->n * part / n_parts, m = mesh->n * (part + 1) / n_parts - begin;
    riis_marks *result = marked(surface, mesh_of(m, xyz + 3 * begin), RIIS_FIELD_VELOCITY,
                                part % 2 ? RIIS_SEARCH_CLUSTERS : RIIS_SEARCH_AUTO);
    CHECK_OK(add_resistance_to(result, &resistance, m, made.k + begin, made.ku + 3 * begin));
  }
  return made;
}

static double largest_of(const double *a, size_t n) {
  double largest = 0;
  for (size_t i = 0; i < n; ++i) largest = fmax(largest, fabs(a[i]));
  return largest;
}

static double largest_difference(const double *a, const double *b, size_t n) {
  double largest = 0;
  for (size_t i = 0; i < n; ++i) largest = fmax(largest, fabs(a[i] - b[i]));
  return largest;
}

TEST(rounding_does_not_change_k_u) {
  for (int trial = 0; trial < trials_of(12 * n_kinds); ++trial) {
    const int owned_before = n_owned();
    const char *kind = kinds[trial % n_kinds];
    const double now = trial < n_kinds ? 0 : between(0, 1), before = trial < 2 * n_kinds ? 0.01 : between(0, 1);
    riis_surface *surface = moving_surface(kind, now, before, NULL);
    const test_mesh mesh = symmetric_cells(surface, trial < n_kinds ? 0.1 : between(0.05, 0.15));
    const size_t n = (size_t)mesh.n;
    const term whole = term_of(surface, &mesh, 1, 0);
    const double k = largest_of(whole.k, n), ku = largest_of(whole.ku, 3 * n);
    for (int n_parts = 1; n_parts <= 3; ++n_parts)
      for (int way = -1; way <= 1; ++way) {
        const term other = term_of(surface, &mesh, n_parts, 1e-12 * way);
        CHECK_AT_MOST(largest_difference(whole.k, other.k, n), 1e-9 * k);
        const double off = largest_difference(whole.ku, other.ku, 3 * n);
        if (!(off <= 1e-9 * ku))
          fail_msg("%s at %g, %lld cells, %d parts moved by %g: K u differs by %.3g of its largest value", kind, now,
                   (long long)mesh.n, n_parts, 1e-12 * way, off / ku);
        if (way == 0) assert_true(memcmp(whole.ku, other.ku, 3 * n * sizeof *other.ku) == 0);
      }
    free_owned_after(owned_before);
  }
}

/* The reaction of a flow at rest is the weighted sum of -K u. */
TEST(reaction_takes_the_means) {
  riis_surface *surface = moving_surface("trileaflet", 0, 0.01, NULL);
  const test_mesh mesh = symmetric_cells(surface, 0.1);
  const size_t n = (size_t)mesh.n;
  double *flow = own(calloc(3 * n, sizeof *flow)), *weight = own(malloc(n * sizeof *weight)), force[3] = {0, 0, 0};
  for (size_t i = 0; i < n; ++i) weight[i] = between(0, 1);
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1;
  CHECK_OK(add_reaction_to(marked(surface, mesh_of(mesh.n, mesh.xyz), RIIS_FIELD_VELOCITY, RIIS_SEARCH_AUTO),
                           &resistance, mesh.n, flow, weight, force));
  for (int way = -1; way <= 1; ++way) {
    const term moved = term_of(surface, &mesh, 2, 1e-12 * way);
    for (size_t c = 0; c < 3; ++c) {
      double expected = 0, size = 0;
      for (size_t i = 0; i < n; ++i) expected -= weight[i] * moved.ku[3 * i + c], size += fabs(moved.ku[3 * i + c]);
      CHECK_NEAR(force[c], expected, 1e-9 * size);
    }
  }
}

/* --- Nodes without ties ---------------------------------------------------------------------------------------------- */

/* If the same triangles come from arrays, they form one leaflet, so no node has a tie. Each node has the velocity of its closest
   triangle. */
TEST(other_nodes_have_the_closest_triangle_s) {
  int64_t n_single = 0, n_other = 0;
  for (int trial = 0; trial < trials_of(6 * n_kinds); ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    options.tolerance = 0.2;
    riis_surface *surface = moving_surface(kinds[trial % n_kinds], trial < n_kinds ? 0 : between(0, 1), 0.01, &options);
    const riis_triangles content = triangles_of(surface);
    const double *velocity = velocity_of(surface), half_thickness = info_of(surface).half_thickness;
    int32_t *ids = own(malloc((size_t)content.n_triangles * 3 * sizeof *ids));
    for (int64_t i = 0; i < 3 * content.n_triangles; ++i) ids[i] = (int32_t)content.vertex_id[i];
    riis_surface_arrays arrays = triangle_arrays(content.n_vertices, content.xyz, content.n_triangles, ids);
    arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2, arrays.velocity_stride = 3;
    const test_mesh from = symmetric_cells(surface, between(0.08, 0.12));
    riis_mesh *mesh = mesh_of(from.n, from.xyz);
    const riis_marks *result = marked(surface, mesh, RIIS_FIELD_VELOCITY, RIIS_SEARCH_CLUSTERS),
                     *plain = marked(surface_from(&arrays, NULL), mesh, RIIS_FIELD_VELOCITY, RIIS_SEARCH_CLUSTERS);
    const found_nodes a = within_in(result), b = within_in(plain);
    assert_int_equal(a.n, b.n);
    for (int64_t i = 0; i < a.n; ++i) {
      const double *v = fields_in(result).velocity + 3 * i, *w = fields_in(plain).velocity + 3 * i;
      const tied_velocity at =
          tied_velocity_at(&content, velocity, from.xyz + 3 * a.node_id[i], a.distance[i], half_thickness);
      if (!at.is_clear) continue;
      if (at.n_places > 1) {
        n_other += memcmp(v, w, 24) != 0;
        continue;
      }
      ++n_single;
      assert_memory_equal(v, w, 24);
    }
    free_owned_after(owned_before);
  }
  CHECK_MET(n_single > 1000 && n_other > 10);
}

/* The sheets are z = 0 and z = 2. A node is nearer to one sheet by a given fraction of the half thickness. */
TEST(ties_end_at_a_millionth) {
  static const struct {
    double nearer;
    int ties, of_one_leaflet;
  } cases[] = {{0, 1, 0},       {0.9e-6, 1, 0}, {-0.9e-6, 1, 0}, {1.1e-6, 0, 0},
               {-1.1e-6, 0, 0}, {1e-3, 0, 0},   {0, 0, 1},       {0.9e-9, 0, 1}};
  static const int32_t ids[6] = {0, 1, 2, 3, 4, 5};
  static const double velocity[18] = {1, 2, 3, 1, 2, 3, 1, 2, 3, -5, 0, 4, -5, 0, 4, -5, 0, 4},
                      xyz[18] = {-9, -9, 0, 9, -9, 0, 0, 9, 0, -9, -9, 2, 9, -9, 2, 0, 9, 2};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    const int32_t leaflet_id[2] = {0, cases[k].of_one_leaflet ? 0 : 3};
    riis_surface_arrays arrays = triangle_arrays(6, xyz, 2, ids);
    arrays.leaflet_id = leaflet_id;
    arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2, arrays.velocity_stride = 3;
    riis_surface_options options = surface_options();
    options.half_thickness = 1.5;
    riis_surface *surface = surface_from(&arrays, &options);
    const double p[3] = {0.25, 0.5, 1 - 0.5 * 1.5 * cases[k].nearer};
    const riis_marks *result = marked(surface, mesh_of(1, p), RIIS_FIELD_VELOCITY, RIIS_SEARCH_CLUSTERS);
    assert_int_equal(within_in(result).n, 1);
    const double *v = fields_in(result).velocity, *of_closest = velocity + (cases[k].nearer < 0 ? 9 : 0);
    for (int c = 0; c < 3; ++c) {
      const double mean = 0.5 * (velocity[c] + velocity[9 + c]);
      CHECK_NEAR(v[c], cases[k].ties ? mean : of_closest[c], 1e-14);
    }
  }
}

int main(void) {
  rng = random_start("test_ties");
  return run_cases(NULL, NULL);
}
