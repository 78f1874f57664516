/* SPDX-License-Identifier: Apache-2.0
 * Tests the attachment of valves. Attached edges must be the edges of triangles along attached sides, and each edge must belong
 * to only one triangle. The edges must form lines from root to commissure, or one line round the annulus. Mirrored halves must be
 * equally long, and a parabola must have its known length. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "shapes.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

static riis_attachment attachment_of(const riis_surface *surface) {
  riis_attachment attachment;
  CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
  return attachment;
}

static riis_surface_options placed(int32_t triangulation, double scale) {
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.scale = scale;
  options.rotation_angle = between(-180, 180);
  for (int c = 0; c < 3; ++c) options.rotation_axis[c] = between(0.1, 1), options.translation[c] = between(-5, 5);
  return options;
}

static riis_valve *valve_of(const char *kind, double opening) {
  riis_valve *valve = new_valve(kind);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  if (strcmp(kind, "bileaflet") == 0) CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0.6));
  return valve;
}

static double edge_length(const double *edge) {
  return sqrt(pow(edge[3] - edge[0], 2) + pow(edge[4] - edge[1], 2) + pow(edge[5] - edge[2], 2));
}

/* --- Against a count of edges ---------------------------------------------------------------------------------------- */

/* An edge has two end points in a fixed order, a leaflet and a patch. */
typedef struct {
  double ends[2][3];
  int32_t leaflet_id, patch_id;
} placed_edge;

static placed_edge edge_between(const double *a, const double *b, int32_t leaflet_id, int32_t patch_id) {
  placed_edge edge = {.leaflet_id = leaflet_id, .patch_id = patch_id};
  const int turned = memcmp(a, b, 3 * sizeof *a) > 0;
  memcpy(edge.ends[turned], a, 3 * sizeof *a);
  memcpy(edge.ends[!turned], b, 3 * sizeof *b);
  for (int end = 0; end < 2; ++end)
    for (int c = 0; c < 3; ++c) edge.ends[end][c] += 0.0; /* -0 is 0 */
  return edge;
}
static int by_place(const void *a, const void *b) {
  return memcmp(((const placed_edge *)a)->ends, ((const placed_edge *)b)->ends, sizeof((const placed_edge *)a)->ends);
}

/* Tells whether a vertex lies on the attached side of its patch. A cusp's root is a special case, because the whole side v = 0 of
 * a lower patch is the root point. */
static int is_held(const char *kind, int32_t patch_id, const double *uv) {
  return strcmp(kind, "mitral") == 0 ? uv[1] == 0 : uv[0] == 1 || (patch_id % 2 == 0 && uv[1] == 0);
}

TEST(edges_are_those_of_one_triangle_on_the_side) {
  static const char *const kinds[4] = {"aortic", "trileaflet", "mitral", "coapting"};
  for (int trial = 0; trial < trials_of(72); ++trial) {
    const int owned_before = n_owned();
    const char *kind = kinds[trial / 2 % 4];
    const riis_surface_options options = placed(trial % 2, between(0.5, 2));
    riis_surface *surface = new_surface(valve_of(kind, trial < 8 ? 0 : between(0, 1)), &options);
    const riis_triangles all = triangles_of(surface);
    placed_edge *edges = own(malloc((size_t)all.n_triangles * 3 * sizeof *edges));
    int64_t n = 0, n_expected = 0;
    for (int64_t i = 0; i < all.n_triangles; ++i)
      for (int k = 0; k < 3; ++k) {
        const int64_t a = all.vertex_id[3 * i + k], b = all.vertex_id[3 * i + (k + 1) % 3];
        if (is_held(kind, all.patch_id[i], all.uv + 2 * a) && is_held(kind, all.patch_id[i], all.uv + 2 * b))
          edges[n++] = edge_between(all.xyz + 3 * a, all.xyz + 3 * b, all.leaflet_id[i], all.patch_id[i]);
      }
    qsort(edges, (size_t)n, sizeof *edges, by_place);
    for (int64_t i = 0; i < n; ++i) { /* edges that occur only once move to the front */
      if (i > 0 && by_place(edges + i - 1, edges + i) == 0)
        fail_msg("two triangles have an edge on a side that is held");
      edges[n_expected++] = edges[i];
    }
    const riis_attachment got = attachment_of(surface);
    assert_int_equal(got.n_edges, n_expected);
    assert_true(got.n_edges >= (trial / 2 % 4 == 2 ? 20 : 12));
    for (int64_t i = 0; i < got.n_edges; ++i) {
      const double *ends = got.edges + 6 * i;
      const placed_edge here = edge_between(ends, ends + 3, got.leaflet_id[i], got.patch_id[i]);
      const placed_edge *same = bsearch(&here, edges, (size_t)n_expected, sizeof *edges, by_place);
      if (!same) fail_msg("edge %lld of the %s valve is no edge of a triangle", (long long)i, kind);
      assert_true(same->leaflet_id == here.leaflet_id && same->patch_id == here.patch_id);
      for (int end = 0; end < 2; ++end)
        assert_memory_equal(ends + 3 * end, all.xyz + 3 * got.vertex_id[2 * i + end], 3 * sizeof *ends);
      /* In each patch, an edge begins at the end of the edge before. */
      if (i == 0) continue;
      assert_true(got.patch_id[i] >= got.patch_id[i - 1]);
      if (got.patch_id[i] == got.patch_id[i - 1]) assert_memory_equal(ends, ends - 3, 3 * sizeof *ends);
    }
    free_owned_after(owned_before);
  }
}

/* --- Against the tables ---------------------------------------------------------------------------------------------- */

/* Each of three equal cusps has two mirrored halves. Each half has a line from the root to a commissure, where the next cusp
 * begins. The mitral annulus is one loop along both leaflets. Every end of an edge is also the end of another edge. */
TEST(attachments_are_closed_lines) {
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    const int is_mitral = trial % 3 == 2;
    const riis_surface_options options = placed(trial % 2, between(0.5, 2));
    riis_surface *surface = new_surface(valve_of(is_mitral   ? "mitral"
                                                 : trial % 3 ? "coapting"
                                                             : "trileaflet",
                                                 between(0, 1)),
                                        &options);
    const riis_attachment got = attachment_of(surface);
    double of_patch[12] = {0}, total = 0;
    for (int64_t i = 0; i < 2 * got.n_edges; ++i) {
      int n_here = 0;
      for (int64_t k = 0; k < 2 * got.n_edges; ++k) {
        const double between_ends[6] = {got.edges[3 * i], got.edges[3 * i + 1], got.edges[3 * i + 2],
                                        got.edges[3 * k], got.edges[3 * k + 1], got.edges[3 * k + 2]};
        n_here += edge_length(between_ends) < 1e-9;
      }
      assert_int_equal(n_here, 2);
    }
    for (int64_t i = 0; i < got.n_edges; ++i) {
      of_patch[got.patch_id[i]] += edge_length(got.edges + 6 * i);
      total += edge_length(got.edges + 6 * i);
      if (is_mitral)
        assert_int_equal(got.leaflet_id[i], got.patch_id[i] < 6 ? RIIS_LEAFLET_ANTERIOR : RIIS_LEAFLET_POSTERIOR);
      else
        assert_int_equal(got.leaflet_id[i], got.patch_id[i] / 4);
    }
    for (int k = 0; k < 12 && !is_mitral; ++k) CHECK_NEAR(of_patch[k], of_patch[k % 2], 1e-9 * total);
    free_owned_after(owned_before);
  }
}

/* The attachment of a square patch is its side v = 0. A bent side has several edges. A side that two patches share is not
 * attached. A bileaflet valve has no attachment. */
TEST(patches_are_held_at_v_0) {
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const riis_surface_options options = placed(trial % 2, 2);
    shape squares = unit_square();
    squares.leaflet_id[0] = 3;
    /* The side v = 0 of the second square is the side v = 1 of the first square. */
    add_line(&squares, 0, 2, 0, 1, 2, 0), add_line(&squares, 0, 1, 0, 0, 2, 0), add_line(&squares, 1, 1, 0, 1, 2, 0);
    add_patch(&squares, 1, 4, 5, 6);
    if (trial >= 4) { /* v = 0 is an arch */
      squares.degree[0] = 2;
      static const double arch[3][3] = {{0, 0, 0}, {0.5, -0.5, 0}, {1, 0, 0}};
      memcpy(squares.control[0], arch, sizeof arch);
    }
    riis_surface *surface = surface_of(&squares, &options);
    const riis_attachment got = attachment_of(surface);
    double length = 0;
    for (int64_t i = 0; i < got.n_edges; ++i) {
      assert_true(got.leaflet_id[i] == 3 && got.patch_id[i] == 0);
      length += edge_length(got.edges + 6 * i);
    }
    /* The parabola has the width 1, the height 1/4 and the slope 1 at its end. The parabola's length is (sqrt(2) + asinh(1)) /
     * 2. */
    if (trial < 4)
      CHECK_NEAR(length, 2, 1e-12);
    else
      CHECK_NEAR(length, sqrt(2) + asinh(1), 0.01);
    assert_true(got.n_edges == 1 || trial >= 4);

    /* An update moves the edges. A bileaflet valve has no attached edges. */
    const riis_surface_options adapted = placed(RIIS_TRIANGULATION_ADAPTED, 2);
    CHECK_OK(riis_surface_update(surface, valve_of("bileaflet", 0.3), &adapted));
    const riis_attachment none = attachment_of(surface);
    assert_true(none.n_edges == 0 && !none.edges && !none.vertex_id && !none.leaflet_id && !none.patch_id);
  }
}

TEST(refusals_name_the_argument) {
  static const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, ids);
  riis_surface *from_arrays = surface_from(&arrays, NULL), *surface = aortic_surface(NULL);
  riis_attachment got;
  memset(&got, 0x22, sizeof got);
  const riis_attachment before = got;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface was made from arrays|edges of your own",
                riis_surface_get_attachment(from_arrays, &got, sizeof got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL", riis_surface_get_attachment(NULL, &got, sizeof got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "attachment is NULL", riis_surface_get_attachment(surface, NULL, sizeof got));
  static const int64_t sizes[3] = {0, 32, 48};
  for (int i = 0; i < 3; ++i)
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of attachment",
                  riis_surface_get_attachment(surface, &got, sizes[i]));
  assert_memory_equal(&got, &before, sizeof got);

  /* riis_surface_info.largest_leaflet_id must be the largest leaflet id. */
  static const struct {
    const char *kind;
    int largest_id;
  } kinds[5] = {{"aortic", 2}, {"trileaflet", 2}, {"mitral", 1}, {"bileaflet", 2}, {"coapting", 2}};
  for (int i = 0; i < 5; ++i)
    assert_int_equal(info_of(new_surface(valve_of(kinds[i].kind, 0.5), NULL)).largest_leaflet_id, kinds[i].largest_id);
  shape square = unit_square();
  square.leaflet_id[0] = 5;
  assert_int_equal(info_of(surface_of(&square, NULL)).largest_leaflet_id, 5);
  assert_int_equal(info_of(from_arrays).largest_leaflet_id, 0);
}

/* A surface reports the ids of its skirt and its housing. The id of a skirt follows those of the leaflets, and is at least 3.
 * Contacts have the depths of docs/theory/crossings.md. */
TEST(info_names_skirt_and_housing) {
  static const struct {
    const char *kind;
    int n_leaflets, housing, has_exact_contacts;
  } kinds[] = {{"aortic", 3, -1, 1},       {"trileaflet", 3, -1, 1}, {"coapting", 3, -1, 1}, {"bicuspid", 2, -1, 1},
               {"quadricuspid", 4, -1, 1}, {"mitral", 2, -1, 0},     {"bileaflet", 2, 2, 0}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
    riis_valve *valve = valve_of(kinds[i].kind, 0.5);
    riis_surface *surface = new_surface(valve, NULL);
    const riis_surface_info info = info_of(surface);
    assert_int_equal(info.skirt_leaflet_id, -1);
    assert_int_equal(info.housing_leaflet_id, kinds[i].housing);
    const double depth = kinds[i].has_exact_contacts ? 1e-3 * info.half_thickness : 2 * info.error_bound;
    assert_true(info.contact_depth == depth);
    if (kinds[i].housing >= 0) continue;
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.3));
    CHECK_OK(riis_surface_update(surface, valve, NULL));
    const int skirt = kinds[i].n_leaflets > 3 ? kinds[i].n_leaflets : 3;
    assert_int_equal(info_of(surface).skirt_leaflet_id, skirt);
    assert_int_equal(info_of(surface).largest_leaflet_id, skirt);
  }
}

int main(void) {
  rng = random_start("test_attachment");
  return run_cases(NULL, NULL);
}
