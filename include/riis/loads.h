/* SPDX-License-Identifier: Apache-2.0 loads.h - loads: the forces with which the leaflets pull at nodes of the tissue that holds
 * them. The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_LOADS_H
#define RIIS_LOADS_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Loads: the forces of the leaflets at nodes of tissue (docs/theory/loads.md) ----------------------- */

/* The forces of the leaflets, and the edges at which tissue holds the leaflets. With MPI all ranks pass the same numbers. */
typedef struct riis_loads {
  int64_t struct_size;            /* set by the init function */
  double radius;                  /* mesh units, 1e-50 to 1e50. The force of a leaflet acts at the nodes whose distance from the
                                     leaflet's edges is below the radius. Default NaN, which is refused */
  double about[3];                /* the reference point of leaflet_moment; each coordinate at most 1e60 in magnitude. Default
                                     0 */
  int64_t n_leaflets;             /* the number of columns of the arrays sums, leaflet_force and leaflet_moment; 1 to 2^31.
                                     Default 0 */
  const double *leaflet_force;    /* (3, n_leaflets): riis_reaction.leaflet_force, added up over all ranks. riis_loads_add_sums
                                     does not read this array */
  const double *leaflet_moment;   /* (3, n_leaflets): riis_reaction.leaflet_moment, added up over all ranks. riis_loads_add_sums
                                     does not read this array */
  int64_t n_edges;                /* 1 to 2^40. Default 0 */
  const double *edges;            /* (3, 2, n_edges): both ends of each edge, for example riis_attachment.edges; coordinates at
                                     most 1e60 in magnitude. An edge may have length 0 */
  const int32_t *edge_leaflet_id; /* (n_edges), >= 0: the leaflet that each edge holds, for example riis_attachment.leaflet_id. If
                                     a leaflet has no edge in this array, for example a skirt, all edges hold this leaflet. NULL,
                                     the default: all edges hold all leaflets */
  int32_t n_threads;              /* default 0 */
  int32_t reserved;               /* 0 */
} riis_loads;
RIIS_API riis_status riis_loads_init(riis_loads *loads, int64_t struct_size); /* the defaults */
/* Computes sums over nodes of tissue for riis_loads_add_forces, and adds them to an array.
 *   `loads`: the call reads the radius, the edges and n_leaflets, but not the forces and moments.
 *   `nodes`: the nodes of a surface or a volume of tissue, in the same coordinates as the edges. Nodes farther from the edges
 *     than the radius do not count, and get no force.
 *   `weight` (n_points): the area or volume around each node, 0 to 1e60; 0 for nodes of other ranks. NULL: 1 for each node.
 *   `sums` (11, n_leaflets): the array to which the sums are added.
 * A bileaflet valve has no attachment. A surface from arrays has an attachment only if the arrays have `attached` or a skirt. For
 * a surface without an attachment, pass the edges at which the leaflets are sewn or hinged. With MPI each rank passes its own
 * nodes, and the caller then adds up the sums of all ranks.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field, edge, node or weight; the message names the bad entry and its value. */
RIIS_API riis_status riis_loads_add_sums(const riis_loads *loads, const riis_points *nodes, const double *weight, double *sums);
/* Adds to an array the forces of the leaflets at nodes of tissue. Up to rounding, the forces of a leaflet have the sum
 * leaflet_force and the moment leaflet_moment.
 *   `loads`, `nodes`, `weight`: as in riis_loads_add_sums.
 *   `sums` (11, n_leaflets): the sums of riis_loads_add_sums, added up over all ranks.
 *   `node_force` (3, n_points): the array to which the forces are added.
 * The force of a leaflet at a node is m w(d) (a + b x s), with two vectors a and b for each leaflet. Here m is the weight of the
 * node, and d is its distance from the leaflet's edges. The function w(d) is (1 + cos(pi d / radius)) / 2 up to the radius, and 0
 * beyond it. The vector s leads from the middle of the leaflet's nodes to the node. Among all forces with the given sum and
 * moment, these forces minimise the sum of |force|^2 / (m w) over the nodes. If the tissue moves rigidly, the power of the forces
 * is force times velocity plus moment times angular velocity. The forces depend linearly on leaflet_force and leaflet_moment. To
 * get the forces of one leaflet alone, pass zeros for the other leaflets. The forces do not model the mechanics of a membrane.
 * Errors: as riis_loads_add_sums. RIIS_INVALID_ARGUMENT also if a leaflet with a force has fewer than three nodes within the
 * radius, or only nodes that lie nearly on a line. Let r be the root-mean-square distance of these nodes from the line. The nodes
 * are too near the line if r is less than a hundredth of the root-mean-square distance of the nodes from their middle. The nodes
 * are also too near the line if r is less than a thousandth of the size of the edges (docs/theory/loads.md). */
RIIS_API riis_status riis_loads_add_forces(const riis_loads *loads, const riis_points *nodes, const double *weight,
                                           const double *sums, double *node_force);

#ifdef __cplusplus
}
#endif

#endif
