/* SPDX-License-Identifier: Apache-2.0
 *
 * riis.h - the whole public interface of riis: heart valves as resistive immersed implicit surfaces.
 *
 * A riis_valve has named parameters. riis_surface_create turns the valve into a riis_surface, which consists of triangles.
 * riis_mark_nodes then finds the mesh nodes near the surface, and stores them in riis_marks.
 *
 * A flow solver passes the nodes of its mesh, and gets the nodes near the valve's leaflets with their distances. At these nodes
 * the solver adds the term K (u - u_surface) to its momentum equation. This term holds the blood back. The mesh does not have to
 * follow the moving leaflets.
 *
 * The shortest complete program:
 *
 *   riis_valve *valve = NULL; riis_surface *surface = NULL; riis_mesh *mesh = NULL; riis_marks *marks = NULL;
 *   riis_mark_list marked;
 *   riis_valve_create("coapting", &valve);
 *   riis_surface_create(valve, NULL, &surface);               (for a mesh in cm; options.scale is 0.01 for metres)
 *   riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh);
 *   riis_marks_create(&marks);
 *   riis_mark_nodes(surface, mesh, NULL, marks);                                   (once a time step)
 *   riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked);          (marked.node_id, .distance)
 *
 * These rules hold for every function:
 *
 * - Units: lengths have one unit of the caller's choice, and angles are in degrees. The valves' default lengths are in
 *   centimetres. The scale of a placement converts centimetres to the mesh's unit (0.01 for metres).
 * - Ids: arguments and fields named *_id count from 0, and so do the ids in messages. If a struct has a field index_base, the ids
 *   in this struct count from index_base, which is 0 (default) or 1. A field id_bits gives the number of bits of each id: 32
 *   (default) or 64.
 * - Points: point i is x[i * stride], y[i * stride], z[i * stride]. Coordinates are finite, of magnitude at most 1e60. The stride
 *   counts numbers, not bytes, and is at least 1. Three separate arrays x, y and z have the stride 1. One array xyz(3,n) has the
 *   stride 3, with y = x + 1 and z = x + 2. Calls refuse arrays x, y and z that overlap. A field real_bits gives the width of the
 *   numbers: 64 (default) or 32 bits. Without a field real_bits the numbers are doubles. These rules also hold for vectors.
 * - Order: the first argument is the object after which the function is named. The other arguments follow in this order: inputs,
 *   options, outputs. Functions with `get` in their names return the content of an object.
 * - Status: a function that can fail returns a riis_status; 0 is success, and riis_last_error() gives the message of a failure.
 *   If the status is positive, the call has changed nothing, and pointers from earlier calls stay valid. If the status is
 *   negative, the objects that the call writes may be damaged, so destroy them. No function aborts, prints or throws.
 * - Any function may return RIIS_INVALID_ARGUMENT for a forbidden NULL, and for an argument or field out of range. It may also
 *   return RIIS_INVALID_STRUCT_SIZE for a struct of a wrong size, and RIIS_OUT_OF_MEMORY.
 * - Handles: a new object is the last argument, and is written only on success. A destroy function takes a handle's address,
 *   accepts NULL, and sets the handle to NULL. If a handle belongs to an object of another kind, a destroy function ignores the
 *   handle, and all other functions return an error.
 * - Memory: a call reads its arguments and their arrays only while it runs. If a call borrows arrays for longer, its comment says
 *   so. Arrays that a call returns belong to the handle, and are valid until the handle's next update or destruction. An array
 *   without entries is returned as NULL, and may be passed as NULL.
 * - If a call fills in a struct, the next argument is the struct's size, as in (&list, sizeof list). The call writes at most this
 *   many bytes.
 * - Structs that a call reads begin with struct_size. The init function of a struct sets struct_size and the defaults, and sets
 *   all other fields to 0 or NULL. If the pointer to options is NULL, all options have their defaults. Later releases add fields
 *   at the end of a struct, or in place of its field `reserved`. Until then `reserved` must be 0.
 * - Threads: several threads may pass the same handle at once if all these calls take the handle as const. If a call takes a
 *   handle without const, no other thread may use this handle while the call runs. The library refuses most calls that break this
 *   rule. Different handles never interfere. Results are bitwise the same for any number of threads.
 * - n_threads: 1 to 1024, or 0, the default. By default a call uses one thread, plus one thread for each 4096 triangles of the
 *   surface, for each 16,384 nodes, cells or faces, or for each 2048 points. For an update, the triangles are those before the
 *   update. The default never exceeds the number of processors in the calling thread's affinity mask. By default, a part of a
 *   call that has little work uses only one thread. With n_threads 1, the library starts no thread. OMP_NUM_THREADS and
 *   omp_set_num_threads have no effect. If the system refuses a thread or the memory for a thread, OpenMP and TBB end the process
 *   (docs/building.md). The library's own threads block all signals except signals of errors, such as SIGSEGV.
 * - fork(): if the library used several threads before the fork, each call in the child process may use only one thread. By
 *   default such a call then uses one thread. If the child requests more threads, the call returns RIIS_UNAVAILABLE. A child
 *   cannot make surfaces if another thread was inside the library during the fork.
 * - Environment: calls and log functions run with the default floating-point environment. At its end, each call restores the
 *   caller's floating-point environment. The caller's settings of OpenMP and TBB do not change.
 *
 * "Paper" is B. van der Vuurst, J. Kosinka, C. Bertoglio, "Fast generation of 3D flow obstacles from parametric surface models:
 * application to cardiac valves" (2025); docs/theory/departures.md lists every departure from the paper.
 *
 * Contents, by file. docs/fortran_calls.md has the same calls in Fortran, in this order.
 *
 * base.h: status, messages, log, points
 *   riis_status_name                     the name of a status
 *   riis_last_error                      the message of the last failed call
 *   riis_version_string                  the version of the linked library
 *   riis_set_log                         the function that receives messages
 *   riis_points_init
 * valve.h: parameters and patches
 *   riis_valve_create                    a valve of a kind, with default parameters
 *   riis_valve_copy, riis_valve_destroy
 *   riis_valve_set                       sets a parameter by its name
 *   riis_valve_set_scalar                the same for a parameter with one value
 *   riis_valve_get                       the values of a parameter
 *   riis_valve_unset                     returns a parameter to its rule or default
 *   riis_valve_is_set                    whether a parameter was set
 *   riis_valve_set_open_state            a second valve, to which the first one opens
 *   riis_patches_init
 *   riis_valve_create_from_patches       a valve from the caller's patches
 *   riis_valve_get_n_parameters          the number of parameters
 *   riis_valve_get_parameter             name, unit, range and rule of a parameter
 *   riis_valve_get_patches               the valve's curves and patches
 * surface.h: triangles, their sizes, attachment and velocities
 *   riis_surface_options_init
 *   riis_surface_create                  the surface of a valve
 *   riis_surface_arrays_init
 *   riis_surface_create_from_arrays      the caller's own surface
 *   riis_surface_update                  updates a surface after its valve has moved
 *   riis_surface_update_from_arrays      updates the caller's surface
 *   riis_surface_destroy
 *   riis_surface_get_info                size, area, bounds, seconds
 *   riis_surface_get_triangles           the triangles
 *   riis_surface_get_attachment          the edges that hold the leaflets
 *   riis_surface_update_moving           updates a surface and gives its vertices velocities
 *   riis_keyframe_arrays_init
 *   riis_keyframes_create, riis_keyframes_destroy
 *   riis_surface_create_from_keyframes   a surface from frames in time
 *   riis_surface_update_from_keyframes   the same at another time
 * queries.h: closest points, and places where a surface goes through itself
 *   riis_closest_point                   the closest point of the surface to one point
 *   riis_closest_options_init, riis_closest_arrays_init
 *   riis_closest_points                  the same for many points
 *   riis_crossing_options_init
 *   riis_crossings_create, riis_crossings_destroy
 *   riis_find_crossings                  pairs of triangles that go through each other
 *   riis_crossings_get_list              these pairs
 * mesh.h: nodes and their neighbours
 *   riis_mesh_create                     borrows the nodes' coordinates
 *   riis_mesh_update                     tells the mesh that coordinates have changed
 *   riis_mesh_create_copy                copies the coordinates, also of single precision
 *   riis_mesh_update_copy                copies changed coordinates
 *   riis_mesh_destroy
 *   riis_mesh_prepare                    makes clusters of nodes in advance
 *   riis_grid_init
 *   riis_mesh_create_grid                a rectilinear grid, by its axes
 *   riis_mesh_update_grid                gives a mesh other axes
 *   riis_csr_init
 *   riis_mesh_set_adjacency              the neighbours of the nodes
 *   riis_mesh_cells_init
 *   riis_adjacency_create_from_cells     neighbours from cells
 *   riis_mesh_faces_init
 *   riis_adjacency_create_from_faces     neighbours of cells from faces
 *   riis_adjacency_create_from_grid      neighbours in a structured grid
 *   riis_adjacency_get_csr               the rows of neighbours
 *   riis_adjacency_destroy
 * marks.h: the nodes near a surface
 *   riis_marks_create, riis_marks_destroy
 *   riis_resistance_init, riis_mark_options_init
 *   riis_mark_nodes                      finds the nodes near a surface
 *   riis_marks_get_list                  these nodes, with distances, K and fields
 *   riis_dense_arrays_init
 *   riis_marks_get_dense                 marks and distances of all nodes of the mesh
 *   riis_marks_get_stats                 counts and seconds of the marking
 * obstacle.h: K in the caller's arrays, forces of the flow
 *   riis_resistance_arrays_init
 *   riis_marks_add_resistance            adds K and K u_surface to the caller's arrays
 *   riis_flow_arrays_init, riis_reaction_init
 *   riis_marks_add_reaction              adds the force of the flow on the surface
 *   riis_marks_add_vertex_reaction       adds the force of the flow on each vertex of the surface
 *   riis_band_init
 *   riis_marks_get_band_sums             sums of a value on both sides of the surface
 * loads.h: the forces of the leaflets at nodes of tissue
 *   riis_loads_init
 *   riis_loads_add_sums                  sums over the nodes of tissue
 *   riis_loads_add_forces                adds the forces of the leaflets at these nodes
 * seal.h: whether the marks close the surface
 *   riis_leaks_create, riis_leaks_destroy
 *   riis_find_leaks                      mesh edges that leak through the surface
 *   riis_leaks_get_list                  these edges
 *   riis_label_open_regions              the regions that the marks separate
 *   riis_passage_ends_init
 *   riis_find_passage                    the widest passage between two sets of nodes
 * measures.h: sizes that matter for a flow
 *   riis_surface_get_n_leaflets          the number of leaflets
 *   riis_surface_get_leaflet             area and free edge of a leaflet
 *   riis_surface_get_orifice             the open area
 *   riis_surface_get_orifice_in_wall     the open area inside a ring or a tube
 *   riis_area_search_init
 *   riis_find_by_area                    the openings or sizes at which the orifice has given areas
 *   riis_surface_get_coaptation          the area in which leaflets touch
 *   riis_surface_get_leak                the ideal leak of a closed surface
 *   riis_first_passage_options_init
 *   riis_find_first_passage              the first opening at which the mesh has a passage
 *   riis_marks_get_cells_across          how many mesh edges fit across the band
 *   riis_valve_get_swept_volume          the volume that an opening valve sweeps
 * patient.h: landmarks, warps, skirts
 *   riis_landmarks_init, riis_placement_arrays_init
 *   riis_place                           sizes and placement from a patient's landmarks
 *   riis_warp_options_init
 *   riis_warp_create, riis_warp_destroy  a map from landmarks to landmarks
 *   riis_warp_set_targets                the places to which the warp takes the landmarks
 *   riis_warp_set_targets_at             the same for a given time, from a table
 *   riis_warp_get_info                   the quality of the map
 *   riis_warp_map                        maps points
 *   riis_valve_set_warp                  warps a valve
 *   riis_surface_get_gap                 the gap between a valve and a wall
 *   riis_valve_set_skirt_to_wall         a skirt that closes this gap
 * gradients.h: derivatives with respect to parameters
 *   riis_surface_add_direction           a direction in which the surface changes
 *   riis_surface_get_direction           the rates of the vertices
 * laws.h: a valve's opening from the time, the pressure difference and the flow
 *   riis_opening_table_init
 *   riis_opening_from_table              the opening from a table of times
 *   riis_opening_times_init
 *   riis_opening_from_times              the opening from two ramps
 *   riis_opening_switch_init, riis_opening_switch_state_init
 *   riis_opening_switch_advance          the opening from pressure difference and flow
 *   riis_opening_angle_init, riis_opening_angle_state_init
 *   riis_opening_angle_advance           the opening by the angle law of Korakianitis and Shi
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_RIIS_H
#define RIIS_RIIS_H

#define RIIS_VERSION_MAJOR 1 /* version of this header; grows with a change that breaks compiled callers */
#define RIIS_VERSION_MINOR 0 /* grows with an addition */
#define RIIS_VERSION_PATCH 0 /* grows with a correction */

#include "base.h"
#include "valve.h"
#include "surface.h"
#include "queries.h"
#include "mesh.h"
#include "marks.h"
#include "obstacle.h"
#include "loads.h"
#include "seal.h"
#include "measures.h"
#include "patient.h"
#include "gradients.h"
#include "laws.h"

#endif
