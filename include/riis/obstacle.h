/* SPDX-License-Identifier: Apache-2.0 obstacle.h - the obstacle in the caller's arrays: K and K u_surface, the forces of the flow
 * on the surface, and sums over the nodes on each side. The header riis.h includes this file, and has the rules that hold for
 * every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_OBSTACLE_H
#define RIIS_OBSTACLE_H

#include "marks.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Resistance: K and K u_surface in the caller's arrays, and sums of a flow around the surface ------- */

/* The caller's arrays to which K and K u_surface are added. Each array has an entry for each node of the mesh. */
typedef struct riis_resistance_arrays {
  int64_t struct_size;         /* set by the init function */
  int64_t n_nodes;             /* the number of nodes of the marking */
  double *K;                   /* (n_nodes) by K_stride; NULL if not wanted */
  int64_t K_stride;            /* default 1 */
  double *K_u_surface[3];      /* (n_nodes) by K_u_surface_stride, for x, y and z; all NULL if not wanted */
  int64_t K_u_surface_stride;  /* default 1; 3 for xyz(3,n) with {xyz, xyz + 1, xyz + 2} */
} riis_resistance_arrays;
/* Fills *arrays with the defaults. */
RIIS_API riis_status riis_resistance_arrays_init(riis_resistance_arrays *arrays, int64_t struct_size);
/* Adds K and K u_surface to the caller's arrays. For several valves, make one call for each valve: the arrays then contain the
 * sums over all valves. The solver's term is (sum of K) u - (sum of K u_surface). The nodes of the mesh may be cell centres or
 * quadrature points. For a single valve, riis_mark_list also gives K and K u_surface.
 *   `resistance`: for RIIS_RIM_CUT, the marks must have RIIS_FIELD_RIM. For K_u_surface, they must have RIIS_FIELD_VELOCITY.
 * Errors: RIIS_INVALID_ARGUMENT if the marks are empty, and if they lack a field that is needed. */
RIIS_API riis_status riis_marks_add_resistance(const riis_marks *marks, const riis_resistance *resistance,
                                               const riis_resistance_arrays *arrays);

/* The flow at the nodes, in the caller's arrays. */
typedef struct riis_flow_arrays {
  int64_t struct_size;       /* set by the init function */
  int64_t n_nodes;           /* the number of nodes of the marking */
  const double *velocity[3]; /* (n_nodes) by velocity_stride, for x, y and z; NULL only for 0 nodes */
  int64_t velocity_stride;   /* default 1; 3 for u(3,n) with {u, u + 1, u + 2} */
  const double *weight;      /* (n_nodes): the volume around each node, 0 for nodes of other ranks; NULL only for 0 nodes */
} riis_flow_arrays;
RIIS_API riis_status riis_flow_arrays_init(riis_flow_arrays *flow, int64_t struct_size); /* the defaults */
/* The caller's arrays, to which the forces and moments of the flow on the surface are added. Pass NULL for arrays that are not
 * wanted. The arrays must not overlap. The force from a node is weight K (velocity - u_surface), and acts at the node's closest
 * point on the surface. If the surface moves rigidly, the power of all forces is therefore force times velocity plus moment times
 * angular velocity, even with an offset. */
typedef struct riis_reaction {
  int64_t struct_size;      /* set by the init function */
  double about[3];          /* the reference point of moment and leaflet_moment; each coordinate at most 1e60 in magnitude.
                               Default 0 */
  double *force;            /* (3): force on the whole surface, in the unit of weight K velocity, which is N in SI units */
  double *moment;           /* (3): moment on the whole surface */
  int64_t n_leaflets;       /* the number of columns of leaflet_force and leaflet_moment. It must be more than
                               riis_surface_info.largest_leaflet_id. Default 0 */
  double *leaflet_force;    /* (3, n_leaflets): force on each leaflet. The force from a node acts on the leaflet
                               riis_mark_list.leaflet_id, even if another leaflet is equally near */
  double *leaflet_moment;   /* (3, n_leaflets): moment on each leaflet */
  int64_t n_edges;          /* the number of edges, at least 1. Only used with edge_force or edge_moment. Default 0 */
  const double *edges;      /* (3, 2, n_edges): both ends of each edge, for example riis_attachment.edges; coordinates at most
                               1e60 in magnitude. An edge may have length 0 */
  const int32_t *edge_leaflet_id; /* (n_edges), >= 0: the leaflet of each edge. Each leaflet must then have an edge. The force
                                     from a node acts at the nearest edge of its leaflet. NULL, the default: the force acts at the
                                     nearest of all edges */
  double *edge_force;       /* (3, n_edges): for each edge, the sum of the forces that act at the edge. The nearest edge is the
                               one nearest to the node's closest point on the surface. Of equally near edges, the first one
                               counts */
  double *edge_moment;      /* (3, n_edges): for each edge, the moment of these forces about the middle of the edge */
} riis_reaction;
/* Fills *reaction with the defaults. */
RIIS_API riis_status riis_reaction_init(riis_reaction *reaction, int64_t struct_size);
/* Adds the forces of the flow and their moments to the caller's arrays: for the whole surface, for each leaflet and for each
 * edge.
 *   `flow`: the velocities u and the volumes. Without RIIS_FIELD_VELOCITY in the marking, u_surface counts as 0.
 *   `reaction`: for moments and for forces at edges, the marks must have RIIS_FIELD_POINT.
 * Each result is a sum over nodes. With MPI all ranks pass the same reference point and edges, and the caller adds up the results
 * of all ranks. The forces on the leaflets add up to the force on the whole surface, up to rounding. The forces at edges can be
 * the loads in a code for tissue, but they do not model how a membrane carries loads to its edges. The computing time for a node
 * grows as log n_edges, or as n_edges if all edges are equally near. The force on a valve at rest is correct. The force on a
 * moving valve also contains the inertia of the blood in the band. If a solver applies K at faces of cells, a moving valve needs
 * a source in the pressure equation. Without this source the force is wrong by newtons (docs/solvers.md, "The source in the
 * band"). For each set of cells that is enclosed by walls and by faces with K dt > rho, the source must be the outflow of
 * u_surface through these faces. Here dt is the time step and rho the density. Finite elements have the same error if K dt > rho,
 * but no such source is known for them.
 * Errors: as riis_marks_add_resistance. RIIS_INVALID_ARGUMENT also if n_leaflets is too small (the message names the leaflet id),
 * if a leaflet lacks an edge, and if an edge has a coordinate that is not finite or too large. The call also refuses a reaction
 * whose arrays are all NULL. */
RIIS_API riis_status riis_marks_add_reaction(const riis_marks *marks, const riis_resistance *resistance,
                                             const riis_flow_arrays *flow, const riis_reaction *reaction);

/* Adds to an array the force of the flow on each vertex of the surface, so that a code for shells can move the leaflets.
 *   `surface`: the surface of the marking. The surface must not have been updated since the marking.
 *   `flow`: as in riis_marks_add_reaction.
 *   `n_vertices`: riis_triangles.n_vertices.
 *   `vertex_force` (3, n_vertices): the array to which the forces are added. The force from a node is divided among the three
 *     vertices of the node's closest triangle, in proportion to the barycentric coordinates of the closest point.
 * Up to rounding, the forces on the vertices of a leaflet have the sum leaflet_force and the moment leaflet_moment of
 * riis_marks_add_reaction. For every motion of the vertices, the forces on the vertices have the same power as the forces from
 * the nodes. Vertices with equal coordinates, for example along the sides of a valve's patches, get separate forces. If leaflets
 * from arrays share a vertex, this vertex gets the sum of their forces. With MPI, add up the forces of all ranks.
 * Errors: as riis_marks_add_reaction. RIIS_INVALID_ARGUMENT also if the marks lack RIIS_FIELD_BARYCENTRIC, if n_vertices is
 * wrong, and if the closest triangle of a node is not in the surface. */
RIIS_API riis_status riis_marks_add_vertex_reaction(const riis_marks *marks, const riis_surface *surface,
                                                    const riis_resistance *resistance, const riis_flow_arrays *flow,
                                                    int64_t n_vertices, double *vertex_force);

/* Sums over the nodes on each side of the surface. Entry 0 is for the upstream side (side -1), and entry 1 for the downstream
 * side. The mean of the value on a side is sum / weight. With MPI, first add up the sums and weights of all ranks. */
typedef struct riis_band_sums {
  double sum[2];      /* the sum of weight * value */
  double weight[2];   /* the sum of weight */
  int64_t n_nodes[2]; /* the number of nodes in the band */
} riis_band_sums;
/* A band around the surface, and a value at each node. */
typedef struct riis_band {
  int64_t struct_size;  /* set by the init function */
  double inner, outer;  /* the band holds the nodes with distances from inner to outer, where 0 <= inner <= outer. Let o be the
                           offset of the surface, and eps the half thickness: outer + |o| eps must be at most the marking's
                           distance limit. Default 0 */
  int64_t n_nodes;      /* the number of nodes of the marking, which must have RIIS_FIELD_SIDE and RIIS_FIELD_RIM */
  const double *value;  /* (n_nodes): the value at each node, such as the pressure; NULL only for 0 nodes */
  const double *weight; /* (n_nodes): the volume around each node, 0 for nodes of other ranks; NULL only for 0 nodes */
} riis_band;
RIIS_API riis_status riis_band_init(riis_band *band, int64_t struct_size); /* the defaults */
/* Gives the sums of a value over the nodes in the band, for each side of the surface. Nodes whose closest point is on the rim and
 * nodes with side 0 are left out. For an open valve, the two sides have no meaning. If the surface has an offset o, distances and
 * sides refer to the middle of the marked band instead of the surface. Let s be the signed distance of a node, and eps the half
 * thickness of the marking. Then |s - o eps| is the distance of the node, and the sign of s - o eps is its side.
 * Errors: RIIS_INVALID_ARGUMENT also if the marks lack a field. */
RIIS_API riis_status riis_marks_get_band_sums(const riis_marks *marks, const riis_band *band,
                                              riis_band_sums *sums, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
