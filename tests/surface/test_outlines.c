/* SPDX-License-Identifier: Apache-2.0
 * Tests the orifice and the free edges of surfaces from arrays and keyframes, and the coaptation of leaflets. The expected values
 * come from closed forms, and from valves with equal surfaces. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

static riis_orifice orifice_of(const riis_surface *surface) {
  riis_orifice orifice;
  memset(&orifice, 0x5a, sizeof orifice);
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  return orifice;
}

static riis_leaflet leaflet_of(const riis_surface *surface, int64_t leaflet) {
  riis_leaflet sizes;
  CHECK_OK(riis_surface_get_leaflet(surface, leaflet, &sizes, sizeof sizes));
  return sizes;
}

static riis_coaptation coaptation_of(const riis_surface *surface, double reach, int32_t leaflet_id) {
  riis_coaptation coaptation;
  memset(&coaptation, 0x5a, sizeof coaptation);
  CHECK_OK(riis_surface_get_coaptation(surface, reach, leaflet_id, &coaptation, sizeof coaptation));
  return coaptation;
}

static riis_surface_options oblique(void) {
  riis_surface_options options = surface_options();
  options.scale = pow(10, between(-2, 2));
  for (int c = 0; c < 3; ++c)
    options.rotation_axis[c] = between(-1, 1) + (c == 0 ? 2 : 0),
    options.translation[c] = options.scale * between(-3, 3);
  options.rotation_angle = between(-180, 180);
  return options;
}

/* Makes a surface from arrays of the triangles and the leaflets of another surface. */
static riis_surface *as_arrays(const riis_surface *surface, const riis_surface_options *options) {
  const riis_triangles all = triangles_of(surface);
  int32_t *ids = own(malloc((size_t)all.n_triangles * 3 * sizeof *ids));
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) ids[i] = (int32_t)all.vertex_id[i];
  riis_surface_arrays arrays = triangle_arrays(all.n_vertices, all.xyz, all.n_triangles, ids);
  arrays.leaflet_id = all.leaflet_id;
  return surface_from(&arrays, options);
}

static double edge_length(const double *edge) {
  return sqrt(pow(edge[3] - edge[0], 2) + pow(edge[4] - edge[1], 2) + pow(edge[5] - edge[2], 2));
}

/* Returns the area that the attachment encloses, seen along z. The area is the sum of the triangles between the axis and each
 * edge. The sum uses absolute values, because the edges of mirrored halves run in opposite directions. The sum is right if each
 * ray from the axis meets the attachment once. */
static double area_of_attachment(const riis_surface *surface) {
  riis_attachment held;
  CHECK_OK(riis_surface_get_attachment(surface, &held, sizeof held));
  double area = 0;
  for (int64_t i = 0; i < held.n_edges; ++i) {
    const double *e = held.edges + 6 * i;
    area += 0.5 * fabs(e[0] * e[4] - e[1] * e[3]);
  }
  return area;
}

/* Returns the length of the line between the anterior and the posterior leaflet at one commissure. */
static double length_of_commissure(const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  double length = 0;
  for (int64_t t = 0; t < all.n_triangles; ++t)
    for (int k = 0; k < 3 && all.patch_id[t] == 6; ++k) {
      const int64_t a = all.vertex_id[3 * t + k], b = all.vertex_id[3 * t + (k + 1) % 3];
      if (all.uv[2 * a] != 0 || all.uv[2 * b] != 0) continue;
      double edge[6];
      memcpy(edge, all.xyz + 3 * a, 3 * sizeof *edge), memcpy(edge + 3, all.xyz + 3 * b, 3 * sizeof *edge);
      length += edge_length(edge);
    }
  return length;
}

/* Arrays of a valve's triangles have the valve's free edges. A patch may have vertices inside the edges of its neighbours, and
 * these edges do not count as boundary. The attachment is the outline. */
TEST(arrays_have_the_edges_of_their_valve) {
  static const char *const kinds[3] = {"trileaflet", "aortic", "mitral"};
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned(), kind = trial % 3;
    riis_valve *valve = new_valve(kinds[kind]);
    if (kind == 0) CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", between(1.3, 1.6)));
    if (kind == 2) CHECK_OK(riis_valve_set_scalar(valve, "surface_angle", between(-10, 20)));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 3 ? 0 : trial < 6 ? 1 : between(0.2, 1)));
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    const riis_surface *own_surface = new_surface(valve, &options);
    const riis_surface_options placed = oblique();
    const riis_surface *surface = as_arrays(own_surface, &placed);
    const double s = placed.scale, extra = kind == 2 ? 2 * length_of_commissure(own_surface) : 0;
    int64_t n = 0;
    CHECK_OK(riis_surface_get_n_leaflets(surface, &n));
    assert_int_equal(n, kind == 2 ? 2 : 3);
    if (kind == 1) {
      /* The paper's cusps are not joined at the commissures. Each cusp therefore has a separate boundary. One of these boundaries
       * is the outline. */
      assert_int_equal(orifice_of(surface).outline, RIIS_OUTLINE_BOUNDARY);
      free_owned_after(owned_before);
      continue;
    }
    for (int64_t i = 0; i < n; ++i) {
      const double wanted = s * (leaflet_of(own_surface, i).free_edge + extra);
      CHECK_NEAR(leaflet_of(surface, i).free_edge, wanted, 1e-9 * wanted);
    }
    const riis_orifice found = orifice_of(surface), of_valve = orifice_of(own_surface);
    assert_int_equal(found.outline, RIIS_OUTLINE_BOUNDARY);
    if (kind == 0) CHECK_NEAR(found.outline_area, s * s * area_of_attachment(own_surface), 1e-3 * s * s);
    double opening;
    CHECK_OK(riis_valve_get(valve, "opening", 1, &opening));
    if (kind == 2 && opening == 1) {
      /* The annulus of the open mitral valve is flat, so the axis is the valve's axis. The normals point down into the
       * ventricle. */
      CHECK_NEAR(found.outline_area, s * s * of_valve.outline_area, 1e-3 * s * s * of_valve.outline_area);
      CHECK_NEAR(found.area, s * s * of_valve.area, 1e-3 * s * s * of_valve.outline_area);
      const riis_orifice there = orifice_of(new_surface(valve, &placed));
      for (int c = 0; c < 3; ++c) CHECK_NEAR(found.axis[c], -there.axis[c], 1e-9);
    }
    /* Seen along z, the orifice of an open trileaflet valve is the part of the outline that the leaflets leave uncovered. */
    if (kind == 0 && opening == 0) CHECK_NEAR(found.area, 0, 2e-3 * found.outline_area);
    free_owned_after(owned_before);
  }
}

enum { n_round = 400, n_rings = 4 };

/* Makes a band of a sphere between two heights. Each quadrant is a leaflet. The wider circle is the outline. */
static riis_surface *band(double low, double high, const riis_surface_options *options) {
  static double xyz[3 * n_round * n_rings];
  static int32_t ids[6 * n_round * (n_rings - 1)];
  int64_t n = 0;
  for (int j = 0; j < n_rings; ++j)
    for (int i = 0; i < n_round; ++i) {
      const double z = low + (high - low) * j / (n_rings - 1), angle = 2 * acos(-1) * i / n_round;
      double *p = xyz + 3 * (j * n_round + i);
      p[0] = sqrt(1 - z * z) * cos(angle), p[1] = sqrt(1 - z * z) * sin(angle), p[2] = z;
      if (j + 1 == n_rings) continue;
      const int32_t a = j * n_round + i, b = j * n_round + (i + 1) % n_round;
      const int32_t two[6] = {a, b, b + n_round, a, b + n_round, a + n_round};
      memcpy(ids + 3 * n, two, sizeof two), n += 2;
    }
  const riis_surface_arrays arrays = triangle_arrays(n_round * n_rings, xyz, n, ids);
  return surface_from(&arrays, options);
}

TEST(bands_have_the_orifice_of_their_narrow_end) {
  for (int trial = 0; trial < 4; ++trial) {
    const double high = between(0.5, 0.95), pi = acos(-1);
    riis_surface_options options = oblique();
    options.flip_normals = trial % 2;
    const riis_surface *surface = band(0, high, &options);
    const riis_orifice found = orifice_of(surface);
    const double s = options.scale, hole = 1 - high * high;
    assert_int_equal(found.outline, RIIS_OUTLINE_BOUNDARY);
    CHECK_NEAR(found.outline_area, pi * s * s, 1e-3 * s * s);
    CHECK_NEAR(found.area, pi * hole * s * s, 1e-3 * s * s);
    CHECK_NEAR(found.radius, 0, 0);
    CHECK_NEAR(leaflet_of(surface, 0).free_edge, 2 * pi * sqrt(hole) * s, 1e-4 * s);
    /* The axis points to the side of the normals. */
    riis_surface_options turned = options;
    const riis_orifice z = orifice_of(surface_of_kind("trileaflet", (turned.flip_normals = 0, &turned)));
    for (int c = 0; c < 3; ++c) CHECK_NEAR(found.axis[c], (options.flip_normals ? -1 : 1) * z.axis[c], 1e-9);
  }
  /* A closed surface has no outline. */
  const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int32_t ids[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const riis_surface_arrays arrays = triangle_arrays(4, xyz, 4, ids);
  const riis_orifice none = orifice_of(surface_from(&arrays, NULL));
  assert_int_equal(none.outline, RIIS_OUTLINE_NONE);
  for (int c = 0; c < 3; ++c) CHECK_NEAR(none.axis[c], 0, 0);
  CHECK_NEAR(none.area + none.outline_area + none.perimeter + none.effective_area, 0, 0);
}

/* Keyframes give the same numbers as arrays with the same vertices. */
TEST(keyframes_have_the_orifice_of_their_arrays) {
  riis_valve *valve = new_valve("mitral");
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.3));
  riis_surface *surface = new_surface(valve, &options);
  const riis_triangles before = triangles_of(surface);
  const size_t n = (size_t)before.n_vertices * 3;
  double *frames = own(malloc(2 * n * sizeof *frames));
  int32_t *ids = own(malloc((size_t)before.n_triangles * 3 * sizeof *ids));
  for (int64_t i = 0; i < 3 * before.n_triangles; ++i) ids[i] = (int32_t)before.vertex_id[i];
  memcpy(frames, before.xyz, n * sizeof *frames);
  riis_surface_arrays arrays = triangle_arrays(before.n_vertices, NULL, before.n_triangles, ids);
  int32_t *leaflets = own(malloc((size_t)before.n_triangles * sizeof *leaflets));
  memcpy(leaflets, before.leaflet_id, (size_t)before.n_triangles * sizeof *leaflets);
  arrays.leaflet_id = leaflets;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  memcpy(frames + n, triangles_of(surface).xyz, n * sizeof *frames);
  static const double time[2] = {0, 1};
  riis_keyframe_arrays moving;
  CHECK_OK(riis_keyframe_arrays_init(&moving, sizeof moving));
  moving.n_keys = 2, moving.n_vertices = before.n_vertices, moving.time = time, moving.xyz = frames;
  riis_keyframes *keyframes = NULL;
  CHECK_OK(riis_keyframes_create(&arrays, &moving, &keyframes));
  own(keyframes);
  riis_surface *from_keyframes = NULL;
  CHECK_OK(riis_surface_create_from_keyframes(keyframes, 1, 0, NULL, &from_keyframes));
  own(from_keyframes);
  arrays.x = frames + n, arrays.y = frames + n + 1, arrays.z = frames + n + 2;
  const riis_orifice a = orifice_of(from_keyframes), b = orifice_of(surface_from(&arrays, NULL));
  assert_memory_equal(&a, &b, sizeof a);
  assert_true(a.area > 1);
  CHECK_NEAR(leaflet_of(from_keyframes, 0).free_edge,
             leaflet_of(surface, 0).free_edge + 2 * length_of_commissure(surface), 1e-9);
}

/* Makes two rectangles of 1 by w as leaflets 0 and 1. The second rectangle is turned about the y axis, then shifted. */
static riis_surface *plates(double w, double turn, double x, double z, const riis_surface_options *options) {
  double xyz[24];
  for (int i = 0; i < 8; ++i) {
    const double along = i % 4 == 1 || i % 4 == 2 ? w : 0, c = i < 4 ? 1 : cos(turn), s = i < 4 ? 0 : sin(turn);
    xyz[3 * i] = c * along + (i < 4 ? 0 : x), xyz[3 * i + 1] = i % 4 < 2 ? 0 : 1;
    xyz[3 * i + 2] = s * along + (i < 4 ? 0 : z);
  }
  static const int32_t ids[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, leaflets[4] = {0, 0, 1, 1};
  riis_surface_arrays arrays = triangle_arrays(8, xyz, 4, ids);
  arrays.leaflet_id = leaflets;
  return surface_from(&arrays, options);
}

TEST(contacts_have_known_areas) {
  for (int trial = 0; trial < trials_of(6); ++trial) {
    const riis_surface_options options = oblique();
    const double s = options.scale, reach = between(0.05, 0.2), w = between(1, 2);
    /* Parallel plates touch in their overlap, which is widened by sqrt(reach^2 - distance^2). */
    const double apart = between(0, 0.8) * reach, shift = between(0.3, 0.6);
    const riis_surface *parallel = plates(w, 0, shift, apart, &options);
    const double wide = w - shift + sqrt(reach * reach - apart * apart);
    for (int32_t leaflet = 0; leaflet < (is_short_test() ? 1 : 2); ++leaflet)
      CHECK_NEAR(coaptation_of(parallel, s * reach, leaflet).area, s * s * wide, 1e-3 * s * s * reach * 4);
    if (!is_short_test())
      CHECK_NEAR(coaptation_of(parallel, s * reach, RIIS_ALL_LEAFLETS).area, 2 * s * s * wide,
                 2e-3 * s * s * reach * 4);
    const riis_coaptation none = coaptation_of(parallel, s * apart * 0.7 + 1e-9 * s, RIIS_ALL_LEAFLETS);
    CHECK_NEAR(none.area + none.edge, 0, 0);
    /* A reach far below the plates' size must cost no more work. The library divides an overlap into small parts, so the plates
     * overlap only in a strip. */
    const double strip = 0.15;
    const riis_surface *nearby = plates(w, 0, w - strip, 2e-6, &options);
    CHECK_NEAR(coaptation_of(nearby, s * 1e-6, RIIS_ALL_LEAFLETS).area, 0, 0);
    CHECK_NEAR(coaptation_of(nearby, s * 4e-6, 0).area, s * s * strip, 5e-3 * s * s);
    /* Two plates that share an edge touch in a strip along this edge. The strip's width is the reach divided by the sine of the
     * plates' angle. */
    const double angle = between(0.3, 1.2);
    const riis_surface *hinge = plates(w, angle, 0, 0, &options);
    const riis_coaptation found = coaptation_of(hinge, s * reach, 0);
    CHECK_NEAR(found.area, s * s * reach / sin(angle), 1e-3 * s * s * reach * 4);
    CHECK_NEAR(found.reach, s * reach, 1e-15 * s);
  }
}

/* Closed trileaflet cusps touch along their whole free edges. Open cusps touch only near the commissures. Skirts and housings do
 * not count as touching. */
TEST(closed_leaflets_touch_along_their_free_edges) {
  for (int trial = 0; trial < 2; ++trial) {
    riis_valve *valve = new_valve("trileaflet");
    riis_surface_options options = oblique();
    options.half_thickness = 0.05 * options.scale;
    options.triangulation = trial ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    const riis_surface *closed = new_surface(valve, &options);
    for (int32_t cusp = 0; cusp < 3; ++cusp) {
      const riis_coaptation found = coaptation_of(closed, RIIS_AUTO, cusp);
      CHECK_NEAR(found.edge, leaflet_of(closed, cusp).free_edge, 1e-12 * options.scale);
      CHECK_NEAR(found.reach, options.half_thickness, 0);
      assert_true(found.area > found.edge * found.reach);
      CHECK_NEAR(found.area, coaptation_of(closed, RIIS_AUTO, (cusp + 1) % 3).area, 1e-3 * found.area);
    }
    const riis_coaptation all = coaptation_of(closed, RIIS_AUTO, RIIS_ALL_LEAFLETS);
    const riis_coaptation as_array = coaptation_of(as_arrays(closed, NULL), options.half_thickness, RIIS_ALL_LEAFLETS);
    CHECK_NEAR(as_array.area, all.area, 1e-9 * all.area);
    CHECK_NEAR(as_array.edge, all.edge, 1e-9 * all.edge);
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.1));
    const riis_coaptation with_skirt = coaptation_of(new_surface(valve, &options), RIIS_AUTO, RIIS_ALL_LEAFLETS);
    CHECK_NEAR(with_skirt.area, all.area, 3e-3 * all.area); /* its triangles may differ */
    CHECK_NEAR(coaptation_of(new_surface(valve, &options), RIIS_AUTO, RIIS_LEAFLET_SKIRT).area, 0, 0);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
    const riis_coaptation open = coaptation_of(new_surface(valve, &options), RIIS_AUTO, RIIS_ALL_LEAFLETS);
    assert_true(open.edge > 0 && open.edge < 0.3 * all.edge && open.area < 0.5 * all.area);
  }
  riis_surface *surface = surface_of_kind("mitral", NULL);
  riis_coaptation coaptation;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL",
                riis_surface_get_coaptation(NULL, RIIS_AUTO, 0, &coaptation, sizeof coaptation));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "reach is 0",
                riis_surface_get_coaptation(surface, 0, 0, &coaptation, sizeof coaptation));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "leaflet_id is 2, which the surface lacks",
                riis_surface_get_coaptation(surface, RIIS_AUTO, 2, &coaptation, sizeof coaptation));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "coaptation is NULL",
                riis_surface_get_coaptation(surface, RIIS_AUTO, 0, NULL, sizeof coaptation));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "coaptation is 8",
                riis_surface_get_coaptation(surface, RIIS_AUTO, 0, &coaptation, 8));
}

static int start(void **state) {
  (void)state;
  rng = random_start("test_outlines");
  return 0;
}

int main(void) { return run_cases(start, NULL); }
