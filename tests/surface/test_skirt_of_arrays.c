/* SPDX-License-Identifier: Apache-2.0
 * Tests skirts of surfaces from arrays. A surface from a valve's own triangles must have the valve's skirt. Directions are
 * compared with sums over the attachment, and velocities with differences. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "given_back.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

enum { n_kinds = 4, aortic = 2 };
static const char *const kinds[n_kinds] = {"trileaflet", "coapting", "aortic", "mitral"};

static riis_surface *valve_surface(const char *kind, double opening, double skirt, int32_t triangulation) {
  riis_valve *valve = new_valve(kind);
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.tolerance = 0.02;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  if (skirt != 0) CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", skirt));
  return new_surface(valve, &options);
}

static riis_attachment attachment_of(const riis_surface *surface) {
  riis_attachment attachment;
  CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
  return attachment;
}

static double distance_between(const double *a, const double *b) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The skirt leads away from this line, which passes through the centroid of the attached edges along their vector area. */
typedef struct line {
  double centre[3], direction[3];
} line;

static line line_of(const riis_attachment *held) {
  line made = {{0, 0, 0}, {0, 0, 0}};
  double whole = 0;
  for (int64_t i = 0; i < held->n_edges; ++i) {
    const double *a = held->edges + 6 * i, *b = a + 3, size = distance_between(a, b);
    whole += size;
    for (int c = 0; c < 3; ++c) made.centre[c] += 0.5 * size * (a[c] + b[c]);
  }
  for (int c = 0; c < 3; ++c) made.centre[c] /= whole;
  for (int64_t i = 0; i < held->n_edges; ++i)
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const double *a = held->edges + 6 * i, *b = a + 3, *m = made.centre;
      made.direction[c] += (a[d] - m[d]) * (b[e] - m[e]) - (a[e] - m[e]) * (b[d] - m[d]);
    }
  const double size = sqrt(dot(made.direction, made.direction));
  for (int c = 0; c < 3; ++c) made.direction[c] /= size;
  return made;
}

static void moved_outwards(const line *axis, const double *p, double length, double *moved) {
  double q[3];
  for (int c = 0; c < 3; ++c) q[c] = p[c] - axis->centre[c];
  const double along = dot(q, axis->direction);
  for (int c = 0; c < 3; ++c) q[c] -= along * axis->direction[c];
  const double size = sqrt(dot(q, q));
  for (int c = 0; c < 3; ++c) moved[c] = p[c] + length * q[c] / size;
}

/* Checks each triangle of the skirt. The triangle must have one attached edge, or one outer edge that lies a length outwards.
 * Returns the number of triangles. */
static int64_t check_strip(const riis_surface *surface, int64_t n_given, double length, double rounding) {
  const riis_attachment held = attachment_of(surface);
  const riis_triangles all = triangles_of(surface);
  const line axis = line_of(&held);
  int64_t n = 0, n_edges = 0;
  for (int64_t t = 0; t < all.n_triangles; ++t) {
    if (all.patch_id[t] != 1) continue;
    const int64_t *id = all.vertex_id + 3 * t;
    assert_int_equal(all.triangle_id[t], all.triangle_id[all.n_triangles - 1] - (all.n_triangles - 1 - t));
    assert_int_equal(all.leaflet_id[t], info_of(surface).skirt_leaflet_id);
    const int64_t inner = n % 2 ? id[0] : id[1], outer = n % 2 ? id[1] : id[2];
    assert_true(inner < n_given && outer >= n_given);
    /* The second triangle begins at B, and its outer vertex lies beyond A, the second vertex of the first triangle. */
    const int64_t under = n % 2 ? all.vertex_id[3 * (t - 1) + 1] : inner;
    double wanted[3];
    moved_outwards(&axis, all.xyz + 3 * under, length, wanted);
    CHECK_AT_MOST(distance_between(all.xyz + 3 * outer, wanted), rounding);
    ++n;
    n_edges += n % 2;
  }
  assert_int_equal(n_edges, held.n_edges);
  return n;
}

/* Returns the largest distance from the vertices of one surface's skirt to the skirt of the other surface. */
static double largest_distance(const riis_surface *from, const riis_surface *to, int32_t patch_of_from) {
  const riis_triangles all = triangles_of(from);
  double largest = 0;
  for (int64_t t = 0; t < all.n_triangles; t += trial_step())
    for (int k = 0; k < 3; ++k) {
      if (patch_of_from >= 0 ? all.patch_id[t] != patch_of_from : all.leaflet_id[t] != RIIS_LEAFLET_SKIRT) continue;
      const double *p = all.xyz + 3 * all.vertex_id[3 * t + k];
      largest = fmax(largest, closest_to(to, p[0], p[1], p[2]).distance);
    }
  return largest;
}

static void check_same_measures(const riis_surface *with, const riis_surface *bare) {
  riis_orifice a, b;
  riis_coaptation p, q;
  CHECK_OK(riis_surface_get_orifice(with, NULL, &a, sizeof a));
  CHECK_OK(riis_surface_get_orifice(bare, NULL, &b, sizeof b));
  assert_memory_equal(&a, &b, sizeof a);
  CHECK_OK(riis_surface_get_coaptation(with, RIIS_AUTO, RIIS_ALL_LEAFLETS, &p, sizeof p));
  CHECK_OK(riis_surface_get_coaptation(bare, RIIS_AUTO, RIIS_ALL_LEAFLETS, &q, sizeof q));
  assert_memory_equal(&p, &q, sizeof p);
  int64_t n = 0, n_with = 0;
  CHECK_OK(riis_surface_get_n_leaflets(bare, &n));
  CHECK_OK(riis_surface_get_n_leaflets(with, &n_with));
  assert_int_equal(n_with, n + 1);
  for (int64_t i = 0; i <= n; ++i) {
    riis_leaflet of_with, of_bare;
    CHECK_OK(riis_surface_get_leaflet(with, i, &of_with, sizeof of_with));
    if (i == n) {
      CHECK_SAME(of_with.free_edge, 0.0);
      continue;
    }
    CHECK_OK(riis_surface_get_leaflet(bare, i, &of_bare, sizeof of_bare));
    assert_memory_equal(&of_with, &of_bare, sizeof of_bare);
  }
}

/* A valve from arrays has the axis of a valve from patches. For the built-in mitral valve the axis is vertical. For the built-in
 * aortic valve the axis is that of the root. The following limits allow for an angle between the axes and these directions
 * (docs/theory/skirt.md). */
static const double share_of_length[n_kinds] = {0.005, 0.005, 0.02, 0.1};

TEST(a_valve_that_is_given_back_gets_its_own_skirt) {
  const int n_openings = is_long_test() ? 9 : 3;
  for (int trial = 0; trial < n_kinds * n_openings * 2; trial += is_short_test() ? 13 : 1) {
    const int owned_before = n_owned(), kind = trial % n_kinds, is_fixed = trial / n_kinds % 2;
    const double opening = (double)(trial / n_kinds / 2) / (n_openings - 1), length = between(0.05, 0.3);
    const int32_t how = is_fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    const riis_surface *bare = valve_surface(kinds[kind], opening, 0, how),
                       *skirted = valve_surface(kinds[kind], opening, length, how);
    for (int has_attachment = 0; has_attachment < 2; ++has_attachment) {
      riis_surface_arrays arrays = given_back(bare, has_attachment);
      arrays.skirt_length = length;
      if (kind == aortic && !has_attachment) { /* the paper's cusps are not joined at the commissures */
        riis_surface *none = NULL;
        CHECK_REFUSED(RIIS_INVALID_SURFACE, "the largest closed line of open edges encloses 0.|arrays.attached",
                      riis_surface_create_from_arrays(&arrays, NULL, &none));
        continue;
      }
      const riis_surface *made = surface_from(&arrays, NULL);
      const int64_t n_held = attachment_of(bare).n_edges;
      assert_int_equal(attachment_of(made).n_edges, n_held);
      check_strip(made, arrays.n_vertices, length, 1e-13);
      const double error = info_of(skirted).error_bound + info_of(bare).error_bound,
                   there = largest_distance(made, skirted, 1), back = largest_distance(skirted, made, -1);
      if (has_attachment)
        printf("%s at %.2f: skirts of length %.3f differ by %.5f and %.5f\n", kinds[kind], opening, length, there,
               back);
      CHECK_AT_MOST(fmax(there, back), share_of_length[kind] * length + 2 * error);
      arrays.skirt_length = 0;
      arrays.attached = NULL;
      if (has_attachment || is_long_test()) check_same_measures(made, surface_from(&arrays, NULL));
    }
    free_owned_after(owned_before);
  }
}

TEST(any_placement_moves_the_skirt_with_the_leaflets) {
  for (int trial = 0; trial < 2 * n_kinds; ++trial) {
    const int owned_before = n_owned(), is_flipped = trial / n_kinds;
    const riis_surface *bare = valve_surface(kinds[trial % n_kinds], between(0, 1), 0, RIIS_TRIANGULATION_ADAPTED);
    riis_surface_arrays arrays = given_back(bare, trial % n_kinds == aortic || trial % 2);
    arrays.skirt_length = between(0.02, 0.5);
    riis_surface_options options = surface_options();
    options.scale = pow(10, between(-2, 1));
    options.flip_normals = is_flipped;
    for (int c = 0; c < 3; ++c) {
      options.rotation_axis[c] = between(-1, 1) + (c == 1 ? 2 : 0);
      options.translation[c] = options.scale * between(-3, 3);
    }
    options.rotation_angle = between(-180, 180);
    const riis_surface *placed = surface_from(&arrays, &options);
    check_strip(placed, arrays.n_vertices, options.scale * arrays.skirt_length, 1e-13 * options.scale * 10);
    /* The skirt's normals agree with those of the leaflets: no two triangles use an edge in one direction. */
    const riis_attachment held = attachment_of(placed);
    const riis_triangles all = triangles_of(placed);
    for (int64_t i = 0; i < held.n_edges; ++i) {
      int n_along = 0, n_against = 0;
      for (int64_t t = 0; t < all.n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
          const int64_t a = all.vertex_id[3 * t + k], b = all.vertex_id[3 * t + (k + 1) % 3];
          n_along += a == held.vertex_id[2 * i] && b == held.vertex_id[2 * i + 1];
          n_against += b == held.vertex_id[2 * i] && a == held.vertex_id[2 * i + 1];
        }
      assert_int_equal(n_along, 1);
      assert_int_equal(n_against, 1);
    }
    free_owned_after(owned_before);
  }
}

/* Copies points and moves them by a random affine motion. */
static double *moved_points(const riis_surface_arrays *arrays, const double *motion, double time) {
  const double *xyz = arrays->x;
  double *to = own(malloc((size_t)arrays->n_vertices * 3 * sizeof *to));
  for (int64_t i = 0; i < arrays->n_vertices; ++i)
    for (int c = 0; c < 3; ++c) {
      const double *row = motion + 4 * c, *p = xyz + 3 * i;
      to[3 * i + c] = p[c] + time * (row[3] + dot(row, p)) + 0.3 * time * time * row[(c + 1) % 3] * p[c];
    }
  return to;
}

static double *velocities(const riis_surface_arrays *arrays, const double *motion, double time) {
  const double *xyz = arrays->x;
  double *to = own(malloc((size_t)arrays->n_vertices * 3 * sizeof *to));
  for (int64_t i = 0; i < arrays->n_vertices; ++i)
    for (int c = 0; c < 3; ++c) {
      const double *row = motion + 4 * c, *p = xyz + 3 * i;
      to[3 * i + c] = row[3] + dot(row, p) + 0.6 * time * row[(c + 1) % 3] * p[c];
    }
  return to;
}

TEST(velocities_are_those_of_the_moving_skirt) {
  for (int trial = 0; trial < n_kinds; ++trial) {
    const int owned_before = n_owned();
    const riis_surface *bare = valve_surface(kinds[trial], between(0, 1), 0, RIIS_TRIANGULATION_ADAPTED);
    const riis_surface_arrays first = given_back(bare, trial == aortic || trial % 2);
    double motion[12];
    for (int i = 0; i < 12; ++i) motion[i] = between(-1, 1);
    const double h = 1e-5, time = 0.1;
    riis_surface_options options = surface_options();
    options.scale = 2, options.rotation_angle = 40, options.rotation_axis[0] = 1;
    const riis_surface *at[3];
    for (int k = 0; k < 3; ++k) {
      riis_surface_arrays arrays = first;
      const double when = time + (k - 1) * h, *p = moved_points(&first, motion, when),
                   *v = velocities(&first, motion, when);
      arrays.x = p, arrays.y = p + 1, arrays.z = p + 2;
      arrays.vx = v, arrays.vy = v + 1, arrays.vz = v + 2;
      arrays.velocity_stride = 3;
      arrays.skirt_length = 0.3;
      at[k] = surface_from(&arrays, &options);
    }
    const riis_triangles now = triangles_of(at[1]), before = triangles_of(at[0]), after = triangles_of(at[2]);
    assert_true(now.n_vertices > first.n_vertices && before.n_vertices == now.n_vertices);
    double fastest = 0;
    for (int64_t i = 0; i < 3 * now.n_vertices; ++i) {
      CHECK_NEAR(now.velocity[i], (after.xyz[i] - before.xyz[i]) / (2 * h), 1e-6);
      fastest = fmax(fastest, fabs(now.velocity[i]));
    }
    assert_true(fastest > 0.1);
    free_owned_after(owned_before);
  }
}

/* The first frame of keyframes determines the attachment for all frames. */
TEST(keyframes_carry_their_skirt) {
  const riis_surface *bare = valve_surface("coapting", 0, 0, RIIS_TRIANGULATION_ADAPTED);
  for (int has_attachment = 0; has_attachment < 2; ++has_attachment) {
    riis_surface_arrays arrays = given_back(bare, has_attachment);
    enum { n_frames = 5 };
    const size_t n = (size_t)arrays.n_vertices * 3;
    double *xyz = own(malloc(n * n_frames * sizeof *xyz)), times[n_frames];
    for (int k = 0; k < n_frames; ++k) {
      const double turn = 0.05 * k;
      times[k] = 0.1 * k;
      for (size_t i = 0; i < n; i += 3) {
        const double *p = (const double *)arrays.x + i, out = 1 + 0.1 * k;
        double *to = xyz + n * (size_t)k + i;
        to[0] = out * (cos(turn) * p[0] - sin(turn) * p[1]), to[1] = out * (sin(turn) * p[0] + cos(turn) * p[1]);
        to[2] = p[2] + turn;
      }
    }
    riis_keyframe_arrays frames;
    CHECK_OK(riis_keyframe_arrays_init(&frames, sizeof frames));
    frames.n_keys = n_frames, frames.n_vertices = arrays.n_vertices, frames.time = times, frames.xyz = xyz;
    frames.interpolation = RIIS_INTERPOLATION_CUBIC;
    arrays.skirt_length = 0.2;
    riis_keyframes *keyframes = NULL;
    CHECK_OK(riis_keyframes_create(&arrays, &frames, &keyframes));
    riis_surface *surface = NULL;
    CHECK_OK(riis_surface_create_from_keyframes(keyframes, 0, 0, NULL, &surface));
    own(surface);
    const int64_t n_triangles = triangles_of(surface).n_triangles;
    for (double time = 0.02; time < 0.4; time += 0.07) {
      CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, time, 0, NULL));
      assert_int_equal(triangles_of(surface).n_triangles, n_triangles);
      check_strip(surface, arrays.n_vertices, 0.2, 1e-13);
      const riis_triangles all = triangles_of(surface);
      double *now = own(malloc((size_t)all.n_vertices * 6 * sizeof *now)), *velocity = now + 3 * all.n_vertices;
      memcpy(now, all.xyz, (size_t)all.n_vertices * 3 * sizeof *now);
      memcpy(velocity, all.velocity, (size_t)all.n_vertices * 3 * sizeof *now);
      const double h = 1e-6;
      CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, time + h, 0, NULL));
      const riis_triangles later = triangles_of(surface);
      for (int64_t i = 0; i < 3 * later.n_vertices; ++i) CHECK_NEAR(velocity[i], (later.xyz[i] - now[i]) / h, 1e-4);
    }
    riis_keyframes_destroy(&keyframes);
  }
}

/* Gives each leaflet separate vertices, as several files do, and shrinks the leaflets about their centroids. */
static riis_surface_arrays parted(const riis_surface_arrays *from, double shrink) {
  const double *xyz = from->x;
  const int32_t *ids = from->vertex_ids;
  const size_t n_corners = (size_t)from->n_faces * 3;
  double *to = own(malloc(n_corners * 3 * sizeof *to)), centre[8][3] = {{0}};
  int32_t *own_ids = own(malloc(n_corners * sizeof *own_ids));
  uint8_t *attached = own(calloc(n_corners, sizeof *attached));
  int64_t n_of[8] = {0};
  for (size_t i = 0; i < n_corners; ++i) {
    const int32_t leaflet = from->leaflet_id[i / 3];
    ++n_of[leaflet];
    for (int c = 0; c < 3; ++c) centre[leaflet][c] += xyz[3 * ids[i] + c];
  }
  for (size_t i = 0; i < n_corners; ++i) {
    const int32_t leaflet = from->leaflet_id[i / 3];
    own_ids[i] = (int32_t)i;
    attached[i] = from->attached && from->attached[ids[i]];
    for (int c = 0; c < 3; ++c)
      to[3 * i + (size_t)c] = (1 - shrink) * xyz[3 * ids[i] + c] + shrink * centre[leaflet][c] / (double)n_of[leaflet];
  }
  riis_surface_arrays made = triangle_arrays((int64_t)n_corners, to, from->n_faces, own_ids);
  made.leaflet_id = from->leaflet_id;
  if (from->attached) made.attached = attached;
  return made;
}

TEST(leaflets_of_several_files) {
  const riis_surface *bare = valve_surface("coapting", 0, 0, RIIS_TRIANGULATION_ADAPTED);
  riis_surface_arrays whole = given_back(bare, 1);
  whole.skirt_length = 0.2;
  for (int has_attachment = 0; has_attachment < 2; ++has_attachment) {
    riis_surface_arrays touching = parted(&whole, 0), apart = parted(&whole, 0.02);
    touching.skirt_length = apart.skirt_length = 0.2;
    if (!has_attachment) touching.attached = apart.attached = NULL;
    const riis_surface *joined = surface_from(&touching, NULL);
    CHECK_NEAR(info_of(joined).area, info_of(surface_from(&whole, NULL)).area, 1e-12);
    check_strip(joined, touching.n_vertices, 0.2, 1e-13);
    riis_surface *made = NULL;
    if (!has_attachment) { /* nothing joins the leaflets' ends, so no line encloses them all */
      CHECK_REFUSED(RIIS_INVALID_SURFACE, "largest closed line of open edges encloses 0.3|arrays.attached",
                    riis_surface_create_from_arrays(&apart, NULL, &made));
      continue;
    }
    const riis_surface *strips = surface_from(&apart, NULL); /* one strip for each leaflet, and a gap between them */
    check_strip(strips, apart.n_vertices, 0.2, 1e-13);
  }
}

TEST(the_gap_gives_the_lengths) {
  const riis_surface *bare = valve_surface("coapting", 0, 0, RIIS_TRIANGULATION_ADAPTED);
  riis_surface_arrays arrays = given_back(bare, 1);
  /* Makes a tube around the valve, off the valve's axis. */
  enum { n_round = 96 };
  double tube[n_round * 6];
  int32_t faces[n_round * 6];
  for (int i = 0; i < n_round; ++i) {
    const double turn = 2 * acos(-1) * i / n_round;
    for (int end = 0; end < 2; ++end) {
      double *p = tube + 6 * i + 3 * end;
      p[0] = 0.1 + 1.7 * cos(turn), p[1] = 1.7 * sin(turn), p[2] = end ? 5 : -5;
    }
    const int a = 2 * i, b = 2 * ((i + 1) % n_round), made[6] = {a, b, b + 1, a, b + 1, a + 1};
    for (int k = 0; k < 6; ++k) faces[6 * i + k] = made[k];
  }
  const riis_surface_arrays of_tube = triangle_arrays(2 * n_round, tube, 2 * n_round, faces);
  const riis_surface *wall = surface_from(&of_tube, NULL), *held_only = surface_from(&arrays, NULL);
  assert_int_equal(triangles_of(held_only).n_triangles, arrays.n_faces); /* an attachment alone makes no skirt */
  const riis_attachment held = attachment_of(held_only);
  double *gaps = own(malloc((size_t)held.n_edges * 2 * sizeof *gaps)),
         *lengths = own(calloc((size_t)arrays.n_vertices, sizeof *lengths));
  riis_gap gap;
  CHECK_OK(riis_surface_get_gap(held_only, wall, gaps, &gap, sizeof gap));
  assert_int_equal(gap.n_without_wall, 0);
  for (int64_t i = 0; i < 2 * held.n_edges; ++i) lengths[held.vertex_id[i]] = gaps[i];
  arrays.skirt_length = 1.001 * gap.most;
  arrays.skirt_lengths = lengths;
  const riis_surface *reaching = surface_from(&arrays, NULL);
  const riis_triangles all = triangles_of(reaching);
  assert_true(all.n_vertices > arrays.n_vertices);
  for (int64_t i = arrays.n_vertices; i < all.n_vertices; ++i)
    CHECK_AT_MOST(closest_to(wall, all.xyz[3 * i], all.xyz[3 * i + 1], all.xyz[3 * i + 2]).distance, 1e-12);
  arrays.skirt_length = 0.5 * gap.most;
  riis_surface *made = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.skirt_lengths of vertex |must be at most arrays.skirt_length",
                riis_surface_create_from_arrays(&arrays, NULL, &made));
}

TEST(updates_without_faces_keep_the_skirt) {
  const riis_surface *bare = valve_surface("coapting", 0, 0, RIIS_TRIANGULATION_ADAPTED);
  riis_surface_arrays arrays = given_back(bare, 0);
  arrays.skirt_length = 0.2;
  riis_surface *surface = surface_from(&arrays, NULL);
  const int64_t n = triangles_of(surface).n_triangles;
  double motion[12] = {0.1, 0.2, 0, 0, 0, 0.3, 0.1, 0, 0.2, 0, 0, 0.4}, *p = moved_points(&arrays, motion, 1);
  riis_surface_arrays next = arrays;
  next.x = p, next.y = p + 1, next.z = p + 2;
  next.n_faces = 0, next.vertex_ids = NULL, next.leaflet_id = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.skirt_length|without faces",
                riis_surface_update_from_arrays(surface, &next, NULL));
  next.skirt_length = 0;
  riis_surface_options flipped = surface_options();
  flipped.flip_normals = 1;
  CHECK_OK(riis_surface_update_from_arrays(surface, &next, &flipped));
  assert_int_equal(triangles_of(surface).n_triangles, n);
  check_strip(surface, arrays.n_vertices, 0.2, 1e-13);
  next = arrays;
  next.skirt_length = 0;
  CHECK_OK(riis_surface_update_from_arrays(surface, &next, NULL));
  assert_int_equal(triangles_of(surface).n_triangles, arrays.n_faces);
}

/* A caller of the first release passes a shorter struct. */
TEST(old_callers_have_no_skirt) {
  const riis_surface *bare = valve_surface("coapting", 0, 0, RIIS_TRIANGULATION_ADAPTED);
  riis_surface_arrays arrays = given_back(bare, 0);
  arrays.skirt_length = 0.2;
  arrays.struct_size = offsetof(riis_surface_arrays, skirt_length);
  assert_int_equal(triangles_of(surface_from(&arrays, NULL)).n_triangles, arrays.n_faces);
}

static void refuse(const riis_surface_arrays *arrays, riis_status status, const char *parts) {
  riis_surface *surface = NULL;
  check_refused(status, riis_surface_create_from_arrays(arrays, NULL, &surface), parts, "from arrays");
}

TEST(refusals) {
  riis_surface_arrays good = given_back(valve_surface("coapting", 0, 0, RIIS_TRIANGULATION_ADAPTED), 1), bad = good;
  static const struct {
    double length;
    const char *text;
  } lengths[] = {{-1, "arrays.skirt_length is -1; it must be from 0"},
                 {NAN, "arrays.skirt_length is nan"},
                 {INFINITY, "arrays.skirt_length is inf"},
                 {1e51, "arrays.skirt_length is 1e+51"},
                 {1e-5, "arrays.skirt_length is 1e-05|mean distance of the attachment from its axis"},
                 {1000, "arrays.skirt_length is 1000|mean distance of the attachment from its axis"}};
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; ++i) {
    bad.skirt_length = lengths[i].length;
    refuse(&bad, RIIS_INVALID_ARGUMENT, lengths[i].text);
  }
  bad = good;
  double *per_vertex = own(calloc((size_t)good.n_vertices, sizeof *per_vertex));
  bad.skirt_lengths = per_vertex;
  refuse(&bad, RIIS_INVALID_ARGUMENT, "arrays.skirt_lengths is given|is 0");
  bad.skirt_length = 0.2;
  for (int64_t i = 0; i < good.n_vertices; ++i) per_vertex[i] = NAN;
  refuse(&bad, RIIS_INVALID_ARGUMENT, "arrays.skirt_lengths of vertex |is nan");

  uint8_t *attached = own(calloc((size_t)good.n_vertices, sizeof *attached));
  bad = good;
  bad.attached = attached;
  refuse(&bad, RIIS_INVALID_SURFACE, "arrays.attached is 0 for all");
  for (int64_t i = 0; i < good.n_vertices; ++i) attached[i] = 1; /* marks all vertices as attached */
  refuse(&bad, RIIS_INVALID_SURFACE, "arrays.attached: no open edge leads from vertex ");

  /* Tests a closed surface, a tube with two rims, and leaflets that do not touch. */
  static const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const int32_t tetrahedron[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  riis_surface_arrays closed = triangle_arrays(4, corners, 4, tetrahedron);
  closed.skirt_length = 0.1;
  refuse(&closed, RIIS_INVALID_SURFACE, "no closed line of open edges|arrays.attached");
  double rims[24 * 3];
  int32_t faces[24 * 3];
  for (int i = 0; i < 12; ++i) {
    for (int end = 0; end < 2; ++end) {
      double *p = rims + 6 * i + 3 * end;
      const double wide = end ? 0.997 : 1, turn = acos(-1) * i / 6;
      p[0] = wide * cos(turn), p[1] = wide * sin(turn), p[2] = end;
    }
    const int a = 2 * i, b = 2 * ((i + 1) % 12), made[6] = {a, b, b + 1, a, b + 1, a + 1};
    for (int k = 0; k < 6; ++k) faces[6 * i + k] = made[k];
  }
  riis_surface_arrays tube = triangle_arrays(24, rims, 24, faces);
  tube.skirt_length = 0.1;
  refuse(&tube, RIIS_INVALID_SURFACE, "two closed lines of open edges enclose the same area|arrays.attached");
  uint8_t lower_rim[24], chain[24] = {0};
  for (int i = 0; i < 24; ++i) lower_rim[i] = i % 2 == 0;
  tube.attached = lower_rim;
  assert_int_equal(check_strip(surface_from(&tube, NULL), 24, 0.1, 1e-15), 24);
  for (int i = 0; i < 3; ++i) chain[2 * i] = 1; /* an open chain suffices if its joined ends enclose an area */
  tube.attached = chain;
  assert_int_equal(check_strip(surface_from(&tube, NULL), 24, 0.1, 1e-14), 4);
  riis_valve *valve = new_valve("bileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
  riis_surface_arrays bileaflet = given_back(new_surface(valve, NULL), 0);
  bileaflet.skirt_length = 0.1;
  refuse(&bileaflet, RIIS_INVALID_SURFACE, "closed line|of open edges enclose|arrays.attached");
  int32_t largest[4] = {INT32_MAX, 0, 0, 0};
  riis_surface_arrays numbered = triangle_arrays(4, corners, 1, tetrahedron);
  numbered.skirt_length = 0.1, numbered.leaflet_id = largest;
  refuse(&numbered, RIIS_LIMIT_EXCEEDED, "2147483647");
}

int main(void) {
  rng = random_start("test_skirt_of_arrays");
  return run_cases(NULL, NULL);
}
