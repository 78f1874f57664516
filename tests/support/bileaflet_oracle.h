/* SPDX-License-Identifier: Apache-2.0
 * Describes the bileaflet valve in closed form: the positions of a leaflet's points at an angle, and the distance of a
 * point from a leaflet. Include after riis.h, test_support.h and handles.h. */
#ifndef RIIS_TEST_BILEAFLET_ORACLE_H
#define RIIS_TEST_BILEAFLET_ORACLE_H

static const double degree = 3.14159265358979323846 / 180;

/* Lengths, and angles in degrees. */
typedef struct bileaflet {
  double radius, hinge_offset, hinge_height, gap, closed_angle, open_angle, ring_height, opening;
} bileaflet;

static inline bileaflet bileaflet_defaults(void) { return (bileaflet){1.1, 0.22, 0, 0, 30, 85, 0, 0}; }

#define BILEAFLET_FIELD(name) \
  { #name, offsetof(bileaflet, name) }
static const struct {
  const char *name;
  size_t at;
} bileaflet_fields[] = {BILEAFLET_FIELD(radius),      BILEAFLET_FIELD(hinge_offset), BILEAFLET_FIELD(hinge_height),
                        BILEAFLET_FIELD(gap),         BILEAFLET_FIELD(closed_angle), BILEAFLET_FIELD(open_angle),
                        BILEAFLET_FIELD(ring_height), BILEAFLET_FIELD(opening)};
enum { n_bileaflet_fields = sizeof bileaflet_fields / sizeof *bileaflet_fields };

static inline const double *bileaflet_field(const bileaflet *of, int i) {
  return (const double *)(const void *)((const char *)of + bileaflet_fields[i].at);
}

static inline riis_valve *bileaflet_valve(const bileaflet *of) {
  riis_valve *valve = new_valve("bileaflet");
  for (int i = 0; i < n_bileaflet_fields; ++i)
    CHECK_OK(riis_valve_set_scalar(valve, bileaflet_fields[i].name, *bileaflet_field(of, i)));
  return valve;
}

static inline riis_surface *bileaflet_surface(const bileaflet *of, const riis_surface_options *options) {
  riis_valve *valve = bileaflet_valve(of);
  riis_surface *surface = new_surface(valve, options);
  free_one_owned(valve);
  return surface;
}

/* Makes a valve with random values that are valid together. The leaflets close to an angle below most_closed. */
static inline bileaflet random_bileaflet(random_source *random, double most_closed) {
  bileaflet made = bileaflet_defaults();
  made.radius = random_between(random, 0.5, 2);
  made.hinge_offset = random_between(random, 0, 0.9) * made.radius;
  made.hinge_height = random_between(random, -1, 1);
  made.gap = random_between(random, 0, 1) < 0.5 ? 0 : random_between(random, 0, 0.5) * made.radius;
  made.closed_angle = random_between(random, 0, most_closed);
  made.open_angle = random_between(random, made.closed_angle + 1, 90);
  made.opening = random_between(random, 0, 1);
  return made;
}

static inline double angle_of(const bileaflet *of, double opening) {
  return degree * (of->closed_angle + opening * (of->open_angle - of->closed_angle));
}

/* Rotates a point by 180 degrees about the axis, from one leaflet to the other. */
static inline void half_turn(int32_t leaflet_id, double *p) {
  if (leaflet_id != RIIS_LEAFLET_NEGATIVE) return;
  p[0] = -p[0], p[1] = -p[1];
}

/* A point in a leaflet's frame. `slope` is the distance from the hinge along the leaflet, away from the axis. `off` is the
 * height over the leaflet's plane. */
typedef struct in_leaflet {
  double slope, y, off;
} in_leaflet;

static inline in_leaflet to_leaflet(const bileaflet *of, int32_t leaflet_id, double opening, const double *p) {
  double q[3] = {p[0], p[1], p[2]};
  half_turn(leaflet_id, q);
  const double angle = angle_of(of, opening), x = q[0] - of->hinge_offset, z = q[2] - of->hinge_height;
  return (in_leaflet){x * cos(angle) + z * sin(angle), q[1], z * cos(angle) - x * sin(angle)};
}

static inline void from_leaflet(const bileaflet *of, int32_t leaflet_id, double opening, in_leaflet at, double *p) {
  const double angle = angle_of(of, opening);
  p[0] = of->hinge_offset + at.slope * cos(angle) - at.off * sin(angle);
  p[1] = at.y;
  p[2] = of->hinge_height + at.slope * sin(angle) + at.off * cos(angle);
  half_turn(leaflet_id, p);
}

/* Returns the squared distance from a point of the leaflet's plane to the rim's point at an angle about the axis. `stretch` is
 * the factor by which the slope lengthens the rim. */
static inline double to_rim_sq(const bileaflet *of, double stretch, double x, double y, double around) {
  const double dx = stretch * (of->radius * cos(around) - x), dy = of->radius * sin(around) - y;
  return dx * dx + dy * dy;
}

/* Returns the distance from a point outside the leaflet to its outline, within the leaflet's plane. (x, y) is the point's
 * position on the closed leaflet, seen along the axis. The middle edge is a segment, and the rim is an ellipse. A golden-section
 * search between samples finds the rim's nearest point. */
static inline double to_outline(const bileaflet *of, double x, double y) {
  const double stretch = 1 / cos(degree * of->closed_angle), x0 = of->gap / 2, R = of->radius;
  const double y_end = sqrt(R * R - x0 * x0), whole = atan2(y_end, x0);
  const double beyond = fmax(fabs(y) - y_end, 0);
  double nearest_sq = stretch * stretch * (x - x0) * (x - x0) + beyond * beyond;
  enum { n_samples = 400 };
  int best = 0;
  double best_sq = INFINITY;
  for (int i = 0; i <= n_samples; ++i) {
    const double sq = to_rim_sq(of, stretch, x, y, whole * (2.0 * i / n_samples - 1));
    if (sq < best_sq) best = i, best_sq = sq;
  }
  double a = whole * fmax(2.0 * (best - 1) / n_samples - 1, -1), b = whole * fmin(2.0 * (best + 1) / n_samples - 1, 1);
  const double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (to_rim_sq(of, stretch, x, y, c) < to_rim_sq(of, stretch, x, y, d))
      b = d;
    else
      a = c;
  }
  nearest_sq = fmin(nearest_sq, fmin(best_sq, to_rim_sq(of, stretch, x, y, 0.5 * (a + b))));
  return sqrt(nearest_sq);
}

static inline double to_bileaflet_leaflet(const bileaflet *of, int32_t leaflet_id, const double *p) {
  const in_leaflet at = to_leaflet(of, leaflet_id, of->opening, p);
  const double x = of->hinge_offset + at.slope * cos(degree * of->closed_angle);
  const int is_over = x >= of->gap / 2 && hypot(x, at.y) <= of->radius;
  return is_over ? fabs(at.off) : hypot(at.off, to_outline(of, x, at.y));
}

/* Returns the distance from a point to the nearer leaflet. */
static inline double to_bileaflet(const bileaflet *of, const double *p) {
  return fmin(to_bileaflet_leaflet(of, RIIS_LEAFLET_POSITIVE, p), to_bileaflet_leaflet(of, RIIS_LEAFLET_NEGATIVE, p));
}

/* Returns the distance from a point to the half x >= 0 of a disc of this radius. The hinge lies in the disc's plane, and the
 * disc's centre is `offset` away from the hinge towards the axis. */
static inline double to_half_disc(double radius, double offset, in_leaflet at) {
  const double x = at.slope + offset, from_centre = hypot(x, at.y);
  if (x >= 0) return hypot(at.off, fmax(from_centre - radius, 0));
  return hypot(at.off, hypot(x, fmax(fabs(at.y) - radius, 0)));
}

/* Returns the area of both leaflets together. Each leaflet is a segment of a disc that is stretched along the slope. */
static inline double bileaflet_area(const bileaflet *of) {
  const double R = of->radius, x0 = of->gap / 2;
  return 2 * (R * R * acos(x0 / R) - x0 * sqrt(R * R - x0 * x0)) / cos(degree * of->closed_angle);
}

#endif
