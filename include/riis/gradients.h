/* SPDX-License-Identifier: Apache-2.0 gradients.h - gradients: derivatives of distances, of K and of areas with respect to
 * parameters, landmarks and the placement. The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_GRADIENTS_H
#define RIIS_GRADIENTS_H

#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Gradients: directions in which the surface of a valve changes ------------------------------------- */

/* Adds a direction in which the surface of a valve can change. A direction belongs to one number: a parameter, a coordinate of a
 * landmark or a number of the placement. Below, this number is called the parameter.
 *   `valve_after`, `valve_before`: two copies of the surface's valve. In valve_after the parameter is a little larger than in the
 *     surface's valve, and in valve_before a little smaller. If only the placement changes, pass the same valve twice.
 *   `dp`: the value of the parameter in valve_after minus its value in valve_before, 1e-30 to 1e30 in magnitude.
 *   `options_after`, `options_before`: scale, rotation and translation of valve_after and valve_before; other fields are ignored.
 *     NULL: the surface's options.
 * The first call makes direction 0, the second call makes direction 1, and so on. An update of the surface removes all
 * directions. A marking with RIIS_FIELD_GRADIENT gives the derivatives of distances and of K in all directions
 * (docs/theory/gradients.md). Each valve with its placement is a state. Both states are cut into the same triangles as the
 * surface. The rate of a vertex is its displacement from valve_before to valve_after, divided by dp. If the surface is midway
 * between the two states, the error of the derivative is of second order in dp, otherwise of first order. A dp of 1e-5 times the
 * parameter's value suits most parameters. For the two states, the call does not check the limits of RIIS_TRIANGULATION_FIXED.
 * Errors: RIIS_INVALID_ARGUMENT for a surface from arrays, and for a dp out of range. RIIS_INVALID_PARAMETER if the kind or the
 * patches of a state differ from those of the surface, and if the parameters of a state do not fit together. RIIS_LIMIT_EXCEEDED
 * for more than 1000 directions. */
RIIS_API riis_status riis_surface_add_direction(riis_surface *surface, const riis_valve *valve_after,
                                                const riis_valve *valve_before, double dp,
                                                const riis_surface_options *options_after,
                                                const riis_surface_options *options_before);
/* The rates of a surface in one of its directions. */
typedef struct riis_direction {
  int64_t n_vertices;  /* as riis_triangles.n_vertices */
  const double *rate;  /* (3, n_vertices): the derivative of the position of each vertex in riis_triangles.xyz with respect to the
                          parameter, in mesh units divided by the parameter's unit. Within a triangle the rate is linear */
  double area_rate;    /* the derivative of riis_surface_info.area. Each call of riis_surface_get_direction computes it again from
                          all triangles */
} riis_direction;
/* Gives the rates of the surface's vertices in a direction. The rates are valid until the surface is updated or destroyed.
 *   `direction_id`: 0 for the first direction that was added after the last update, 1 for the second, and so on. From the rates,
 *     a caller can compute the derivative of any number that depends on the triangles (docs/theory/gradients.md). The rates are
 *     those of the triangles even if distances are measured by sampling or minimisation.
 * Errors: RIIS_INVALID_ARGUMENT if the surface lacks the direction. */
RIIS_API riis_status riis_surface_get_direction(const riis_surface *surface, int64_t direction_id,
                                                riis_direction *direction, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
