/* SPDX-License-Identifier: Apache-2.0
 * Finds the outline of leaflets, seen along an axis. In each of many directions, the triangles' farthest point belongs to the
 * outline. */
#ifndef RIIS_TEST_FARTHEST_OUTLINE_H
#define RIIS_TEST_FARTHEST_OUTLINE_H

#include <math.h>
#include <stdint.h>

/* Two unit vectors perpendicular to the axis of view, which is the third direction of the frame. */
typedef struct frame {
  double x[3], y[3];
} frame;

static inline frame frame_of(const double *axis) {
  frame made;
  const int least =
      fabs(axis[0]) < fabs(axis[1]) ? (fabs(axis[0]) < fabs(axis[2]) ? 0 : 2) : (fabs(axis[1]) < fabs(axis[2]) ? 1 : 2);
  double size = 0;
  for (int k = 0; k < 3; ++k) made.x[k] = (k == least) - axis[least] * axis[k];
  for (int k = 0; k < 3; ++k) size += made.x[k] * made.x[k];
  for (int k = 0; k < 3; ++k) made.x[k] /= sqrt(size);
  for (int k = 0; k < 3; ++k)
    made.y[k] = axis[(k + 1) % 3] * made.x[(k + 2) % 3] - axis[(k + 2) % 3] * made.x[(k + 1) % 3];
  return made;
}

static inline void seen_from(const frame *of, const double *p, double *out) {
  out[0] = of->x[0] * p[0] + of->x[1] * p[1] + of->x[2] * p[2];
  out[1] = of->y[0] * p[0] + of->y[1] * p[1] + of->y[2] * p[2];
}

/* The outline of triangles seen along an axis: the farthest points of their edges from the middle, in many directions. Edges
 * inside a leaflet also count. They do no harm, because the boundary is farther out, or triangles cover the area up to it. */
enum { n_directions = 1440 };
typedef struct outline {
  double middle[2], distance[n_directions], reach;
} outline;

static const double turn_of_direction = 2 * 3.14159265358979323846 / n_directions;

static inline void add_edge(outline *to, const double *from, const double *until) {
  double a[2], b[2];
  for (int k = 0; k < 2; ++k) a[k] = from[k] - to->middle[k], b[k] = until[k] - to->middle[k];
  const double turning = a[0] * b[1] - a[1] * b[0];
  if (turning < 0) {
    add_edge(to, until, from);
    return;
  }
  const double size = hypot(a[0], a[1]), other = hypot(b[0], b[1]), most = fmax(size, other);
  if (turning <= 1e-10 * size * other) return; /* seen along the axis, the edge is only a point */
  const double low = atan2(a[1], a[0]), wide = atan2(turning, a[0] * b[0] + a[1] * b[1]);
  for (int i = (int)ceil(low / turn_of_direction); i * turn_of_direction <= low + wide; ++i) {
    const double c = cos(i * turn_of_direction), s = sin(i * turn_of_direction);
    const double across = c * (b[1] - a[1]) - s * (b[0] - a[0]), distance = turning / across;
    double *far = to->distance + (i % n_directions + n_directions) % n_directions;
    if (across > 0 && distance > *far) *far = fmin(distance, most);
  }
}

/* Returns the outline of triangles. `ids` are the positions of the triangles' vertices in `xyz`. */
static inline outline outline_of(const double *xyz, int64_t n_triangles, const int64_t *ids, const frame *seen) {
  outline made = {{0, 0}, {0}, 0};
  for (int64_t i = 0; i < 3 * n_triangles; ++i) {
    double p[2];
    seen_from(seen, xyz + 3 * ids[i], p);
    for (int k = 0; k < 2; ++k) made.middle[k] += (p[k] - made.middle[k]) / (double)(i + 1);
  }
  for (int64_t i = 0; i < 3 * n_triangles; ++i) {
    double a[2], b[2];
    seen_from(seen, xyz + 3 * ids[i], a);
    seen_from(seen, xyz + 3 * ids[i % 3 == 2 ? i - 2 : i + 1], b);
    add_edge(&made, a, b);
  }
  for (int i = 0; i < n_directions; ++i) made.reach = fmax(made.reach, made.distance[i]);
  return made;
}

/* Returns whether a point is inside the outline. The point is given relative to the middle. */
static inline int is_inside(const outline *of, double x, double y) {
  const double direction = atan2(y, x) / turn_of_direction, share = direction - floor(direction);
  const int first = ((int)floor(direction) % n_directions + n_directions) % n_directions;
  return hypot(x, y) < (1 - share) * of->distance[first] + share * of->distance[(first + 1) % n_directions];
}

#endif
