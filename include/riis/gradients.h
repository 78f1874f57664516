/* SPDX-License-Identifier: Apache-2.0
 * gradients.h - gradients: derivatives of distances, of K and of areas by parameters, landmarks and the placement.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_GRADIENTS_H
#define RIIS_GRADIENTS_H

#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Gradients: directions in which the surface of a valve changes ------------------------------------- */

/* Adds a direction in which the surface of a valve changes with a parameter, a landmark or a number of the placement.
 *   `valve_after`, `valve_before`: two copies of the surface's valve. The parameter is a little larger in valve_after, and a
 *     little smaller in valve_before, than in the surface. If only the placement changes, pass the same valve twice.
 *   `dp`: the parameter's difference from valve_before to valve_after, 1e-30 to 1e30 in magnitude.
 *   `options_after`, `options_before`: scale, rotation and translation of both states; other fields are ignored. NULL: the
 *     surface's options.
 * The first call makes direction 0, and the next call makes direction 1. An update removes all directions. A marking with
 * RIIS_FIELD_GRADIENT gives the derivatives of distances and of K in all directions (docs/theory/gradients.md). Both states are
 * cut into the same triangles as the surface. The rate of a vertex is its displacement from the state before to the state after,
 * divided by dp. The error of the derivative is of second order in dp if the surface is midway between the states, otherwise of
 * first order. A dp of 1e-5 of the parameter's size suits most parameters. The two states need not satisfy the limits of a fixed
 * triangulation.
 * Errors: RIIS_INVALID_ARGUMENT for a surface from arrays and for a dp out of range. RIIS_INVALID_PARAMETER for a state of
 * another kind or with other patches, and for parameters that do not fit together. RIIS_LIMIT_EXCEEDED for more than 1000
 * directions. */
RIIS_API riis_status riis_surface_add_direction(riis_surface *surface, const riis_valve *valve_after,
                                                const riis_valve *valve_before, double dp,
                                                const riis_surface_options *options_after,
                                                const riis_surface_options *options_before);
/* The rates of a surface along one of its directions. */
typedef struct riis_direction {
  int64_t n_vertices;  /* as riis_triangles.n_vertices */
  const double *rate;  /* (3, n_vertices): the derivative of each vertex in riis_triangles.xyz by the parameter, in mesh units
                          divided by the parameter's unit. Within a triangle the rate is linear */
  double area_rate;    /* the derivative of riis_surface_info.area. Each call computes it again from all triangles */
} riis_direction;
/* Gives the rates of a surface's vertices along a direction. They are valid until the surface is updated or destroyed.
 *   `direction_id`: 0 for the direction that was added first after the last update, 1 for the next direction, and so on. From the
 *     rates a caller can compute the derivative of any number that depends on the triangles (docs/theory/gradients.md). The rates
 *     are those of the triangles, even if distances are measured by sampling or minimisation.
 * Errors: RIIS_INVALID_ARGUMENT for a direction that the surface lacks. */
RIIS_API riis_status riis_surface_get_direction(const riis_surface *surface, int64_t direction_id,
                                                riis_direction *direction, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
