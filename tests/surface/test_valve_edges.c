/* SPDX-License-Identifier: Apache-2.0
 * Tests free edges and orifices of valves that patients have. The edges come from the sides of patches. A raster of the triangles
 * measures the orifices. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"
#include "studied_valves.h"

static random_source rng;

/* A side of a patch. */
typedef struct patch_side {
  double first[3], last[3], length;
} patch_side;

static double speed_of(const double *control, int degree, double t) {
  double q[4][3], square = 0;
  memcpy(q, control, (size_t)(degree + 1) * sizeof *q);
  for (int n = degree; n > 1; --n)
    for (int k = 0; k < n; ++k)
      for (int c = 0; c < 3; ++c) q[k][c] += t * (q[k + 1][c] - q[k][c]);
  for (int c = 0; c < 3; ++c) square += pow(degree * (q[1][c] - q[0][c]), 2);
  return sqrt(square);
}

/* This rule defines the length of a free edge: Gauss's rule with four points on each of 16 parts. */
static double length_of_piece(const double *control, int degree) {
  enum { n_panels = 16 };
  double sum = 0;
  for (int i = 0; i < 4 * n_panels; ++i) {
    const int is_outer = i % 4 == 0 || i % 4 == 3;
    const double root = 2 * sqrt(1.2), at = sqrt((3 + (is_outer ? root : -root)) / 7);
    const double weight = (18 + (is_outer ? -1 : 1) * sqrt(30)) / 72;
    sum += weight * speed_of(control, degree, (i / 4 + 0.5 + (i % 4 < 2 ? -0.5 : 0.5) * at) / n_panels);
  }
  return sum / n_panels;
}

static patch_side side_of(const riis_valve_patches *patches, int64_t patch, int number) {
  const int64_t curve = patches->curve_id[4 * patch + number];
  const double *control = patches->control;
  patch_side made = {{0}, {0}, 0};
  for (int64_t i = 0; i < patches->first_piece[curve + 1]; ++i) {
    if (i >= patches->first_piece[curve]) {
      if (i == patches->first_piece[curve]) memcpy(made.first, control, sizeof made.first);
      made.length += length_of_piece(control, patches->degree[i]);
      memcpy(made.last, control + 3 * patches->degree[i], sizeof made.last);
    }
    control += 3 * (patches->degree[i] + 1);
  }
  return made;
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

static int is_same_side(const patch_side *a, const patch_side *b) {
  const double along = fmax(distance(a->first, b->first), distance(a->last, b->last));
  const double against = fmax(distance(a->first, b->last), distance(a->last, b->first));
  return fmin(along, against) < 1e-9 && fabs(a->length - b->length) < 1e-9;
}

/* Adds the lengths of each leaflet's free edge. A free edge consists of sides that are not attached and that no other patch
 * shares. */
static void lengths_of_edges(riis_valve *valve, double *lengths) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  patch_side *sides = own(malloc((size_t)(4 * patches.n_patches) * sizeof *sides));
  for (int64_t i = 0; i < 4 * patches.n_patches; ++i) sides[i] = side_of(&patches, i / 4, (int)(i % 4));
  for (int k = 0; k < max_leaflets; ++k) lengths[k] = 0;
  for (int64_t i = 0; i < 4 * patches.n_patches; ++i) {
    int is_free = patches.attached[i / 4] != i % 4;
    for (int64_t j = 0; j < 4 * patches.n_patches && is_free; ++j)
      is_free = i / 4 == j / 4 || !is_same_side(&sides[i], &sides[j]);
    if (is_free) lengths[patches.leaflet_id[i / 4]] += sides[i].length;
  }
  free_one_owned(sides);
}

/* The free edge keeps its length if it does not stretch. Fusion does not matter. */
TEST(free_edges_keep_their_length) {
  double worst = 0;
  for (int trial = 0; trial < trials(3 * n_studied, 40 * n_studied); ++trial) {
    const int owned_before = n_owned();
    const sickness has = (sickness)(trial / n_studied % n_sicknesses);
    const studied *of = &all_studied[trial % n_studied];
    riis_valve *valve = of->has_cusps ? random_valve(&rng, of, 0.1, has) : NULL;
    if (!valve) continue;
    if (has == fused) { /* the fused part does not stretch */
      riis_valve_patches patches;
      CHECK_OK(riis_valve_set_scalar(valve, "edge_stretch", 0));
      if (riis_valve_get_patches(valve, &patches, sizeof patches) != RIIS_OK) continue;
    }
    double closed[max_leaflets], now[max_leaflets];
    lengths_of_edges(valve, closed);
    for (int i = 0; i <= 8; ++i) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 8.0));
      lengths_of_edges(valve, now);
      const double stretched = 1 + i / 8.0 * get(valve, "edge_stretch");
      for (int k = 0; k < of->n_leaflets; ++k) {
        assert_true(closed[k] > get(valve, "commissure_radius"));
        worst = fmax(worst, fabs(now[k] / closed[k] / stretched - 1));
      }
    }
    free_owned_after(owned_before);
  }
  printf("the length of a free edge differs from the rule by %.2g of it at most\n", worst);
  CHECK_AT_MOST(worst, 1e-12);
}

/* Returns the area inside the outline that no triangle covers, seen along the axis. The part of the grid outside an annulus does
 * not count. */
static double open_area(const riis_surface *surface, double root_radius) {
  enum { n = 400 };
  riis_attachment annulus;
  if (root_radius > 0) return orifice_area(surface, root_radius, n);
  CHECK_OK(riis_surface_get_attachment(surface, &annulus, sizeof annulus));
  int64_t n_beside = 0;
  for (int i = 0; i < n * n; ++i) {
    const double x = half_width * ((2.0 * (i % n) + 1) / n - 1), y = half_width * ((2.0 * (i / n) + 1) / n - 1);
    n_beside += hypot(x, y) <= half_width && !is_inside(&annulus, x, y);
  }
  return orifice_area(surface, half_width, n) - (double)n_beside * pow(2.0 * half_width / n, 2);
}

/* The orifices at the openings 0, 1/4, 1/2, 3/4 and 1, from another implementation of the construction. -1 stands for an unknown
 * orifice. */
typedef struct orifices {
  const char *kind, *settings;
  double area[5];
} orifices;
#define EQUAL "root_radius=1.25 "
#define LARGE "root_radius=1.35 edge_stretch=0.1 "
#define UNLIKE LARGE "cusp_0.sector=150 cusp_1.sector=210 meeting_shift=0.13 "
#define FUSED(fusion, ratio) EQUAL "fusion=" fusion " open_radius_ratio=" ratio
#define FUSED_PAIR(fusion) LARGE "fusion=" fusion
static const orifices all_orifices[] = {
    {"coapting", EQUAL, {0.05, 1.03, 2.08, 3.18, 4.29}},
    {"quadricuspid",
     "cusp_3.sector=54 cusp_0.sector=90 cusp_1.sector=90 cusp_2.sector=90",
     {.06, 1.04, 2.08, 3.15, 4.23}},
    {"bicuspid", EQUAL "edge_stretch=0", {-1, -1, -1, -1, 2.32}},
    {"bicuspid", EQUAL "edge_stretch=0.1", {-1, -1, -1, -1, 3.13}},
    {"bicuspid", EQUAL "edge_stretch=0 cusp_0.sector=140 cusp_1.sector=220", {0.07, 0.60, 1.17, 1.77, 2.41}},
    {"bicuspid", LARGE, {0.06, 0.83, 1.70, 2.65, 3.65}},
    {"bicuspid", UNLIKE, {0.07, 0.80, 1.60, 2.47, 3.40}},
    {"bicuspid", UNLIKE "bump_0.leaflet=1 bump_0.width=0.25 bump_0.open=0", {0.07, 0.62, 1.22, 1.84, 2.48}},
    {"coapting", FUSED("0.2", "0.85"), {-1, -1, -1, -1, 3.49}},
    {"coapting", FUSED("0.4", "0.85"), {-1, -1, -1, -1, 1.79}},
    {"coapting", FUSED("0.5", "0.85"), {-1, -1, -1, -1, 1.15}},
    {"coapting", FUSED("0.2", "0.3"), {-1, -1, -1, -1, 0.91}},
    {"coapting", FUSED("0.4", "0.3"), {-1, -1, -1, -1, 0.78}},
    {"bicuspid", FUSED_PAIR("0.3"), {-1, -1, -1, -1, 1.21}},
    {"bicuspid", FUSED_PAIR("0.4"), {-1, -1, -1, -1, 0.72}},
    {"coapting", EQUAL "bump_0.leaflet=0 bump_0.width=10 bump_0.open=0.35", {-1, -1, -1, -1, 3.35}},
    {"coapting", EQUAL "bump_0.leaflet=0 bump_0.width=1 bump_0.open=0.35", {-1, -1, -1, -1, 3.41}},
};

TEST(orifices_are_those_of_the_prototype) {
  for (size_t row = 0; row < sizeof all_orifices / sizeof *all_orifices; row += (size_t)trial_step()) {
    const orifices *of = &all_orifices[row];
    riis_valve *valve = valve_of(of->kind, of->settings);
    printf("%s %s:", of->kind, of->settings);
    double off = 0;
    for (int i = 0; i < 5; ++i) {
      if (of->area[i] < 0) continue;
      riis_surface *surface = surface_at(valve, 0.25 * i, NULL);
      riis_orifice orifice;
      const double area = open_area(surface, get(valve, "root_radius"));
      CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
      printf(" %.2f, %.2f for %.2f;", area, orifice.area, of->area[i]);
      off = fmax(off, fabs(area - of->area[i]));
      /* The library's outline is the attachment, which differs from the disc, because the commissures expand. */
      CHECK_NEAR(orifice.area, area, 0.05 * of->area[4]);
    }
    printf(" off by %.1f %% of the open one\n", 100 * off / of->area[4]);
    CHECK_AT_MOST(off, 0.02 * of->area[4] + 0.005); /* the table is rounded */
  }
}

int main(void) {
  rng = random_start("test_valve_edges");
  return run_cases(NULL, NULL);
}
