/* SPDX-License-Identifier: Apache-2.0
 * Compares velocities of skirts with central displacements. The compared points lie on the attachment, lie outwards from it by
 * separate formulas, or are vertices of a fixed triangulation. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "moving_surfaces.h"
#include "sanitized.h"
#include "shapes.h"
#include "smooth_motion.h"
#include "velocity_bound.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double distance(const double *p, const double *q) {
  const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  return sqrt(dot(d, d));
}

enum { aortic, trileaflet, coapting, mitral, of_patches, n_kinds };
static const char *const kinds[n_kinds] = {"aortic", "trileaflet", "coapting", "mitral", "patches"};

/* --- States and steps ------------------------------------------------------------------------------------------------- */

/* A state that moves. In the middle of a step, the state has these values plus half of the rates. */
typedef struct state_of_skirt {
  double opening, size[3]; /* the sizes are factors; the last factor scales the skirt's length */
  riis_surface_options placed;
} state_of_skirt;

/* A leaflet of three patches. The attachment rises between the patches' ends. */
static shape cone(double radius, double rise, double mouth) {
  shape made = {0};
  const double third = 2 * acos(-1) / 3;
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < 3; ++i) {
      double control[4][3];
      for (int k = 0; k < 4; ++k) {
        const double angle = third * (i + k / 3.0), is_inner = k == 1 || k == 2;
        const double r = (level ? mouth : 1) * radius * (is_inner > 0 ? 1.3 : 1);
        control[k][0] = r * cos(angle), control[k][1] = r * sin(angle);
        control[k][2] = level ? 0.8 * radius : is_inner * rise * (1 + 0.2 * i);
      }
      add_curve(&made, 3, control);
    }
  for (int i = 0; i < 3; ++i) {
    const double *a = made.control[i][0], *b = made.control[3 + i][0];
    add_line(&made, a[0], a[1], a[2], b[0], b[1], b[2]);
  }
  for (int i = 0; i < 3; ++i) {
    add_patch(&made, i, 3 + i, 6 + i, 6 + (i + 1) % 3);
    made.leaflet_id[i] = i;
  }
  return made;
}

static void scale_value(riis_valve *valve, const char *name, double by) {
  double value;
  CHECK_OK(riis_valve_get(valve, name, 1, &value));
  CHECK_OK(riis_valve_set_scalar(valve, name, value * by));
}

static riis_valve *valve_at(int kind, const state_of_skirt *at) {
  static const char *const sizes[n_kinds - 1][2] = {{"root_radius", "leaflet_height"},
                                                    {"root_radius", "leaflet_height"},
                                                    {"root_radius", "commissure_height"},
                                                    {"AP_diameter", "anterior_horn_height"}};
  riis_valve *valve = NULL;
  if (kind == of_patches) {
    const shape closed = cone(at->size[0], 0.3 * at->size[1], 0.4), open = cone(1.1 * at->size[0], 0.1, 0.7);
    riis_valve *opened = valve_from(&open);
    valve = valve_from(&closed);
    CHECK_OK(riis_valve_set_open_state(valve, opened));
    free_one_owned(opened);
  } else {
    valve = new_valve(kinds[kind]);
    for (int i = 0; i < 2; ++i) scale_value(valve, sizes[kind][i], at->size[i]);
  }
  CHECK_OK(riis_valve_set_scalar(valve, "opening", at->opening));
  CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.15 * at->size[2]));
  return valve;
}

/* Places a point as riis_surface_options says, by Rodrigues' formula. */
static void place(const riis_surface_options *by, const double *p, double *placed) {
  const double *a = by->rotation_axis, size = sqrt(dot(a, a)), angle = by->rotation_angle * acos(-1) / 180;
  const double c = cos(angle), s = sin(angle), k[3] = {a[0] / size, a[1] / size, a[2] / size};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    placed[i] =
        by->scale * (c * p[i] + s * (k[j] * p[l] - k[l] * p[j]) + (1 - c) * k[i] * dot(k, p)) + by->translation[i];
  }
}

static void random_state(state_of_skirt *at, int32_t triangulation) {
  at->opening = between(0.1, 0.9);
  for (int i = 0; i < 3; ++i) at->size[i] = between(0.97, 1.03);
  at->placed = surface_options();
  at->placed.triangulation = triangulation;
  at->placed.tolerance = 0.02;
  at->placed.scale = pow(10, between(-1, 1));
  at->placed.half_thickness = 0.1 * at->placed.scale;
  at->placed.rotation_angle = between(-180, 180);
  for (int c = 0; c < 3; ++c)
    at->placed.rotation_axis[c] = between(0.1, 1), at->placed.translation[c] = at->placed.scale * between(-3, 3);
}

enum { opens, grows, is_carried, all_at_once, n_motions };
static const char *const motions[n_motions] = {"opens", "grows", "is carried", "does all of this"};

/* Moves a state by a step of the given time. */
static void move(state_of_skirt *at, int motion, double seconds) {
  if (motion == opens || motion == all_at_once) at->opening += seconds * (between(0, 1) < 0.5 ? -1 : 1);
  for (int i = 0; i < 3 && (motion == grows || motion == all_at_once); ++i) at->size[i] += seconds * between(-1, 1);
  if (motion == is_carried || motion == all_at_once) {
    at->placed.scale *= 1 + seconds * between(-0.5, 0.5);
    at->placed.rotation_angle += seconds * between(-60, 60);
    for (int c = 0; c < 3; ++c) at->placed.translation[c] += seconds * at->placed.scale * between(-1, 1);
  }
}

/* --- The skirt from its definition ------------------------------------------------------------------------------------ */

/* Points at even shares of a strip's inner side, the points outwards from them, and the shares of these points on the outer
 * side. */
enum { n_even = 1000 };
typedef struct strip {
  double inner[n_even + 1][3], outer[n_even + 1][3], share[n_even + 1];
} strip;
enum { max_strips = 20 };
typedef struct skirt {
  int n;
  int32_t patch_id[max_strips];
  strip at[max_strips][2]; /* in both states; index 0 is the earlier state */
} skirt;
static skirt oracle;

static int is_skirt(const riis_triangles *t, int64_t i) { return t->leaflet_id[i] == RIIS_LEAFLET_SKIRT; }

/* Reads the inner sides of all strips from the curves. */
static void read_inner_sides(const riis_triangles *t, const smooth_motion *motion) {
  oracle.n = 0;
  for (int64_t i = 0; i < t->n_triangles; ++i) {
    if (!is_skirt(t, i)) continue;
    int k = 0;
    while (k < oracle.n && oracle.patch_id[k] != t->patch_id[i]) ++k;
    if (k < oracle.n) continue;
    assert_true(oracle.n < max_strips);
    oracle.patch_id[oracle.n++] = t->patch_id[i];
    for (int j = 0; j <= n_even; ++j) {
      const double uv[2] = {j / (double)n_even, 1};
      smooth_motion_places(motion, t->patch_id[i], uv, oracle.at[k][1].inner[j], oracle.at[k][0].inner[j]);
    }
  }
  assert_true(oracle.n > 0);
}

/* Writes the line from which the skirt leads away, in one state. */
static void axis_at(int kind, int state, double *centre, double *direction) {
  for (int c = 0; c < 3; ++c) centre[c] = 0, direction[c] = c == 2;
  if (kind != mitral && kind != of_patches) return;
  double whole = 0, area[3] = {0, 0, 0};
  for (int k = 0; k < oracle.n; ++k)
    for (int j = 0; j < n_even; ++j) {
      const double *p = oracle.at[k][state].inner[j], *q = oracle.at[k][state].inner[j + 1], size = distance(p, q);
      whole += size;
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        centre[c] += 0.5 * size * (p[c] + q[c]), area[c] += 0.5 * (p[d] * q[e] - p[e] * q[d]);
      }
    }
  for (int c = 0; c < 3; ++c) centre[c] /= whole;
  if (kind == of_patches)
    for (int c = 0; c < 3; ++c) direction[c] = area[c] / sqrt(dot(area, area));
}

static void make_outer_sides(int kind, int state, double length) {
  double centre[3], direction[3];
  axis_at(kind, state, centre, direction);
  for (int k = 0; k < oracle.n; ++k) {
    strip *at = &oracle.at[k][state];
    at->share[0] = 0;
    for (int j = 0; j <= n_even; ++j) {
      double q[3];
      for (int c = 0; c < 3; ++c) q[c] = at->inner[j][c] - centre[c];
      const double along = dot(q, direction);
      for (int c = 0; c < 3; ++c) q[c] -= along * direction[c];
      const double size = sqrt(dot(q, q));
      for (int c = 0; c < 3; ++c) at->outer[j][c] = at->inner[j][c] + length / size * q[c];
      if (j > 0) at->share[j] = at->share[j - 1] + distance(at->outer[j - 1], at->outer[j]);
    }
    for (int j = 0; j <= n_even; ++j) at->share[j] /= at->share[n_even];
    at->share[n_even] = 1;
  }
}

/* Writes the point of a strip with a label. */
static void skirt_point(int32_t patch_id, const double *uv, int state, double *p) {
  int k = 0;
  while (oracle.patch_id[k] != patch_id) ++k;
  const strip *at = &oracle.at[k][state];
  const double x = uv[0] * n_even;
  const int even = (int)fmin(x, n_even - 1);
  int low = 0;
  for (int high = n_even; high - low > 1;) *(at->share[(low + high) / 2] <= uv[0] ? &low : &high) = (low + high) / 2;
  const double y = (uv[0] - at->share[low]) / (at->share[low + 1] - at->share[low]);
  for (int c = 0; c < 3; ++c)
    p[c] = uv[1] * (at->inner[even][c] + (x - even) * (at->inner[even + 1][c] - at->inner[even][c])) +
           (1 - uv[1]) * (at->outer[low][c] + y * (at->outer[low + 1][c] - at->outer[low][c]));
}

static double fastest_of_skirt(const riis_triangles *t) {
  static const double zero[3] = {0, 0, 0};
  double fastest = 0;
  for (int64_t i = 0; i < t->n_triangles; ++i)
    for (int k = 0; k < 3 && is_skirt(t, i); ++k)
      fastest = fmax(fastest, distance(t->velocity + 3 * t->vertex_id[3 * i + k], zero));
  return fastest;
}

/* The velocity is the central displacement of a fixed label at the middle of the step. A label has two shares of a length: along
 * the attachment, and along the line outwards from it. Inside triangles the error stays within the bound of velocities. */
TEST(skirts_have_the_velocity_of_their_points) {
  for (int kind = 0; kind < n_kinds; ++kind)
    for (int fixed = 0; fixed < 2; ++fixed) {
      double worst[n_motions] = {0};
      for (int motion = 0; motion < n_motions; ++motion) {
        if (is_short_test() && motion != (kind + 2 * fixed) % n_motions) continue;
        const int owned_before = n_owned();
        const double seconds = 0.01;
        state_of_skirt then, now;
        random_state(&then, fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
        now = then;
        move(&now, motion, seconds);
        riis_valve *valve = valve_at(kind, &now), *before = valve_at(kind, &then);
        riis_surface *surface = new_surface(valve, &now.placed);
        CHECK_OK(riis_surface_update_moving(surface, valve, before, seconds, &now.placed, &then.placed));
        const riis_triangles t = triangles_of(surface);
        smooth_motion *smooth = smooth_motion_create(valve, before, seconds);
        read_inner_sides(&t, smooth);
        make_outer_sides(kind, 0, 0.15 * then.size[2]);
        make_outer_sides(kind, 1, 0.15 * now.size[2]);
        const double fastest = fastest_of_skirt(&t),
                     bound = velocity_error_bound(surface, valve, before, seconds, &then.placed);
        double inside = 0;
        for (int64_t i = 0; i < t.n_triangles; ++i)
          for (int k = 0; k < 4 && is_skirt(&t, i); ++k) { /* the corners and a place between them */
            double weight[3] = {k == 0, k == 1, k == 2}, uv[2] = {0, 0}, found[3] = {0, 0, 0}, p[2][3], placed[2][3];
            if (k == 3) {
              for (int c = 0; c < 3; ++c) weight[c] = between(0, 1);
              const double sum = weight[0] + weight[1] + weight[2];
              for (int c = 0; c < 3; ++c) weight[c] /= sum;
            }
            for (int c = 0; c < 3; ++c) {
              const int64_t id = t.vertex_id[3 * i + c];
              for (int x = 0; x < 2; ++x) uv[x] += weight[c] * t.uv[2 * id + x];
              for (int x = 0; x < 3; ++x) found[x] += weight[c] * t.velocity[3 * id + x];
            }
            for (int s = 0; s < 2; ++s) {
              if (k < 3)
                skirt_point(t.patch_id[i], uv, s, p[s]);
              else
                smooth_motion_places(smooth, t.patch_id[i], uv, p[1], p[0]);
              place(s ? &now.placed : &then.placed, p[s], placed[s]);
            }
            for (int x = 0; x < 3; ++x) p[0][x] = (placed[1][x] - placed[0][x]) / seconds;
            double *off = k < 3 ? &worst[motion] : &inside;
            *off = fmax(*off, distance(p[0], found) / fastest);
          }
        printf(
            "%s, %s, %s: off by %.2g %% of the largest speed at vertices, %.2g %% inside triangles of at most %.2g\n",
            kinds[kind], fixed ? "fixed" : "adapted", motions[motion], 100 * worst[motion], 100 * inside,
            100 * bound / fastest);
        CHECK_AT_MOST(worst[motion], 0.015); /* the cubics of the outer side are accurate to a thousandth */
        CHECK_AT_MOST(inside * fastest, bound + 1e-9 * fastest);
        smooth_motion_destroy(smooth);
        free_owned_after(owned_before);
      }
    }
}

/* --- Vertices of a fixed triangulation -------------------------------------------------------------------------------- */

/* Returns the largest difference between a triangle's velocity and its motion. Velocity and motion are taken at the triangle's
 * centroid, along its normal. */
static double across(const riis_triangles *t, const double *was, double seconds, int64_t i) {
  const int64_t *id = t->vertex_id + 3 * i;
  const double *a = t->xyz + 3 * id[0], *b = t->xyz + 3 * id[1], *c = t->xyz + 3 * id[2];
  double normal[3], off[3] = {0, 0, 0};
  for (int x = 0; x < 3; ++x) {
    const int y = (x + 1) % 3, z = (x + 2) % 3;
    normal[x] = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
    for (int k = 0; k < 3; ++k)
      off[x] += (t->velocity[3 * id[k] + x] - (t->xyz[3 * id[k] + x] - was[3 * id[k] + x]) / seconds) / 3;
  }
  return fabs(dot(off, normal)) / sqrt(dot(normal, normal));
}

/* With a fixed triangulation, the skirt's vertices move with their velocities. The lines of a mitral skirt also slide along the
 * annulus with the lines of the leaflet. The velocity does not contain this slide. */
TEST(vertices_of_fixed_skirts_move_with_their_velocities) {
  for (int kind = 0; kind < n_kinds; kind += trial_step()) {
    const int owned_before = n_owned();
    const double seconds = 0.01;
    state_of_skirt then, now;
    random_state(&then, RIIS_TRIANGULATION_FIXED);
    then.placed.tolerance = 0.005;
    now = then;
    move(&now, opens, seconds);
    riis_valve *valve = valve_at(kind, &now), *before = valve_at(kind, &then);
    riis_surface *surface = new_surface(before, &then.placed);
    const kept_vertices was = vertices_of(surface);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, seconds, NULL, NULL));
    const riis_triangles t = triangles_of(surface);
    assert_int_equal(t.n_vertices, was.n);
    const double fastest = fastest_of_skirt(&t);
    double worst = 0, slide = 0, through = 0;
    for (int64_t i = 0; i < t.n_triangles; ++i) {
      if (!is_skirt(&t, i)) continue;
      through = fmax(through, across(&t, was.xyz, seconds, i) / fastest);
      for (int k = 0; k < 3; ++k) {
        const int64_t id = t.vertex_id[3 * i + k];
        double from[3] = {0, 0, 0}, moved[3];
        assert_true(value_at_label(&t, was.uv, was.xyz, t.patch_id[i], t.uv + 2 * id, from));
        for (int c = 0; c < 3; ++c) moved[c] = (t.xyz[3 * id + c] - from[c]) / seconds;
        worst = fmax(worst, distance(moved, t.velocity + 3 * id) / fastest);
        slide = fmax(slide, distance(from, was.xyz + 3 * id) / seconds / fastest);
      }
    }
    printf("%s: off by %.2g %% of the largest speed, across by %.2g %%; vertices slide by %.2g %%\n", kinds[kind],
           100 * worst, 100 * through, 100 * slide);
    CHECK_AT_MOST(worst, 0.002);
    CHECK_AT_MOST(through, 0.002);
    if (kind != mitral) CHECK_AT_MOST(slide, 1e-9);
    free_owned_after(owned_before);
  }
}

/* --- A moving warp ---------------------------------------------------------------------------------------------------- */

/* Gives a valve a warp that moves its attachment with the beat. */
static riis_warp *warp_at(riis_valve *valve, const riis_surface *rest, double time, const double *of) {
  enum { n_wanted = 40 };
  double from[3 * n_wanted], to[3 * n_wanted];
  riis_attachment attachment;
  CHECK_OK(riis_surface_get_attachment(rest, &attachment, sizeof attachment));
  int64_t n = 0;
  for (int64_t k = 0; k < n_wanted; ++k) {
    const double *point = attachment.edges + 6 * (k * attachment.n_edges / n_wanted);
    int is_new = 1;
    for (int64_t i = 0; i < n; ++i) is_new = is_new && distance(from + 3 * i, point) > 0.05;
    if (is_new) memcpy(from + 3 * n++, point, 3 * sizeof *point);
  }
  for (int64_t i = 0; i < n; ++i) beat(from + 3 * i, time, of, to + 3 * i);
  const riis_points sources = points_at(n, from), targets = points_at(n, to);
  riis_warp *warp = NULL;
  CHECK_OK(riis_warp_create(&sources, NULL, &warp));
  own(warp);
  CHECK_OK(riis_warp_set_targets(warp, &targets));
  CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
  return warp;
}

/* The outer side of a strip, as a function of the inner side's share. The spans of the outer side belong to equal parts of the
 * inner side. */
typedef struct outer_side {
  int64_t n_pieces;
  double control[8][4][3];
} outer_side;

static outer_side outer_side_of(riis_valve *valve, int32_t patch_id) {
  riis_valve_patches patches;
  outer_side made = {0, {{{0}}}};
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  for (int64_t i = 0; i < patches.n_patches; ++i) {
    if (patches.patch_id[i] != patch_id) continue;
    const int64_t curve = patches.curve_id[4 * i], first = patches.first_piece[curve];
    made.n_pieces = patches.first_piece[curve + 1] - first;
    assert_int_equal(made.n_pieces, 8);
    int64_t behind = 0;
    for (int64_t piece = 0; piece < first; ++piece) behind += patches.degree[piece] + 1;
    for (int piece = 0; piece < 8; ++piece) assert_int_equal(patches.degree[first + piece], 3);
    memcpy(made.control, patches.control + 3 * behind, sizeof made.control);
  }
  return made;
}

static void outer_point(const outer_side *on, double share, double *p) {
  const int piece = (int)fmin(7, floor(8 * share));
  const double t = 8 * share - piece, s = 1 - t, weight[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  for (int c = 0; c < 3; ++c) {
    p[c] = 0;
    for (int k = 0; k < 4; ++k) p[c] += weight[k] * on->control[piece][k][c];
  }
}

/* Returns the share of the outer side's length that lies before a share of the inner side. */
static double outer_share(const outer_side *on, double share) {
  enum { n = 2000 };
  double last[3], p[3], whole = 0, before = 0;
  outer_point(on, 0, last);
  for (int i = 1; i <= n; ++i) {
    outer_point(on, i / (double)n, p);
    const double step = distance(p, last);
    before += step * fmin(1, fmax(0, share * n - (i - 1)));
    whole += step;
    memcpy(last, p, sizeof p);
  }
  return before / whole;
}

static void inner_point(const strip *at, double share, double *p) {
  const int j = (int)fmin(n_even - 1, share * n_even);
  for (int c = 0; c < 3; ++c) p[c] = at->inner[j][c] + (share * n_even - j) * (at->inner[j + 1][c] - at->inner[j][c]);
}

/* Returns the share on a strip's inner side at which the side is nearest to a point, in one state of a motion. */
static double nearest_share(const strip *at, const double *p) {
  int nearest = 0;
  for (int j = 0; j <= n_even; ++j)
    if (distance(at->inner[j], p) < distance(at->inner[nearest], p)) nearest = j;
  double best = INFINITY, share = 0;
  for (int j = nearest > 0 ? nearest - 1 : 0; j < n_even && j <= nearest; ++j) {
    double along[3], from[3], foot[3];
    for (int c = 0; c < 3; ++c) along[c] = at->inner[j + 1][c] - at->inner[j][c], from[c] = p[c] - at->inner[j][c];
    const double x = fmin(1, fmax(0, dot(along, from) / dot(along, along)));
    for (int c = 0; c < 3; ++c) foot[c] = at->inner[j][c] + x * along[c];
    if (distance(foot, p) < best) best = distance(foot, p), share = (j + x) / n_even;
  }
  return share;
}

/* The attachment of a warped valve is material that the map moves. The skirt's inner side moves with the material of the
 * attachment. The outer side moves with the points that lie outwards from it. */
TEST(skirts_move_with_warped_attachments) {
  for (int kind = 0; kind < n_kinds; ++kind)
    for (int fixed = 0; fixed < 2; ++fixed) {
      if (is_short_test() && (fixed || kind > 0)) continue;
      const int owned_before = n_owned();
      const double seconds = 0.01, time = between(0, 1);
      const double of[4] = {between(0.03, 0.08), between(0.03, 0.06), between(0.03, 0.08), between(0.1, 0.2)};
      state_of_skirt then, now;
      random_state(&then, fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
      const riis_surface_options in_place = surface_options();
      then.placed = in_place;
      then.placed.triangulation = fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
      then.placed.tolerance = 0.002; /* so velocities between vertices are hardly less exact than at vertices */
      now = then;
      if (between(0, 1) < 0.5) move(&now, opens, seconds);
      riis_valve *valve = valve_at(kind, &now), *before = valve_at(kind, &then);
      riis_valve *rest_now = valve_at(kind, &now), *rest_before = valve_at(kind, &then);
      const riis_surface *at_rest = new_surface(rest_now, NULL);
      riis_warp *map_now = warp_at(valve, at_rest, time + seconds, of),
                *map_before = warp_at(before, at_rest, time, of);
      riis_surface *surface = new_surface(valve, &then.placed);
      CHECK_OK(riis_surface_update_moving(surface, valve, before, seconds, NULL, NULL));
      const riis_triangles t = triangles_of(surface);
      smooth_motion *warped = smooth_motion_create(valve, before, seconds),
                    *resting = smooth_motion_create(rest_now, rest_before, seconds);
      read_inner_sides(&t, warped);
      const double fastest = fastest_of_skirt(&t);
      double worst[2] = {0, 0};
      for (int k = 0; k < oracle.n; ++k) {
        const int32_t patch_id = oracle.patch_id[k];
        outer_side outer[2] = {outer_side_of(before, patch_id), outer_side_of(valve, patch_id)};
        for (int j = 0; j <= 24; ++j) {
          const double label[2] = {j / 24.0, 1};
          double x[2][3], y[2][3], share[2], wanted[3], found[3] = {0, 0, 0};
          smooth_motion_places(resting, patch_id, label, x[1], x[0]);
          for (int s = 0; s < 2; ++s) {
            const riis_points point = points_at(1, x[s]);
            CHECK_OK(riis_warp_map(s ? map_now : map_before, &point, y[s]));
            share[s] = nearest_share(&oracle.at[k][s], y[s]);
          }
          for (int is_outer = 0; is_outer < 2; ++is_outer) {
            if (is_outer)
              for (int s = 0; s < 2; ++s) {
                double p[3], q[3];
                inner_point(&oracle.at[k][s], share[s], p), outer_point(&outer[s], share[s], q);
                for (int c = 0; c < 3; ++c) y[s][c] += q[c] - p[c];
              }
            const double uv[2] = {is_outer ? outer_share(&outer[1], share[1]) : share[1], is_outer ? 0 : 1};
            assert_true(value_at_label(&t, t.uv, t.velocity, patch_id, uv, found));
            for (int c = 0; c < 3; ++c) wanted[c] = (y[1][c] - y[0][c]) / seconds;
            worst[is_outer] = fmax(worst[is_outer], distance(wanted, found) / fastest);
          }
        }
      }
      smooth_motion_destroy(warped), smooth_motion_destroy(resting);
      printf("%s, %s, warped: off by %.2g %% of the largest speed at the attachment, %.2g %% at the outer edge\n",
             kinds[kind], fixed ? "fixed" : "adapted", 100 * worst[0], 100 * worst[1]);
      /* A curve of the patches turns by 120 degrees, so the slide of the curve's material is less exact. */
      const double allowed = kind == of_patches ? 0.03 : 0.01;
      CHECK_AT_MOST(worst[0], allowed);
      CHECK_AT_MOST(worst[1], allowed);
      free_owned_after(owned_before);
    }
}

int main(void) {
  rng = random_start("test_skirt_motion");
  return run_cases(NULL, NULL);
}
