/* SPDX-License-Identifier: Apache-2.0
 *
 * riis.h - the whole public interface of riis: heart valves as resistive immersed implicit surfaces.
 *
 *   riis_valve  --riis_surface_create-->  riis_surface  --riis_mark_nodes-->  riis_mark_result
 *   (named parameters)                    (triangles, Embree scene)           (nodes within the half thickness)
 *
 * The shortest true program:
 *
 *   riis_valve *valve = NULL; riis_surface *surface = NULL; riis_mesh *mesh = NULL; riis_mark_result *result = NULL;
 *   int64_t n_marked; const int64_t *node_id; const double *distance;
 *   riis_valve_create("aortic", &valve);
 *   riis_surface_create(valve, NULL, &surface);
 *   riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh);
 *   riis_mark_result_create(&result);
 *   riis_mark_nodes(surface, mesh, NULL, result);                                  (once a time step)
 *   riis_mark_result_marked(result, &n_marked, &node_id, &distance, NULL, NULL);
 *
 * Conventions, true for every function unless it says otherwise:
 *
 * - Lengths are in one unit of the caller's choice. The valve tables are in centimetres; a placement's scale turns them
 *   into the mesh's unit (0.01 for metres). Angles are degrees. Anything called *_id counts from 0,
 *   in texts, too; ids that go in count from the base that is given with them.
 * - A function that can fail returns a riis_status: 0 is success; > 0 means that the call was refused and no object
 *   changed; < 0 means that an object passed for writing is only fit to be destroyed. riis_last_error() has the text.
 *   No function aborts, prints, throws, or lets an exception out. Any function that takes them answers a NULL that is not
 *   allowed, or an option out of range, with RIIS_INVALID_ARGUMENT, a struct of a wrong size with RIIS_INVALID_STRUCT_SIZE,
 *   and any that allocates may answer RIIS_OUT_OF_MEMORY; these are not repeated below.
 * - New objects are the last argument, written only on success. Destroying takes the address of the handle, sets it to
 *   NULL, and accepts NULL. A handle of another kind in a handle's place is refused, also by destroying, which then leaves
 *   it alone.
 * - Option structs begin with struct_size and are filled by their init function, which takes the size that the caller
 *   compiled with; a NULL options pointer means all defaults. Fields are only ever appended.
 * - A handle may be read (const) by any number of threads at once; it is written by one thread with no reader beside
 *   it. Different handles never interfere. Results are bitwise the same for any number of threads.
 * - Where a number of threads can be given, 0 stands for the processors that the calling thread may run on (its affinity
 *   mask); OMP_NUM_THREADS and omp_set_num_threads do not matter. More threads, or more memory for them, than the system
 *   grants end the process: that is how OpenMP's run-time answers, and TBB's threads, out of the library's reach
 *   (docs/building.md). With 1 no thread is started, which is also all that a child of fork() may ask for. Making
 *   Embree's scene of a surface is TBB's, on the threads that it grants.
 * - Each call runs with the default floating-point environment, a log function included, and puts the caller's back:
 *   traps, rounding mode and flush-to-zero of the caller neither change the result nor fire inside. The caller's OpenMP
 *   and TBB settings stay.
 *
 * "Paper" is B. van der Vuurst, J. Kosinka, C. Bertoglio, "Fast generation of 3D flow obstacles from parametric surface
 * models: application to cardiac valves" (2025); docs/theory.md lists every departure from it.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_RIIS_H
#define RIIS_RIIS_H

#include <stdint.h>

#define RIIS_VERSION_MAJOR 0 /* of this header; grows when compiled callers would break, or the library's name changes */
#define RIIS_VERSION_MINOR 1 /* grows when something is added */
#define RIIS_VERSION_PATCH 0 /* grows when something is mended */

#if defined(__GNUC__)
#define RIIS_API __attribute__((visibility("default"))) /* stands before what the library exports */
#else
#define RIIS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------------------------ *
 * Status, errors, log, version
 * ------------------------------------------------------------------------------------------------------------------ */

/* What a call returns. The values are part of the ABI and never change; new ones are appended at either end. */
typedef int32_t riis_status;
/* Values of riis_status. */
enum {
  RIIS_OK = 0,                  /* success */
  RIIS_INVALID_ARGUMENT = 1,    /* a NULL pointer, a number out of range, a non-finite option */
  RIIS_INVALID_STRUCT_SIZE = 2, /* struct_size does not fit any release of this struct: not filled by its init function,
                                   or the caller was compiled against a newer riis.h than the library */
  RIIS_INVALID_PARAMETER = 3,   /* a valve or one of its parameters: unknown name, value out of range, values that do
                                   not go together */
  RIIS_INVALID_SURFACE = 4,     /* the caller's surface arrays: empty, non-finite, index out of range, zero area */
  RIIS_INVALID_MESH = 5,        /* the caller's mesh: empty, non-finite coordinate */
  RIIS_LIMIT_EXCEEDED = 6,      /* the request is sound but larger than the library takes on */
  RIIS_OUT_OF_MEMORY = 7,       /* memory ran out; nothing changed */
  RIIS_FILE_ERROR = 8,          /* a file cannot be read or written, or does not hold what it should (riis_vtk.h) */
  RIIS_UNAVAILABLE = 9,         /* something outside the library is missing, such as a display (riis_vtk.h) */
  RIIS_INTERNAL_ERROR = -1      /* an error in riis or in a library below it; destroy the objects passed for writing */
};

/* The status's own name, such as "RIIS_INVALID_ARGUMENT"; "unknown status" for a value that is none. Static text. */
RIIS_API const char *riis_status_name(riis_status status);

/* The text of the last failed call of the calling thread: what was wrong, naming the argument and its value. "" if none
 * has failed. Never NULL. Owned by the library, valid until the next failing call of the same thread; a successful call
 * leaves it alone. */
RIIS_API const char *riis_last_error(void);

/* Version of the library that was linked, not of this header. Any pointer may be NULL. */
RIIS_API void riis_version(int32_t *major, int32_t *minor, int32_t *patch);
/* The same as static text, such as "0.1.0". */
RIIS_API const char *riis_version_string(void);

/* Receives what the library would like to say: one line without a newline, valid during the call only. May be called
 * from any thread that calls the library; must not call the library and must not throw or jump out.
 *   user_data  what riis_set_log was given
 *   level      RIIS_LOG_INFO or RIIS_LOG_WARNING
 *   message    borrowed: copy what is to be kept */
typedef void (*riis_log_function)(void *user_data, int32_t level, const char *message);
/* The levels of a message. */
enum {
  RIIS_LOG_INFO = 0,   /* what was built and how large */
  RIIS_LOG_WARNING = 1 /* something was done that the caller may not expect, such as skipped triangles */
};
/* Sets the log function of the process; NULL, the default, is silence. Safe from any thread; a message under way in
 * another thread may still reach the function that was set before.
 *   user_data  handed to the function as it is, never looked at; must stay valid as long as the function is set */
RIIS_API void riis_set_log(riis_log_function function, void *user_data);

/* Takes the default where a field says so. */
#define RIIS_AUTO (-1.0)

/* ------------------------------------------------------------------------------------------------------------------ *
 * Valve: named parameters (paper, tables "Aortic valve parameters" and "Mitral valve parameters"), or patches
 * ------------------------------------------------------------------------------------------------------------------ */

/* A parametric valve: its kind and its parameters' values. No geometry is made before riis_surface_create. */
typedef struct riis_valve riis_valve;

/* Makes a valve of a kind by name with the paper's parameter values. Kinds: "aortic", three cusps, and "mitral", two leaflets.
 * Errors: RIIS_INVALID_PARAMETER for an unknown kind. */
RIIS_API riis_status riis_valve_create(const char *kind, riis_valve **valve);
/* Destroys the valve. Surfaces that were made from it, and valves that open to it, stay as they are. */
RIIS_API void riis_valve_destroy(riis_valve **valve);

/* Sets a parameter by the paper's name. Parameters of one cusp carry its name: "right.leaflet_angle", "left.rotation",
 * "non_coronary.bending_power"; those of the whole valve none: "root_radius", "AP_diameter". Scalars have 1 value, vectors 3
 * (rotation, translation: x, y, z; t0_* and t3_*: right, left, non-coronary cusp). A name without a cusp where the parameter
 * belongs to a cusp ("leaflet_angle", the aortic "translation") sets it for all three cusps.
 * Every kind has "opening", from 0 to 1, the coefficient of motion: control points are blended from a closed to an open state.
 * The mitral valve's parameters make both, and 1, open, is the default; other valves stay at 0 until riis_valve_set_open_state
 * gives them a second state. To move a valve: set "opening", then riis_surface_update.
 *   n_values  length of values; must be the parameter's own length
 *   values    copied
 * Each value is checked against the parameter's range here; whether parameters go together (a bending height below the
 * leaflet height) is checked by riis_surface_create, so that the order of setting them does not matter.
 * Errors: RIIS_INVALID_PARAMETER naming the parameter and the value, RIIS_INVALID_ARGUMENT for NULL; the valve is then
 * unchanged. */
RIIS_API riis_status riis_valve_set(riis_valve *valve, const char *name, int64_t n_values, const double *values);
/* The same for a parameter with one value. */
RIIS_API riis_status riis_valve_set_scalar(riis_valve *valve, const char *name, double value);
/* Copies a parameter's values out. n_values must be the parameter's own length. A name that stands for all three cusps
 * cannot be read (RIIS_INVALID_PARAMETER): the cusps may differ. */
RIIS_API riis_status riis_valve_get(const riis_valve *valve, const char *name, int64_t n_values, double *values);

/* Gives the valve a second state to open to: its own becomes the closed one, at opening 0, and the other valve's the open one, at
 * opening 1. In between the control points of every curve are blended linearly, and with them what is no control point:
 * aortic rotations and translations; anterior_ratio, triangle_size_ratio, translation and the tangent of surface_angle of the
 * mitral valve, whose closed curves come from the first and open curves from the second state.
 *   open  of the same kind; for valves from patches of the same curves, degrees (1 and 2 mix) and sides. Copied: it may go;
 *         its own opening, leaflet ids and second state do not matter. It stays for good: for another, set it again
 * A mitral valve is at opening 1 by default, and then is the second state, whatever is set of the first.
 * Errors: RIIS_INVALID_PARAMETER for a valve of another kind or build; the valve is then unchanged. */
RIIS_API riis_status riis_valve_set_open_state(riis_valve *valve, const riis_valve *open);

/* The caller's own valve, such as a prosthesis: Coons patches by their four boundary curves (paper, 3.3), curves by their control
 * points, by arrays that are read during the call only. Filled by its init function; then set what there is.
 * A patch's sides are named by the parameter that is constant on them: v = 0, v = 1, u = 0, u = 1. The first two run with u, the
 * others with v, so that v = 0 begins where u = 0 begins and ends where u = 1 begins, and v = 1 begins where u = 0 ends and ends
 * where u = 1 ends, to 1e-9 of the valve's size. Normals are along S_u x S_v. Curves that patches share are given once and
 * named twice: they become one polyline, and the patches meet without cracks. A side may be collapsed to a point. */
typedef struct riis_patches {
  int64_t struct_size;       /* sizeof(riis_patches) of the caller, as its init function had it */
  int64_t n_curves;          /* 1 to 4,000,000; each the side of some patch */
  const int32_t *degree;     /* (n_curves): 1, 2 or 3, Bezier curves with degree + 1 control points */
  const double *control;     /* (3, sum of all degree + 1): the control points, curve after curve; finite, magnitude at most
                                1e30 */
  int64_t n_patches;         /* 1 to 1,000,000 */
  const int32_t *curve_id;   /* (4, n_patches): the curves at v = 0, v = 1, u = 0, u = 1 */
  const int32_t *reversed;   /* (4, n_patches): 1 where the side runs from the curve's last point to its first, else 0;
                                NULL: all 0 */
  const int32_t *leaflet_id; /* (n_patches), >= 0; NULL: all 0 */
  int32_t index_base;        /* 0 or 1: the number of the first curve in curve_id. Default 0 */
  int32_t reserved;          /* 0 */
} riis_patches;
/* Fills *patches with the defaults, all else with 0 and NULL; struct_size is sizeof(riis_patches) of the caller. */
RIIS_API riis_status riis_patches_init(riis_patches *patches, int64_t struct_size);

/* Makes a valve from patches. Its only parameter is "opening"; patch_id is the patch's number.
 * Errors: RIIS_INVALID_ARGUMENT for a field out of range; RIIS_INVALID_PARAMETER for a curve or a patch that is none, naming
 * it and its value: sides that do not meet, for example. */
RIIS_API riis_status riis_valve_create_from_patches(const riis_patches *patches, riis_valve **valve);

/* One parameter described. The texts are static. */
typedef struct riis_parameter {
  const char *name;        /* as riis_valve_set takes it */
  const char *unit;        /* "length", "degree" or "1" */
  const char *description; /* one line */
  int64_t n_values;        /* 1 or 3 */
  double default_values[3];/* the paper's; entries beyond n_values are 0 */
  double minimum;          /* of every value, inclusive */
  double maximum;          /* of every value, inclusive */
} riis_parameter;
/* How many parameters the valve has. */
RIIS_API riis_status riis_valve_n_parameters(const riis_valve *valve, int64_t *n_parameters);
/* Describes parameter number parameter_id, 0 <= parameter_id < n_parameters.
 *   struct_size  sizeof(riis_parameter) of the caller; no more than that is written
 * Errors: RIIS_INVALID_ARGUMENT for a parameter_id that there is not. */
RIIS_API riis_status riis_valve_parameter(const riis_valve *valve, int64_t parameter_id, riis_parameter *parameter,
                                          int64_t struct_size);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Surface: triangles in space, ready to be asked for closest points
 * ------------------------------------------------------------------------------------------------------------------ */

/* Triangles with their Embree scene, a half thickness, and nothing borrowed from the caller. */
typedef struct riis_surface riis_surface;

/* The leaflets of the aortic and of the mitral valve, as leaflet_id reports them. */
enum {
  RIIS_LEAFLET_RIGHT = 0,       /* aortic: the right coronary cusp, "right" in names of parameters */
  RIIS_LEAFLET_LEFT = 1,        /* aortic: the left coronary cusp, "left" */
  RIIS_LEAFLET_NON_CORONARY = 2,/* aortic: "non_coronary" */
  RIIS_LEAFLET_ANTERIOR = 0,    /* mitral: the anterior leaflet */
  RIIS_LEAFLET_POSTERIOR = 1    /* mitral: the posterior leaflet, all three scallops */
};

/* What to do with triangles of zero area in the caller's arrays. */
enum {
  RIIS_ZERO_AREA_REFUSE = 0, /* RIIS_INVALID_SURFACE naming the first */
  RIIS_ZERO_AREA_SKIP = 1    /* leave them out, count them, log a warning; the ids of the others do not change */
};

/* How the distance of a point to the surface is measured (paper, 4.1). Triangles are what the library is for; the other two
 * are the paper's, for comparison, and only for surfaces of valves. They work on patches S(u,v), bilinear between grid
 * lines, within a tenth of distance_tolerance * half_thickness of the smooth surface (docs/theory.md, section 9). */
enum {
  RIIS_DISTANCE_TRIANGLES = 0,   /* the closest point of all triangles, exactly */
  RIIS_DISTANCE_SAMPLING = 1,    /* the nearest of points S(u,v), evenly spaced in u and v on every patch, as many as its
                                    width and height need for distances to be within distance_tolerance *
                                    half_thickness of those to the smooth surface, never below by more than a tenth of
                                    that. At most 16,777,216 points */
  RIIS_DISTANCE_MINIMIZATION = 2 /* Powell's method (1964) on every patch from u = v = 0.5, until an iteration lowers the
                                    distance by no more than distance_tolerance * half_thickness; the paper has 0.001
                                    and 0.01. It may end in a local minimum: the distance is never below that to the
                                    smooth surface by more than a tenth of that product, but may be above by any
                                    amount, and nothing says where it is */
};

/* How a surface is made and where it stands: x -> scale * rotation * x + translation, the placement, is applied last, to
 * valves and to arrays alike. */
typedef struct riis_surface_options {
  int64_t struct_size;     /* sizeof(riis_surface_options) of the caller, as its init function had it */
  double half_thickness;   /* d_min, in mesh units, 1e-50 to 1e50: a node is marked when its distance to the surface is at
                              most this (paper, 4.2). Default RIIS_AUTO: 0.1 * scale */
  double tolerance;        /* generated valves: tolerance * half_thickness bounds the difference between distances to the
                              triangles and to the smooth surface (docs/theory.md, "Tolerance"). 1e-6 to 1, default 0.05.
                              Not used for surfaces from arrays */
  double scale;            /* 1e-12 to 1e12, default 1 */
  double rotation_axis[3]; /* of any length from 1e-50 on, components up to 1e50; default (0, 0, 1) */
  double rotation_angle;   /* degrees, counter-clockwise seen against the axis; -1e6 to 1e6, default 0 */
  double translation[3];   /* mesh units; -1e50 to 1e50, for valves no farther than where coordinates round by a thousandth
                              of tolerance * half_thickness; default 0 */
  int32_t zero_area;       /* surfaces from arrays: RIIS_ZERO_AREA_*; default RIIS_ZERO_AREA_REFUSE */
  int32_t flip_normals;    /* 1 turns every triangle over, so that normal and side change sign; default 0 */
  int32_t distance;        /* RIIS_DISTANCE_*, which closest points and marking then go by; default RIIS_DISTANCE_TRIANGLES, the
                              only one for surfaces from arrays. The triangles are made with any: vertices, bounds, area
                              and pictures are theirs */
  int32_t n_threads;       /* that make the surface: 1 to 1024, or 0, the default: one for every 4096 triangles that it had before,
                              at most the processors the calling thread may use. Embree's scene is made on what TBB grants */
  double distance_tolerance; /* of the other two: a share of half_thickness, 1e-6 to 1. Default RIIS_AUTO: tolerance */
} riis_surface_options;
/* Fills *options with the defaults; struct_size is sizeof(riis_surface_options) of the caller. */
RIIS_API riis_status riis_surface_options_init(riis_surface_options *options, int64_t struct_size);

/* Makes the surface of a parametric valve: curves, polylines, Coons patches, quads, triangles, Embree scene (paper, 3 and
 * 4.1 "Triangulation"; docs/theory.md). Normals point downstream: from the ventricular to the sinus face of the aortic
 * valve, from the atrial to the ventricular face of the mitral valve. Triangles of zero area, which arise where a side is
 * collapsed (the root point of each cusp, the commissures of the mitral valve), are dropped.
 *   valve    read during the call only
 *   options  NULL for defaults
 * Errors: RIIS_INVALID_ARGUMENT for an option out of range; RIIS_INVALID_PARAMETER for parameters that do not go together
 * or throw a curve far away; RIIS_LIMIT_EXCEEDED where the tolerance asks for more than 16,777,216 triangles, or
 * distance_tolerance for as many quads or samples. */
RIIS_API riis_status riis_surface_create(const riis_valve *valve, const riis_surface_options *options,
                                         riis_surface **surface);

/* The caller's own surface, triangles or quads, by arrays that are read during the call only. Filled by its init function;
 * then set what there is. */
typedef struct riis_surface_arrays {
  int64_t struct_size;       /* sizeof(riis_surface_arrays) of the caller, as its init function had it */
  int64_t n_vertices;        /* 1 to 2^31 - 1 */
  const double *x, *y, *z;   /* vertex i is x[i * stride], y[i * stride], z[i * stride]; finite, magnitude at most 1e60 */
  int64_t stride;            /* in doubles; 1 for separate arrays, 3 for xyz(3,n) with y = x + 1, z = x + 2. Default 1 */
  int64_t n_faces;           /* 1 to 16,777,216 triangles, half as many quads */
  const void *vertex_ids;    /* corners_per_face entries a face; their order makes the normal by the right-hand rule */
  int32_t vertex_id_bits;    /* 32 or 64: vertex_ids points to int32_t or int64_t. Default 32 */
  int32_t index_base;        /* 0 or 1: the number of the first vertex in vertex_ids. Default 0 */
  int32_t corners_per_face;  /* 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3. Default 3 */
  int32_t reserved;          /* 0 */
  const int32_t *leaflet_id; /* one per face, >= 0; NULL: all 0 */
} riis_surface_arrays;
/* Fills *arrays with the defaults, all else with 0 and NULL; struct_size is sizeof(riis_surface_arrays) of the caller. */
RIIS_API riis_status riis_surface_arrays_init(riis_surface_arrays *arrays, int64_t struct_size);

/* Makes a surface from arrays. The winding stays the caller's. A triangle's id is the caller's: the face's number for
 * triangles, 2 * face and 2 * face + 1 for the halves of a quad, whatever was skipped.
 * Errors: RIIS_INVALID_ARGUMENT for a field or option out of range; RIIS_LIMIT_EXCEEDED for too many vertices or faces;
 * RIIS_INVALID_SURFACE naming the face or vertex and its value. A triangle has zero area when its height over its
 * longest edge is at most 1e-12 of that edge, or that edge is shorter than 1e-60. */
RIIS_API riis_status riis_surface_create_from_arrays(const riis_surface_arrays *arrays, const riis_surface_options *options,
                                                     riis_surface **surface);

/* Replaces the surface's content, as for a valve that moved: the handle stays, pointers got from it before end.
 *   valve    read during the call only
 *   options  NULL keeps the options that the surface has, not the defaults
 * On an error > 0 the surface is as it was. Errors are those of riis_surface_create. */
RIIS_API riis_status riis_surface_update(riis_surface *surface, const riis_valve *valve,
                                         const riis_surface_options *options);
/* The same from arrays; errors are those of riis_surface_create_from_arrays. */
RIIS_API riis_status riis_surface_update_from_arrays(riis_surface *surface, const riis_surface_arrays *arrays,
                                                     const riis_surface_options *options);
/* Destroys the surface; pointers got from it end, results stay. */
RIIS_API void riis_surface_destroy(riis_surface **surface);

/* What a surface is. */
typedef struct riis_surface_info {
  int64_t n_vertices;        /* length of what riis_surface_vertices gives */
  int64_t n_triangles;       /* those that are asked for closest points */
  int64_t n_zero_area;       /* triangles left out because they have no area */
  double half_thickness;     /* placed units */
  double area;               /* of all triangles, placed units squared */
  double lower[3], upper[3]; /* bounds of the triangles, placed units */
  double seconds_triangles;  /* wall time of the last create or update: checks and triangles */
  double seconds_scene;      /* and the Embree scene, with what another distance than the triangles' needs */
} riis_surface_info;
/* Tells what the surface is. struct_size is sizeof(riis_surface_info) of the caller; no more than that is written. */
RIIS_API riis_status riis_surface_get_info(const riis_surface *surface, riis_surface_info *info, int64_t struct_size);

/* The vertices, xyz(3, n_vertices), after placement. Any pointer may be NULL. Owned by the surface, valid until its next
 * update or its destruction. */
RIIS_API riis_status riis_surface_vertices(const riis_surface *surface, int64_t *n_vertices, const double **xyz);
/* Where each vertex lies on its patch: uv(2, n_vertices), in [0,1]. *uv is NULL for a surface from arrays. */
RIIS_API riis_status riis_surface_vertex_parameters(const riis_surface *surface, int64_t *n_vertices, const double **uv);
/* The triangles that closest points are sought on. Any pointer may be NULL. Lifetime as above.
 *   vertex_id    (3, n_triangles), from 0
 *   triangle_id  (n_triangles), ascending: the id that queries report. For a generated valve the position: 0, 1, 2, ...
 *   leaflet_id   (n_triangles)
 *   patch_id     (n_triangles); aortic: 4 * leaflet + 0 bottom, 1 top, 2 mirrored bottom, 3 mirrored top; mitral, from the
 *                posteromedial commissure round: anterior 0 commissure's triangle, 1 side, 2 middle, 3 mirrored middle,
 *                4 mirrored side, 5 mirrored triangle, posterior 6 side scallop, 7 half of the middle one, 8 and 9
 *                mirrored; valves from patches: the patch's number; surfaces from arrays: 0 */
RIIS_API riis_status riis_surface_triangles(const riis_surface *surface, int64_t *n_triangles,
                                            const int64_t **vertex_id, const int64_t **triangle_id,
                                            const int32_t **leaflet_id, const int32_t **patch_id);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Closest points (paper, 4.1)
 * ------------------------------------------------------------------------------------------------------------------ */

/* The closest point of the surface to one point. Where the surface's distances are by sampling or minimisation, the point is
 * the sample or S(u,v), leaflet_id that of its patch, normal that of S there, 0 0 0 where it has none, as at a collapsed
 * side; triangle_id is -1, barycentric and side are 0. */
typedef struct riis_closest {
  double distance;        /* >= 0 */
  double point[3];        /* on the triangle */
  double barycentric[3];  /* its weights of the triangle's three vertices, >= 0, sum 1 */
  double normal[3];       /* unit normal of the triangle, by the right-hand rule */
  int64_t triangle_id;    /* the lowest of the closest triangles' ids */
  int32_t leaflet_id;     /* the triangle's */
  int32_t side;           /* +1 on the side that normals point to (downstream), -1 on the other, 0 exactly on the surface or
                             level with its rim. At an edge or a vertex that several triangles share, their angle-weighted
                             normal decides (Baerentzen, Aanaes 2005); vertices are shared when their placed coordinates are
                             equal. Where an edge ends inside another (along the bending curve) it is the one triangle's */
} riis_closest;
/* Finds the closest point of one point, however far it is. Every number is computed in double precision, equal to that of a loop
 * over all triangles. Distances below 1e-154 underflow to 0. The first side asked of a new surface makes what all sides need.
 *   point        3 finite coordinates, magnitude at most 1e60
 *   struct_size  sizeof(riis_closest) of the caller; no more than that is written
 * Errors: RIIS_INVALID_ARGUMENT naming the coordinate. */
RIIS_API riis_status riis_closest_point(const riis_surface *surface, const double *point, riis_closest *closest,
                                        int64_t struct_size);

/* How closest points of many points are sought. */
typedef struct riis_closest_options {
  int64_t struct_size;    /* sizeof(riis_closest_options) of the caller, as its init function had it */
  double distance_limit;  /* points farther than this get far_distance, ids -1, side 0, and zeros. >= 0; default
                             RIIS_AUTO: no limit, which infinity is, too */
  double far_distance;    /* default RIIS_FAR_DISTANCE; must not lie in [0, distance_limit] */
  int32_t n_threads;      /* 1 to 1024, or 0, the default: the processors the calling thread may use */
  int32_t reserved;       /* 0 */
} riis_closest_options;
/* Fills *options with the defaults; struct_size is sizeof(riis_closest_options) of the caller. */
RIIS_API riis_status riis_closest_options_init(riis_closest_options *options, int64_t struct_size);

/* Where the answers for many points go; NULL for what is not wanted. Fields as in riis_closest. Where the surface's distances
 * are by sampling or minimisation, barycentric and side must be NULL (RIIS_INVALID_ARGUMENT). */
typedef struct riis_closest_arrays {
  int64_t struct_size;    /* sizeof(riis_closest_arrays) of the caller, as its init function had it */
  double *distance;       /* (n_points) */
  double *point;          /* (3, n_points) */
  double *barycentric;    /* (3, n_points) */
  double *normal;         /* (3, n_points) */
  int64_t *triangle_id;   /* (n_points) */
  int32_t *leaflet_id;    /* (n_points) */
  int32_t *side;          /* (n_points) */
} riis_closest_arrays;
/* Fills *arrays with NULL; struct_size is sizeof(riis_closest_arrays) of the caller. */
RIIS_API riis_status riis_closest_arrays_init(riis_closest_arrays *arrays, int64_t struct_size);

/* Closest points of many points, in parallel.
 *   n_points  >= 0
 *   x, y, z   point i is x[i * stride], y[i * stride], z[i * stride]; finite, magnitude at most 1e60
 *   stride    in doubles, >= 1
 *   options   NULL for defaults
 *   arrays    the arrays named in it are written; none may overlap another or the coordinates
 * Errors: RIIS_INVALID_ARGUMENT naming the first bad point; nothing is then written. */
RIIS_API riis_status riis_closest_points(const riis_surface *surface, int64_t n_points, const double *x, const double *y,
                                         const double *z, int64_t stride, const riis_closest_options *options,
                                         const riis_closest_arrays *arrays);

/* The distance that a far point gets unless the caller chooses another: finite, so that it can be interpolated and
 * compared without floating-point exceptions. */
#define RIIS_FAR_DISTANCE 1.0e30

/* ------------------------------------------------------------------------------------------------------------------ *
 * Mesh: the nodes to be marked
 * ------------------------------------------------------------------------------------------------------------------ */

/* The caller's nodes. The coordinates are borrowed: they must stay in place until the handle is destroyed or updated. */
typedef struct riis_mesh riis_mesh;

/* Borrows node coordinates and checks them once.
 *   n_nodes   1 to 2^40
 *   x, y, z   node i is x[i * stride], y[i * stride], z[i * stride]; finite, magnitude at most 1e60
 *   stride    in doubles, >= 1: 1 for separate arrays; 3 for xyz(3,n) with y = x + 1, z = x + 2
 * Errors: RIIS_INVALID_MESH naming the node and the value; RIIS_LIMIT_EXCEEDED for too many nodes. A process without nodes has
 * nothing to mark: do not call. */
RIIS_API riis_status riis_mesh_create(int64_t n_nodes, const double *x, const double *y, const double *z, int64_t stride,
                                      riis_mesh **mesh);
/* Tells the handle that the coordinates moved, in place or to other arrays, and checks them again. Arguments and errors as above.
 * To be called after any change of coordinates: clusters have copies of them, and the neighbour search knows where groups of nodes are;
 * without it both seek nodes where they were. The adjacency stays if n_nodes does; for other nodes make a new handle, which also
 * groups them anew. */
RIIS_API riis_status riis_mesh_update(riis_mesh *mesh, int64_t n_nodes, const double *x, const double *y, const double *z,
                                      int64_t stride);
/* Destroys the handle; the coordinates are the caller's and stay, and so do results. */
RIIS_API void riis_mesh_destroy(riis_mesh **mesh);
/* Makes what RIIS_SEARCH_CLUSTERS wants of the mesh now, rather than in the first marking that does: the order of its nodes in clusters,
 * and copies of their coordinates, about 41 bytes a node while the handle lives, about 32 more while they are made. After
 * riis_mesh_update with as many nodes the order stays, and only places are made again. Nothing if it is there already.
 *   n_threads  1 to 1024, or 0: the processors the calling thread may use
 * Errors: RIIS_INVALID_MESH for a coordinate that was made non-finite since it was given. */
RIIS_API riis_status riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads);

/* Which nodes are neighbours, as compressed sparse rows: those of node i are columns[offsets[i]] to columns[offsets[i + 1] - 1], less
 * the base. Filled by its init function; then set what there is. */
typedef struct riis_csr {
  int64_t struct_size;   /* sizeof(riis_csr) of the caller, as its init function had it */
  int64_t n_rows;        /* the mesh's n_nodes */
  int64_t n_all;         /* columns are nodes below this: those from n_rows on are ghosts, other ranks' nodes, which are legal and
                            ignored. At least n_rows; default 0 stands for n_rows */
  const void *offsets;   /* (n_rows + 1), ascending from the base; a row may be empty */
  const void *columns;   /* (offsets[n_rows] - base), in any order; a node itself and repetitions do no harm. NULL only if empty */
  int32_t offset_bits;   /* 32 or 64: int32_t or int64_t. Default 32 */
  int32_t column_bits;   /* 32 or 64. Default 32 */
  int32_t index_base;    /* 0 or 1: where both offsets and columns count from. Default 0 */
  int32_t reserved;      /* 0 */
} riis_csr;
/* Fills *csr with the defaults, all else with 0 and NULL; struct_size is sizeof(riis_csr) of the caller. */
RIIS_API riis_status riis_csr_init(riis_csr *csr, int64_t struct_size);

/* Gives the mesh the adjacency that the neighbour search walks along. Borrowed: the arrays must stay in place, unchanged, until the
 * handle is destroyed or given another. Checked once. NULL takes it away; riis_mesh_update with another n_nodes does, too.
 * Errors: RIIS_INVALID_ARGUMENT for a field out of range, RIIS_INVALID_MESH naming the row and its value; the mesh then keeps
 * what it had. */
RIIS_API riis_status riis_mesh_set_adjacency(riis_mesh *mesh, const riis_csr *csr);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Adjacency from what solvers have: cells, faces, a structured grid
 * ------------------------------------------------------------------------------------------------------------------ */

/* Compressed sparse rows that the library made and owns: ascending columns without repetition, symmetric, base 0. */
typedef struct riis_adjacency riis_adjacency;

/* Cells by their nodes. Filled by its init function. What a cell is, its number of nodes says: 4 tetrahedron, 5 pyramid, 6 prism,
 * 8 hexahedron, in VTK's order of nodes (base first, then apex or the nodes above: also Abaqus', CGNS', Gmsh's). */
typedef struct riis_cells {
  int64_t struct_size;     /* sizeof(riis_cells) of the caller, as its init function had it */
  int64_t n_nodes;         /* of the mesh, >= 1 */
  int64_t n_cells;         /* >= 1 */
  const void *node_ids;    /* the nodes of cell after cell */
  const void *offsets;     /* (n_cells + 1), ascending from 0 or from the base: where each cell's nodes begin in node_ids, and
                              where the last's end; of the type of node_ids. NULL: all cells have nodes_per_cell nodes */
  int32_t nodes_per_cell;  /* 4, 5, 6 or 8; not used with offsets. Default 4 */
  int32_t id_bits;         /* 32 or 64: int32_t or int64_t. Default 32 */
  int32_t index_base;      /* 0 or 1: the number of the first node. Default 0 */
  int32_t n_threads;       /* 1 to 1024, or 0, the default: the processors the calling thread may use */
} riis_cells;
/* Fills *cells with the defaults, all else with 0 and NULL; struct_size is sizeof(riis_cells) of the caller. */
RIIS_API riis_status riis_cells_init(riis_cells *cells, int64_t struct_size);
/* Neighbours are nodes that an edge of a cell joins. The arrays are read during the call only.
 * Errors: RIIS_INVALID_ARGUMENT for a field out of range, RIIS_INVALID_MESH naming the cell and its value. */
RIIS_API riis_status riis_adjacency_create_from_cells(const riis_cells *cells, riis_adjacency **adjacency);

/* Faces between cells, for codes that mark cell centres. Filled by its init function. */
typedef struct riis_faces {
  int64_t struct_size;     /* sizeof(riis_faces) of the caller, as its init function had it */
  int64_t n_cells;         /* >= 1: the nodes of the mesh are cell centres */
  int64_t n_faces;         /* >= 0 */
  const void *owner;       /* face i joins the cells owner[i * stride] and neighbor[i * stride] */
  const void *neighbor;    /* base - 1 (-1 or 0) for a face at the boundary, which joins nothing */
  int64_t stride;          /* in entries, 1 to 1024: 1 for separate arrays, 2 for face_cells(2, n_faces). Default 1 */
  int32_t id_bits;         /* 32 or 64: owner and neighbor point to int32_t or int64_t. Default 32 */
  int32_t index_base;      /* 0 or 1: the number of the first cell. Default 0 */
  int32_t n_threads;       /* 1 to 1024, or 0, the default: the processors the calling thread may use */
  int32_t reserved;        /* 0 */
} riis_faces;
/* Fills *faces with the defaults, all else with 0 and NULL; struct_size is sizeof(riis_faces) of the caller. */
RIIS_API riis_status riis_faces_init(riis_faces *faces, int64_t struct_size);
/* Neighbours are cells with a common face. The arrays are read during the call only.
 * Errors: RIIS_INVALID_ARGUMENT for a field out of range, RIIS_INVALID_MESH naming the face and its owner, if that is no cell, or
 * its neighbor, if that is neither a cell nor the base - 1 of a boundary. */
RIIS_API riis_status riis_adjacency_create_from_faces(const riis_faces *faces, riis_adjacency **adjacency);

/* A structured grid of ni * nj * nk nodes, each >= 1; node i + ni (j + nj k). Neighbours differ by 1 in one of i, j, k.
 *   n_threads  1 to 1024, or 0: the processors the calling thread may use
 * Errors: RIIS_INVALID_ARGUMENT for an extent or n_threads out of range. */
RIIS_API riis_status riis_adjacency_create_from_grid(int64_t ni, int64_t nj, int64_t nk, int32_t n_threads,
                                                     riis_adjacency **adjacency);
/* Fills *csr for riis_mesh_set_adjacency. Its arrays are the adjacency's: destroy it after the mesh, not before. Offsets are
 * int64_t; columns int32_t as long as there are fewer than 2^31 nodes: column_bits says.
 *   struct_size  sizeof(riis_csr) of the caller; no more than that is written */
RIIS_API riis_status riis_adjacency_csr(const riis_adjacency *adjacency, riis_csr *csr, int64_t struct_size);
/* Destroys the adjacency and its arrays, after the mesh that it was given to. */
RIIS_API void riis_adjacency_destroy(riis_adjacency **adjacency);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Marking (paper, 4.2)
 * ------------------------------------------------------------------------------------------------------------------ */

/* The nodes that were found and where the surface is from them. Made once, reused every step: its memory is kept. */
typedef struct riis_mark_result riis_mark_result;
/* Makes a result that has nothing yet; no mesh or surface belongs to it. */
RIIS_API riis_status riis_mark_result_create(riis_mark_result **result);
/* Destroys the result; pointers got from it end. */
RIIS_API void riis_mark_result_destroy(riis_mark_result **result);

/* How nodes are sought. Where the surface's distances are by sampling or minimisation, RIIS_SEARCH_AUTO is the exhaustive
 * search and RIIS_SEARCH_CLUSTERS is refused (RIIS_INVALID_ARGUMENT). The neighbour search then is as complete: the proof
 * goes by distances to the samples, or, since local minima prove nothing of nodes nearby, to the triangles. */
enum {
  RIIS_SEARCH_AUTO = 0,       /* the library's choice, never incomplete: clusters from the second marking of a mesh on, or once it is
                                 prepared; the exhaustive search for the first, which would not pay for them, and for limits
                                 of more than half the surface's extent */
  RIIS_SEARCH_EXHAUSTIVE = 1, /* every node is asked (paper, algorithm "Exhaustive node iteration") */
  RIIS_SEARCH_NEIGHBOR = 2,   /* from marked nodes to their neighbours (paper, algorithm "Recursive neighbor search"), started from
                                 the nodes that the result last had, or in every group of nodes that the surface may be near to;
                                 then every node that was not reached is proven far, by its group, or asked. So it is complete
                                 whatever the adjacency, the mask, and the pieces that the band falls into. The mesh must have an
                                 adjacency. The first search of a mesh makes the groups */
  RIIS_SEARCH_PAPER = 3,      /* the paper's algorithm to the letter, for comparison: one start, the node nearest to the first
                                 triangle's first vertex; only marked nodes pass it on. Misses what is not connected to that, and never says
                                 complete. The mesh must have an adjacency */
  RIIS_SEARCH_CLUSTERS = 4    /* nodes in clusters, made by riis_mesh_prepare or the first such search of a mesh; clusters that the
                                 surface may be near to are filtered in single precision, sixteen at a time, and decided in double
                                 (docs/theory.md, section 8). Complete, needs no adjacency. Where single precision cannot tell near
                                 from far, since the mesh or the limit is a million times as large as the surface, or the mesh as far
                                 away, and for 2^32 nodes and more, the exhaustive search runs in its place, as stats.search says */
};

/* Which instructions of the processor a marking uses. All give the same bits. */
enum {
  RIIS_INSTRUCTIONS_AUTO = 0,     /* the best that there are */
  RIIS_INSTRUCTIONS_BASELINE = 1, /* of every processor that the library was built for: SSE2 on x86-64 */
  RIIS_INSTRUCTIONS_AVX2 = 2,     /* and FMA */
  RIIS_INSTRUCTIONS_AVX512 = 3    /* F, DQ, BW, VL */
};

/* How nodes are marked. */
typedef struct riis_mark_options {
  int64_t struct_size;       /* sizeof(riis_mark_options) of the caller, as its init function had it */
  double distance_limit;     /* distances are wanted up to here, in mesh units: from the surface's half thickness to
                                1e60; marks stay those of the half thickness. Default RIIS_AUTO: the half thickness */
  const uint8_t *node_mask;  /* (n_nodes): nodes with 0 are left out; NULL: all nodes. Read during the call only. Nodes left
                                out have finite coordinates, too */
  int32_t search;            /* RIIS_SEARCH_*, default RIIS_SEARCH_AUTO */
  int32_t n_threads;         /* 1 to 1024, or 0, the default: the processors the calling thread may use */
  int32_t instructions;      /* RIIS_INSTRUCTIONS_*, for tests and measurements; default RIIS_INSTRUCTIONS_AUTO. Those that the
                                processor has not are refused with RIIS_UNAVAILABLE. Distances by sampling or minimisation
                                use none but the baseline's */
  int32_t reserved;          /* 0 */
} riis_mark_options;
/* Fills *options with the defaults; struct_size is sizeof(riis_mark_options) of the caller. */
RIIS_API riis_status riis_mark_options_init(riis_mark_options *options, int64_t struct_size);

/* Finds every node whose distance to the surface is at most the half thickness (marked) or the distance limit. The
 * decision is on the reported distance, in double precision, inclusive.
 *   surface, mesh  read; may be shared with other calls under way
 *   options        NULL for defaults
 *   result         its former content is replaced; pointers got from it before end
 * Errors: RIIS_INVALID_MESH if the coordinate of a node that is asked, or grouped, was made non-finite behind the mesh handle's
 * back. On an error > 0 the content of the result is as it was, though its arrays may have moved: get the pointers again. */
RIIS_API riis_status riis_mark_nodes(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                                     riis_mark_result *result);

/* The marked nodes, ascending by node_id, all arrays (n_marked). Any pointer may be NULL; with n_marked = 0 the arrays
 * are NULL. Owned by the result, valid until the next riis_mark_nodes with it or its destruction. A result never marked
 * with has none. A triangle_id is -1 where the surface's distances are by sampling or minimisation. */
RIIS_API riis_status riis_mark_result_marked(const riis_mark_result *result, int64_t *n_marked, const int64_t **node_id,
                                             const double **distance, const int64_t **triangle_id,
                                             const int32_t **leaflet_id);
/* The same for all nodes within the distance limit, marked or not: a superset, equal to the marked nodes without a wider
 * limit. */
RIIS_API riis_status riis_mark_result_within_limit(const riis_mark_result *result, int64_t *n_within, const int64_t **node_id,
                                                   const double **distance, const int64_t **triangle_id,
                                                   const int32_t **leaflet_id);

/* The same as dense arrays of the caller's, one entry a node of the mesh; NULL for what is not wanted. Every entry is
 * written.
 *   n_nodes       length of the arrays; must be the number of nodes that was marked with
 *   far_distance  distance of the nodes beyond the limit or masked out; RIIS_FAR_DISTANCE, or any value (NaN too)
 *                 outside [0, distance limit], so that no far node can look near
 *   mark          1 for marked nodes, 0 for others
 *   distance      of every node within the distance limit, else far_distance
 *   triangle_id   of every node within the distance limit, else -1
 *   leaflet_id    of every node within the distance limit, else -1
 * Errors: RIIS_INVALID_ARGUMENT for another n_nodes (a result never marked with has 0), or a far_distance that can look near. */
RIIS_API riis_status riis_mark_result_dense(const riis_mark_result *result, int64_t n_nodes, double far_distance,
                                            uint8_t *mark, double *distance, int64_t *triangle_id, int32_t *leaflet_id);

/* How the last marking went. */
typedef struct riis_mark_stats {
  int64_t n_nodes;      /* of the mesh, masked out or not */
  int64_t n_marked;     /* nodes within the half thickness */
  int64_t n_within_limit; /* nodes within the distance limit, marked or not */
  int64_t n_queries;    /* closest-point queries that were made, of nodes and, by the neighbour search, of groups of nodes */
  double seconds;       /* wall time of riis_mark_nodes */
  int32_t search;       /* the search that ran, never RIIS_SEARCH_AUTO */
  int32_t n_threads;    /* threads that really ran, the most in any part of the search. A caller's TBB limit binds walks, not loops */
  int32_t complete;     /* 1: every node within the limit was found, which is certain, for the coordinates that the mesh was last
                           told of; 0: it is not certain (RIIS_SEARCH_PAPER) */
  int32_t instructions; /* those that were used, never RIIS_INSTRUCTIONS_AUTO */
  int64_t n_unreached;  /* nodes within the limit that the neighbour search did not reach from neighbour to neighbour, and that
                           its proof found */
} riis_mark_stats;
/* Tells how the last marking with the result went; all 0 for a result never marked with. struct_size is sizeof(riis_mark_stats) of
 * the caller; no more than that is written. */
RIIS_API riis_status riis_mark_result_stats(const riis_mark_result *result, riis_mark_stats *stats, int64_t struct_size);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Leaks: where the mesh is too coarse for the marks to close the surface (docs/meshes.md)
 * ------------------------------------------------------------------------------------------------------------------ */

/* An edge of the mesh leaks when it crosses the surface and neither of its nodes is marked: flow passes along it. An edge that
 * crosses the surface and is at most two half thicknesses long always has a marked node. */
typedef struct riis_leaks {
  int64_t n_edges;            /* edges that leak. Where it is 0, the node ids are -1 and the other fields but seconds 0 */
  int64_t longest_node_id[2]; /* the nodes of the longest edge, ascending; of equally long edges the one that is listed first */
  double longest_length;      /* its length, mesh units */
  double longest_middle[3];   /* its middle */
  double half_thickness;      /* the smallest half thickness at which each edge has a node within it, by these triangles */
  double seconds;             /* wall time of riis_find_leaks */
} riis_leaks;

/* Finds every edge of the mesh's adjacency that crosses the surface's triangles between two unmarked nodes. An edge crosses a
 * triangle when they have a point in common, touching included; that is decided exactly for the coordinates in double precision
 * (those below 1e-90 count as 0), so nothing slips through between triangles that share an edge or a vertex. A column that one
 * of two rows lacks is an edge all the same, each edge counts once, and edges to ghosts are not looked at: an edge between two
 * ranks is seen by neither. Gaps of the surface itself, such as those between leaflets that do not touch, are not found.
 *   surface, mesh   those of the marking; read. The mesh must have an adjacency. The first call for a mesh, and the first after
 *                   its coordinates or adjacency changed, goes through all edges; others look only at long ones near the surface
 *   options         those of the marking, NULL for defaults. node_mask: an edge to a node that is left out is no path
 *   result          of riis_mark_nodes; its edges are replaced, all else stays
 *   leaks           what was found
 *   struct_size     sizeof(riis_leaks) of the caller; no more than that is written
 * A marking of the same triangles with leaks.half_thickness leaves none of the edges open, whatever its search but
 * RIIS_SEARCH_PAPER. The triangles of a valve follow the half thickness: with another one they move by up to
 * tolerance * half_thickness, so look again after riis_surface_update.
 * Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, if the result was never marked with, or was marked with another
 * number of nodes or another half thickness; RIIS_INVALID_MESH as riis_mark_nodes. The result is then as it was. */
RIIS_API riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                                     riis_mark_result *result, riis_leaks *leaks, int64_t struct_size);

/* The edges that the last riis_find_leaks with the result found, ascending by their first node, then by their second. Any pointer
 * may be NULL; with n_edges = 0 the arrays are NULL. Owned by the result, valid until the next riis_find_leaks or
 * riis_mark_nodes with it, which leaves none, or its destruction.
 *   node_id   (2, n_edges), the lower one first
 *   length    (n_edges)
 *   distance  (n_edges): the smaller of its two nodes' distances, the half thickness from which on the edge is closed */
RIIS_API riis_status riis_mark_result_leaking_edges(const riis_mark_result *result, int64_t *n_edges, const int64_t **node_id,
                                                    const double **length, const double **distance);

#ifdef __cplusplus
}
#endif

#endif
