/* SPDX-License-Identifier: Apache-2.0
 *
 * riis.h - the whole public interface of riis: heart valves as resistive immersed implicit surfaces.
 *
 *   riis_valve  --riis_surface_create-->  riis_surface  --riis_mark_nodes-->  riis_marks
 *   (named parameters)                    (triangles, Embree scene)           (nodes in the band)
 *
 * The shortest complete program:
 *
 *   riis_valve *valve = NULL; riis_surface *surface = NULL; riis_mesh *mesh = NULL; riis_marks *marks = NULL;
 *   riis_mark_list marked;
 *   riis_valve_create("aortic", &valve);
 *   riis_surface_create(valve, NULL, &surface);
 *   riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh);
 *   riis_marks_create(&marks);
 *   riis_mark_nodes(surface, mesh, NULL, marks);                                   (once a time step)
 *   riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked);          (marked.node_id, .distance)
 *
 * These rules hold for every function:
 *
 * - Units: lengths have one unit of the caller's choice, and angles are in degrees. The valves' default lengths are in
 *   centimetres; a placement's scale turns them into the mesh's unit (0.01 for metres).
 * - Ids: values called *_id count from 0, also in messages. If a struct has a field index_base, the ids in it
 *   count from that base, 0 (default) or 1. A field id_bits gives the ids' width: 32 (default) or 64.
 * - Points: point i is x[i * stride], y[i * stride], z[i * stride]; finite, magnitude at most 1e60. stride counts
 *   numbers and is at least 1: it is 1 for separate arrays, and 3 for xyz(3,n) with y = x + 1, z = x + 2. A field
 *   real_bits gives the numbers' width: 64 (default) or 32. Without this field they are doubles. The same holds for
 *   vectors.
 * - Order: the first argument is the object that the function is named after. Then come arguments that the call
 *   reads, then options, then arguments that it writes. Functions with `get` in their names return content.
 * - Status: a function that can fail returns a riis_status; 0 is success. If the status is positive, the call has
 *   changed nothing, and pointers from earlier calls stay valid. If it is negative, an object that the call should have
 *   written can only be destroyed. riis_last_error() has the message. No function aborts, prints or throws.
 * - Errors of any function: RIIS_INVALID_ARGUMENT for a NULL that is not allowed and for an argument or field out
 *   of range, RIIS_INVALID_STRUCT_SIZE for a struct of a wrong size, RIIS_OUT_OF_MEMORY.
 * - Handles: a new object is the last argument, written only on success. A destroy function takes a handle's
 *   address, accepts NULL, and sets the handle to NULL. It ignores handles of another kind; other calls refuse them.
 * - Memory: a call reads its arguments and their arrays only while it runs, except arrays that it borrows. Arrays
 *   that a call returns belong to the handle, and are valid until the handle's next update or destruction. An array
 *   without entries is NULL if a call returns it, and may be NULL if the caller passes it.
 * - Structs: a struct that a call fills in is followed by its size, as in (&list, sizeof list), and the call
 *   writes no more bytes. A struct that a call reads begins with struct_size. Its init function sets that field, the
 *   defaults, and all else to 0 or NULL. A NULL options pointer means all defaults. New fields are appended, or
 *   replace `reserved`, which must be 0.
 * - Threads: any number of threads may read a handle (const) at once. One thread may write it while no other
 *   reads it. Different handles never interfere. Results are bitwise the same for any number of threads.
 * - n_threads: 1 to 1024, or 0, the default. The default is one thread, and one more for each 4096 triangles (of a
 *   surface's last content), 16,384 nodes, cells or faces, or 2048 points. It never exceeds the number of processors
 *   in the calling thread's affinity mask. By default, a part of a call with little work takes one thread.
 *   OMP_NUM_THREADS and omp_set_num_threads have no effect. With n_threads 1, no thread is started. If the
 *   system refuses a thread or its memory, OpenMP and TBB end the process (docs/building.md).
 *   Threads of the library's own loops block signals other than those of errors.
 * - fork(): if the library has used several threads, a child process may use only 1, and 0 means 1 there. More threads
 *   are refused as RIIS_UNAVAILABLE. A child cannot make surfaces if another thread was inside the library at the fork.
 * - Environment: calls, and log functions within them, run with the default floating-point environment. Each call
 *   restores the caller's environment at its end. The caller's OpenMP and TBB settings are not changed.
 *
 * "Paper" is B. van der Vuurst, J. Kosinka, C. Bertoglio, "Fast generation of 3D flow obstacles from
 * parametric surface models: application to cardiac valves" (2025); docs/theory.md lists every departure.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_RIIS_H
#define RIIS_RIIS_H

#include <stdint.h>

#define RIIS_VERSION_MAJOR 1 /* version of this header; grows with a change that breaks compiled callers */
#define RIIS_VERSION_MINOR 0 /* grows with an addition */
#define RIIS_VERSION_PATCH 0 /* grows with a correction */

#if defined(__GNUC__) && !defined(RIIS_STATIC)
#define RIIS_API __attribute__((visibility("default"))) /* marks every exported function */
#else
#define RIIS_API /* a static library has no exports */
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Status, errors, log, version ---------------------------------------------------------------------- */

/* What a call returns. Values are part of the ABI and never change. New ones are appended at either end. */
typedef int32_t riis_status;
/* Values of riis_status. */
enum {
  RIIS_OK = 0,                  /* success */
  RIIS_INVALID_ARGUMENT = 1,    /* a NULL pointer, a number out of range, a non-finite option */
  RIIS_INVALID_STRUCT_SIZE = 2, /* a size that no release has: not initialised, or riis.h newer than the library */
  RIIS_INVALID_PARAMETER = 3,   /* a valve: unknown kind or name, value out of range, values that clash */
  RIIS_INVALID_SURFACE = 4,     /* the caller's surface: empty, non-finite, index out of range, zero area */
  RIIS_INVALID_MESH = 5,        /* the caller's mesh: empty, non-finite coordinate */
  RIIS_LIMIT_EXCEEDED = 6,      /* the request is valid but too large for the library */
  RIIS_OUT_OF_MEMORY = 7,       /* memory ran out; nothing changed */
  RIIS_FILE_ERROR = 8,          /* a file cannot be read or written, or has other content (riis_vtk.h) */
  RIIS_UNAVAILABLE = 9,         /* something outside the library is missing: threads after a fork(), a display */
  RIIS_INTERNAL_ERROR = -1      /* an error in riis or in a library that it uses */
};

/* Returns the status's own name, such as "RIIS_INVALID_ARGUMENT", or "unknown status". Static text. */
RIIS_API const char *riis_status_name(riis_status status);

/* Returns the message of the calling thread's last failed call. The message names the argument and its value. It is ""
 * if no call has failed, and never NULL. It is valid until the thread's next failed call, and the library owns it. */
RIIS_API const char *riis_last_error(void);

/* Returns the version of the linked library, not of this header, as static text such as "1.0.0". */
RIIS_API const char *riis_version_string(void);

/* Receives messages, in the thread whose call sends them. It must not call the library, throw or jump out.
 *   user_data  the pointer that was passed to riis_set_log
 *   level      RIIS_LOG_INFO or RIIS_LOG_WARNING
 *   message    one line without a newline; valid during the call only */
typedef void (*riis_log_function)(void *user_data, int32_t level, const char *message);
/* The levels of a message. */
enum {
  RIIS_LOG_INFO = 0,   /* what was built and how large */
  RIIS_LOG_WARNING = 1 /* skipped triangles, sizes in different units, leaflets that cross */
};
/* Sets the log function of the process. Any thread may call riis_set_log.
 *   function   receives the messages; NULL, the default, means no log
 *   user_data  passed to the function; it must stay valid as long as the function is set
 * A message that another thread is sending may still reach the previous function.
 * A log function also makes the library search surfaces for crossings (riis_find_crossings). It searches a shape whose
 * parameters, patches or open state the caller chose. The search takes longer than an update. It runs at the shape's first
 * opening in each of the ranges 0, up to 0.05, up to 1/3, up to 2/3 and up to 1. It ends with the shape's first warning. */
RIIS_API void riis_set_log(riis_log_function function, void *user_data);

/* Stands for the value of another quantity, which the field's comment names. */
#define RIIS_AUTO (-1.0)

/* Points in the caller's arrays, for the calls that copy them or read them once. */
typedef struct riis_points {
  int64_t struct_size;     /* set by the init function */
  int64_t n_points;        /* 0 to 2^40 */
  const void *x, *y, *z;   /* (n_points) by stride; NULL only for 0 points */
  int64_t stride;          /* of x, y and z. Default 1 */
  int32_t real_bits;       /* of x, y and z */
  int32_t reserved;        /* 0 */
} riis_points;
RIIS_API riis_status riis_points_init(riis_points *points, int64_t struct_size); /* the defaults */

/* ---- Valve: named parameters (paper, tables "Aortic valve parameters" and "Mitral valve parameters"), or patches */

/* A parametric valve: its kind and its parameters' values. riis_surface_create makes the geometry. */
typedef struct riis_valve riis_valve;

/* Makes a valve with the default parameter values. The defaults of "aortic" and "mitral" are the paper's.
 *   kind  one of these (docs/theory.md); any other is RIIS_INVALID_PARAMETER:
 *         "aortic", the paper's three cusps
 *         "mitral", two leaflets
 *         "coapting", three equal cusps with a zone of coaptation
 *         "trileaflet", three equal cusps that close in straight lines
 *         "bileaflet", a mechanical prosthesis */
RIIS_API riis_status riis_valve_create(const char *kind, riis_valve **valve);
/* Makes a second valve with the same parameters, patches and states. Destroy both. */
RIIS_API riis_status riis_valve_copy(const riis_valve *valve, riis_valve **copy);
/* Destroys the valve. Surfaces made from it, and valves that open to it, stay as they are. */
RIIS_API void riis_valve_destroy(riis_valve **valve);

/* Sets a parameter by its name in the paper. riis_surface_create checks whether all values fit together.
 *   name      such as "root_radius". A name such as "right.leaflet_angle" is that of one cusp ("right", "left",
 *             "non_coronary"), and "leaflet_angle" stands for all three
 *   n_values  3 for rotation, translation (x, y, z), t0_* and t3_* (right, left, non-coronary cusp); 1 for others
 *   values    (n_values), within the parameter's range
 * Two parameters change the whole valve:
 * - "opening", 0 to 1, moves the valve from a closed to an open state. One set of parameters makes both states. The
 *   default is 1 (open) for the mitral valve, and 0 for others. The aortic valve at 0 has the paper's state, which
 *   leaves a hole. A valve from patches has opening 0 only, until riis_valve_set_open_state. To move a valve, set
 *   "opening" and call riis_surface_update.
 * - "skirt_length" gives any valve except "bileaflet" a skirt. The skirt is a strip outwards from the attachment, and
 *   closes the gap to the wall (docs/theory.md, "Skirt"). The length is 0, the default, or 1e-4 to 10 times the
 *   attachment's mean distance from its axis. The value of an open state is ignored.
 * Errors: RIIS_INVALID_PARAMETER naming the parameter and the value. */
RIIS_API riis_status riis_valve_set(riis_valve *valve, const char *name, int64_t n_values,
                                    const double *values);
/* Sets a parameter that has one value. Arguments and errors as riis_valve_set. */
RIIS_API riis_status riis_valve_set_scalar(riis_valve *valve, const char *name, double value);
/* Copies a parameter's values to the caller's array. Arguments as riis_valve_set.
 * Errors: RIIS_INVALID_PARAMETER, also for a name that stands for all cusps. */
RIIS_API riis_status riis_valve_get(const riis_valve *valve, const char *name, int64_t n_values,
                                    double *values);

/* Sizes by a surgeon's names, and sizes that follow from others (docs/theory.md, section 3). Three names stand for
 * parameters. A kind without such a size refuses its name, and says why:
 *   annulus           diameter: 2 root_radius (aortic, coapting, trileaflet), 2 radius (bileaflet)
 *   stj               diameter at the commissures: 2 leaflet_radius_out (aortic, trileaflet) or 2 commissure_radius
 *                     (coapting)
 *   effective_height  height of the free edges above the annulus: leaflet_height (aortic, trileaflet). It is a
 *                     parameter of the coapting valve, for the middle of the edges
 * Some parameters have a rule: they follow from other parameters until they are set. The order of calls does not matter.
 * riis_valve_get gives their present values. Copies and open states keep the difference between set and not set. */

/* Returns a parameter to the value of a valve on which it was not set: its rule's value, or its default.
 *   name  as in riis_valve_set
 * Errors: RIIS_INVALID_PARAMETER for another name. */
RIIS_API riis_status riis_valve_unset(riis_valve *valve, const char *name);
/* Says whether a parameter was set.
 *   name    as in riis_valve_get
 *   is_set  1, or 0 if the parameter has its default or follows its rule
 * Errors: RIIS_INVALID_PARAMETER, also for a name that stands for all cusps. */
RIIS_API riis_status riis_valve_is_set(const riis_valve *valve, const char *name, int32_t *is_set);

/* Gives the valve a second state: opening 0 is then the valve's own state, and opening 1 is the state of the valve `open`.
 *   open  a valve of the same kind, which is copied. Its opening, leaflet ids and open state are ignored. From patches, it
 *         has the same curves, sides and degrees (1 may stand for 2). Either both bileaflet valves have a ring or neither
 * A second call replaces the state. No call removes it. Between the states control points are blended linearly
 * (docs/theory.md, section 5). A bileaflet valve blends lengths and angles instead. The middle of a coapting cusp's free edge
 * hangs as deep as the edge's length requires. A mitral, trileaflet or coapting valve takes its closed shape from its own
 * parameters, and its open shape from those of `open`.
 * Errors: RIIS_INVALID_PARAMETER for another kind, or other curves, degrees or sides. */
RIIS_API riis_status riis_valve_set_open_state(riis_valve *valve, const riis_valve *open);

/* The caller's own valve, such as a prosthesis: Coons patches, each given by four boundary curves (paper, 3.3).
 * - The sides v = 0 and v = 1 run from the side u = 0 to the side u = 1.
 * - The sides u = 0 and u = 1 run from the side v = 0 to the side v = 1.
 * - Sides must meet at corners to 1e-9 of the valve's size. A side may be a single point.
 * - Normals point along S_u x S_v.
 * - Patches that name the same curve meet without cracks. */
typedef struct riis_patches {
  int64_t struct_size;       /* set by the init function */
  int64_t n_curves;          /* 1 to 4,000,000; each is a side of a patch */
  const int32_t *degree;     /* (n_curves): 1, 2 or 3, Bezier curves with degree + 1 control points */
  const double *control;     /* (3, sum of all degree + 1), curve after curve; finite, at most 1e30 */
  int64_t n_patches;         /* 1 to 1,000,000 */
  const int32_t *curve_id;   /* (4, n_patches): the curves at v = 0, v = 1, u = 0, u = 1 */
  const int32_t *reversed;   /* (4, n_patches): 1 if the side runs against its curve, else 0; NULL: all 0 */
  const int32_t *leaflet_id; /* (n_patches), >= 0; NULL: all 0 */
  int32_t index_base;        /* of curve_id */
  int32_t reserved;          /* 0 */
} riis_patches;
RIIS_API riis_status riis_patches_init(riis_patches *patches, int64_t struct_size); /* the defaults */

/* Makes a valve from patches, which it copies. Its parameters are "opening" and "skirt_length". A skirt continues the
 * sides v = 0 that only one patch has. patch_id is the patch's number, from 0.
 * Errors: RIIS_INVALID_PARAMETER naming the curve or patch and its value, such as sides that do not meet. */
RIIS_API riis_status riis_valve_create_from_patches(const riis_patches *patches, riis_valve **valve);

/* The description of a parameter. The texts are static. */
typedef struct riis_parameter {
  const char *name;        /* the name as riis_valve_set takes it */
  const char *unit;        /* "length", "degree" or "1" */
  const char *description; /* one line */
  int64_t n_values;        /* 1 or 3 */
  double default_values[3];/* entries beyond n_values are 0 */
  double minimum;          /* of every value, inclusive */
  double maximum;          /* of every value, inclusive */
  const char *rule;        /* value of a parameter that was not set, such as "0.5 leaflet_height"; "": the default */
  const char *other_name;  /* second name that riis_valve_set takes, such as "annulus"; "": none */
  double other_factor;     /* factor from the parameter's value to that under other_name: 1 or 2; 0 without other_name */
} riis_parameter;
/* Gives the number of the valve's parameters. */
RIIS_API riis_status riis_valve_get_n_parameters(const riis_valve *valve, int64_t *n_parameters);
/* Gives the description of a parameter.
 *   parameter_id  0 to n_parameters - 1 */
RIIS_API riis_status riis_valve_get_parameter(const riis_valve *valve, int64_t parameter_id,
                                              riis_parameter *parameter, int64_t struct_size);

/* The curves and patches of a valve at its opening, after a warp and before placement. If n_pieces equals n_curves, the
 * arrays are those of riis_patches, and make the same shape. Trileaflet and aortic valves and valves from patches have
 * as many pieces as curves. */
typedef struct riis_valve_patches {
  int64_t n_curves;           /* curves; each is a side of a patch */
  int64_t n_pieces;           /* Bezier pieces of all curves. Sides of mitral and bileaflet patches may have several */
  const int64_t *first_piece; /* (n_curves + 1): the pieces of curve i are first_piece[i] to first_piece[i + 1] - 1 */
  const int32_t *degree;      /* (n_pieces): 2 or 3 */
  const double *control;      /* (3, sum of all degree + 1): control points, piece after piece */
  int64_t n_patches;          /* the number of patches */
  const int32_t *curve_id;    /* (4, n_patches): the curves at v = 0, v = 1, u = 0, u = 1 */
  const int32_t *reversed;    /* (4, n_patches): 1 if the side runs against its curve, else 0 */
  const int32_t *leaflet_id;  /* (n_patches): as in riis_triangles */
  const int32_t *patch_id;    /* (n_patches): as in riis_triangles */
  const int32_t *attached;    /* (n_patches): the side that is attached, 0 to 3 in the order of curve_id, or -1 */
  const double *bulge;        /* (n_patches): 0 for a Coons patch. Otherwise the line at each u is an arc from v = 0 to
                                 v = 1. With the width W and the unit tangent T of the side v = 0, its middle control
                                 point lies bulge |W| unit(W x T) beside the middle of the straight line */
} riis_valve_patches;
/* Gives the curves and patches of a valve at its opening. The arrays are valid until the valve's next call that is not
 * const. Points of a side are labelled by their share of its length. All normals S_u x S_v point as in riis_surface_create.
 * A mitral patch has a bulge, so a Coons patch of its sides differs from it.
 * Errors: RIIS_INVALID_PARAMETER as riis_surface_create. */
RIIS_API riis_status riis_valve_get_patches(riis_valve *valve, riis_valve_patches *patches, int64_t struct_size);

/* ---- Surface: triangles in space that answer closest-point queries ------------------------------------- */

/* Triangles with a half thickness. A surface borrows nothing from the caller. The first query that needs it builds the
 * triangles' Embree scene, also if several threads query at once. */
typedef struct riis_surface riis_surface;

/* The leaflets of the parametric valves, as leaflet_id reports them. */
enum {
  RIIS_LEAFLET_RIGHT = 0,       /* aortic: the right coronary cusp, "right" in names of parameters;
                                   coapting, trileaflet: on the x axis */
  RIIS_LEAFLET_LEFT = 1,        /* aortic: the left coronary cusp, "left"; coapting, trileaflet: at 120 degrees */
  RIIS_LEAFLET_NON_CORONARY = 2,/* aortic: "non_coronary"; coapting, trileaflet: at -120 degrees */
  RIIS_LEAFLET_ANTERIOR = 0,    /* mitral: the anterior leaflet */
  RIIS_LEAFLET_POSTERIOR = 1,   /* mitral: the posterior leaflet, all three scallops */
  RIIS_LEAFLET_POSITIVE = 0,    /* bileaflet: the leaflet at x > 0 */
  RIIS_LEAFLET_NEGATIVE = 1,    /* bileaflet: the leaflet at x < 0 */
  RIIS_LEAFLET_HOUSING = 2,     /* bileaflet: the housing's wall, if ring_height is not 0 */
  RIIS_LEAFLET_SKIRT = 3        /* the skirt of a valve of any kind but bileaflet, if skirt_length is not 0. The skirt of
                                   a valve from patches has this id or the largest leaflet_id + 1, the larger of both */
};

/* How triangles of zero area in the caller's arrays are treated. */
enum {
  RIIS_ZERO_AREA_REFUSE = 0, /* refuse the surface: RIIS_INVALID_SURFACE naming the first such triangle */
  RIIS_ZERO_AREA_SKIP = 1    /* skip and count such triangles, and log a warning; other triangles keep their ids */
};

/* How the distance of a point to the surface is measured (paper, 4.1). Sampling and minimisation are for comparison with
 * the paper, and only for surfaces of valves. They measure to points S(u,v) of patches, with the error
 * e = measure_tolerance * half_thickness (docs/theory.md, section 9). Their closest point has the leaflet_id of its patch,
 * the normal of S (0 0 0 if S has none), triangle_id -1, barycentric 0 and side 0. Calls with these measures refuse arrays
 * for barycentric and side, and RIIS_SEARCH_CLUSTERS, as RIIS_INVALID_ARGUMENT. */
enum {
  RIIS_MEASURE_TRIANGLES = 0,   /* the closest point of all triangles, exactly */
  RIIS_MEASURE_SAMPLING = 1,    /* the nearest of points spaced evenly on the patches, at most 16,777,216 of them.
                                    The distance is too large by at most e, too small by at most e / 10 */
  RIIS_MEASURE_MINIMIZATION = 2 /* Powell's method (1964) on every patch. The distance is too small by at most
                                    e / 10, but in a local minimum too large by any amount, unnoticed */
};

/* How the smooth valve is cut into triangles. */
enum {
  RIIS_TRIANGULATION_ADAPTED = 0, /* as few triangles as each state needs; they change as the valve opens */
  RIIS_TRIANGULATION_FIXED = 1    /* the same ids, vertices and neighbours at every opening. The first call with this option
                                     chooses them. After it only opening and placement may change:
                                     RIIS_INVALID_PARAMETER names any other parameter that changed.
                                     RIIS_LIMIT_EXCEEDED refuses an opening at which the tolerance does not hold.
                                     A triangle without area is left out, and its id is not reused. An update
                                     with RIIS_TRIANGULATION_ADAPTED forgets the choice. Vertices of mitral or
                                     warped valves slide along the surface, and velocities leave this slide out */
};

/* Options of a surface. The placement, also of arrays, is x -> scale * rotation * x + translation. */
typedef struct riis_surface_options {
  int64_t struct_size;     /* set by the init function */
  double half_thickness;   /* d_min (paper, 4.2), mesh units, 1e-50 to 1e50. Default RIIS_AUTO: 0.1 * scale */
  double tolerance;        /* 1e-6 to 1, default 0.05. Distances to a valve's triangles and to its smooth
                              surface differ by at most tolerance * half_thickness (docs/theory.md) */
  double scale;            /* 1e-12 to 1e12, default 1 */
  double rotation_axis[3]; /* components up to 1e50, length at least 1e-50; default (0, 0, 1) */
  double rotation_angle;   /* degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6, default 0 */
  double translation[3];   /* mesh units; -1e50 to 1e50, default 0. Refused for a valve if coordinates would be
                              rounded by more than a thousandth of tolerance * half_thickness */
  double measure_tolerance; /* error of sampling and minimisation, in half thicknesses, 1e-6 to 1. Default: tolerance */
  int32_t measure;         /* RIIS_MEASURE_*, for closest points and marking only; default
                              RIIS_MEASURE_TRIANGLES, the only one for surfaces from arrays */
  int32_t triangulation;   /* RIIS_TRIANGULATION_*; default RIIS_TRIANGULATION_ADAPTED */
  int32_t zero_area;       /* surfaces from arrays: RIIS_ZERO_AREA_*; default RIIS_ZERO_AREA_REFUSE */
  int32_t flip_normals;    /* 1 turns every triangle over: normal and side change sign; default 0 */
  int32_t n_threads;       /* default 0 */
  int32_t reserved;        /* 0 */
} riis_surface_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_surface_options_init(riis_surface_options *options, int64_t struct_size);

/* Makes the surface of a valve: curves, polylines, Coons patches, quads, triangles (paper, 3 and 4.1; docs/theory.md).
 *   valve    its parameters must fit together
 *   options  accuracy and placement
 * Normals point downstream: from the ventricular to the sinus face of the cusps, from the atrial to the ventricular face of
 * the mitral valve, and to +z on closed bileaflet leaflets. On the bileaflet ring they point outwards. Triangles of zero area
 * are skipped. They lie at the root of each cusp, at the mitral commissures and at the ends of bileaflet middle edges.
 * Errors: RIIS_INVALID_PARAMETER for parameters that do not fit together or that put a curve too far away;
 * RIIS_LIMIT_EXCEEDED if a tolerance needs more than 16,777,216 triangles, quads or samples, or is smaller than
 * the rounding of coordinates. */
RIIS_API riis_status riis_surface_create(const riis_valve *valve, const riis_surface_options *options,
                                         riis_surface **surface);

/* The caller's own surface, triangles or quads. */
typedef struct riis_surface_arrays {
  int64_t struct_size;       /* set by the init function */
  int64_t n_vertices;        /* 1 to 2^31 - 1 */
  const void *x, *y, *z;     /* (n_vertices) by stride: the vertices, before placement */
  int64_t stride;            /* of x, y and z. Default 1 */
  const void *vx, *vy, *vz;  /* (n_vertices) by velocity_stride: velocities of the vertices, in lengths per
                                unit of time. The placement turns and scales them. All NULL: none */
  int64_t velocity_stride;   /* of vx, vy and vz. Default 1 */
  int64_t n_faces;           /* 1 to 16,777,216 triangles, half as many quads */
  const void *vertex_ids;    /* (corners_per_face, n_faces); the normal follows the right-hand rule */
  const int32_t *leaflet_id; /* (n_faces), >= 0; NULL: all 0 */
  int32_t corners_per_face;  /* 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3. Default 3 */
  int32_t id_bits;           /* of vertex_ids */
  int32_t index_base;        /* of vertex_ids */
  int32_t real_bits;         /* of vertices and velocities */
} riis_surface_arrays;
/* Fills *arrays with the defaults. */
RIIS_API riis_status riis_surface_arrays_init(riis_surface_arrays *arrays, int64_t struct_size);

/* Makes a surface from arrays, with the caller's winding. A triangle's id is its face's number; the halves of quad q have
 * 2 q and 2 q + 1. The id of a skipped triangle is not reused. A triangle has zero area if its height over its longest edge
 * is at most 1e-12 of that edge, or if that edge is shorter than 1e-60.
 * Errors: RIIS_LIMIT_EXCEEDED for too many; RIIS_INVALID_SURFACE naming the face or vertex and its value. */
RIIS_API riis_status riis_surface_create_from_arrays(const riis_surface_arrays *arrays,
                                                     const riis_surface_options *options,
                                                     riis_surface **surface);

/* Replaces the surface's content by that of a valve, such as one that moved. The handle stays.
 *   options  NULL keeps the surface's own options, not the defaults
 * Errors: as riis_surface_create. */
RIIS_API riis_status riis_surface_update(riis_surface *surface, const riis_valve *valve,
                                         const riis_surface_options *options);
/* Replaces the surface's content from arrays.
 *   arrays   with n_faces 0, and vertex_ids and leaflet_id NULL, only the vertices move: the surface keeps its last faces
 *   options  as in riis_surface_update
 * Errors: as riis_surface_create_from_arrays. With n_faces 0, also RIIS_INVALID_ARGUMENT for an n_vertices that
 * differs from that of the last arrays, and for a surface that was not made from arrays. */
RIIS_API riis_status riis_surface_update_from_arrays(riis_surface *surface, const riis_surface_arrays *arrays,
                                                     const riis_surface_options *options);
/* Destroys the surface. Marks stay. */
RIIS_API void riis_surface_destroy(riis_surface **surface);

/* The size of a surface, and the seconds that its last create or update took. */
typedef struct riis_surface_info {
  int64_t n_vertices;        /* as riis_triangles.n_vertices */
  int64_t n_triangles;       /* triangles that answer queries */
  int64_t n_zero_area;       /* triangles skipped because they have no area */
  double half_thickness;     /* mesh units */
  double area;               /* of all triangles, mesh units squared */
  double lower[3], upper[3]; /* bounds of the triangles, mesh units */
  double seconds_triangles;  /* wall time of the last create or update: for checks and triangles */
  double seconds_scene;      /* wall time of the last create or update: for groups of triangles, sampling,
                                minimisation. Embree's tree is built by the first query that needs it */
  double error_bound;        /* the most by which a point's distances to the triangles and to the smooth valve
                                can differ; at most tolerance * half_thickness. 0 for a surface from arrays */
  int64_t largest_leaflet_id; /* of the triangles */
} riis_surface_info;
/* Gives the size of the surface, and the seconds that it took. */
RIIS_API riis_status riis_surface_get_info(const riis_surface *surface, riis_surface_info *info,
                                           int64_t struct_size);

/* The triangles of a surface, after placement. */
typedef struct riis_triangles {
  int64_t n_vertices;         /* of the surface */
  const double *xyz;          /* (3, n_vertices): the vertices */
  const double *uv;           /* (2, n_vertices): each vertex's u and v on its patch, in [0,1]; NULL from arrays */
  const double *velocity;     /* (3, n_vertices): each vertex's velocity; NULL if the last update gave none.
                                 Where closed cusps meet, a vertex has the velocity of its own cusp */
  int64_t n_triangles;        /* triangles that answer queries */
  const int64_t *vertex_id;   /* (3, n_triangles): their vertices */
  const int64_t *triangle_id; /* (n_triangles), ascending: the id that queries report; 0, 1, 2, ... for a valve */
  const int32_t *leaflet_id;  /* (n_triangles): RIIS_LEAFLET_*, or the caller's from patches and arrays */
  const int32_t *patch_id;    /* (n_triangles). From arrays: 0. From patches: the patch's number, from 0. Aortic,
                                 coapting, trileaflet: 4 * leaflet, plus 0 bottom, 1 top, 2 and 3 mirrored.
                                 Mitral, anterior: 0 triangle at the posteromedial commissure, 1 side, 2 middle,
                                 3 mirrored middle, 4 mirrored side, 5 mirrored triangle. Mitral, posterior: 6 side
                                 scallop, 7 half of the middle scallop, 8 mirrored half, 9 mirrored side scallop.
                                 Bileaflet: 2 * leaflet, plus 0 or 1 for the half; 4 to 7 the ring's quarters.
                                 Skirt: the id of the leaflet's patch that it continues, plus the number of these
                                 ids: 10 mitral, 12 valves with three cusps */
} riis_triangles;
/* Gives the triangles of the surface, until its next update or its destruction. */
RIIS_API riis_status riis_surface_get_triangles(const riis_surface *surface, riis_triangles *triangles,
                                                int64_t struct_size);

/* The attachment of a valve, after placement: the edges at which tissue or a stent holds its leaflets. They are in the
 * order of the patches, and within a side in the order of u or v. */
typedef struct riis_attachment {
  int64_t n_edges;           /* the number of edges; edges of length 0 are left out */
  const double *edges;       /* (3, 2, n_edges): both ends of each edge, in the layout of riis_reaction.edges */
  const int64_t *vertex_id;  /* (2, n_edges): the vertices at the ends, in riis_triangles.xyz */
  const int32_t *leaflet_id; /* (n_edges): the leaflet that is attached there */
  const int32_t *patch_id;   /* (n_edges): its patch, as in riis_triangles */
} riis_attachment;
/* Gives the attachment of a valve's surface, until the surface's next update or its destruction.
 * - A cusp is attached at the sinus, u = 1, from the root to the commissures.
 * - A mitral leaflet is attached at the annulus, v = 0.
 * - Patches are attached at the sides v = 0 that only one patch has.
 * - A bileaflet valve has no attachment, because pivots hold its leaflets.
 * A skirt (the parameter "skirt_length") continues the leaflets there, and changes nothing.
 * Errors: RIIS_INVALID_ARGUMENT for a surface from arrays, because nothing tells which of its edges are attached. */
RIIS_API riis_status riis_surface_get_attachment(const riis_surface *surface, riis_attachment *attachment,
                                                 int64_t struct_size);

/* ---- Motion: surfaces with velocities, from two states of a valve or from frames ----------------------- */

/* Replaces the surface's content by that of a valve, and gives every vertex a velocity. The triangles are those of
 * riis_surface_update, to the last bit. If the valve is at rest, also pass it as valve_before.
 *   valve_before    the earlier state, of the same kind. A valve from patches has the same curves and sides
 *   dt              the time from valve_before to valve, 1e-30 to 1e30, or -1e30 to -1e-30 if time runs back
 *   options_before  scale, rotation and translation of the earlier state; other fields are ignored. NULL: as now
 * The velocity of a vertex is its displacement from the point with the same patch, u and v in the earlier state, divided by
 * dt (docs/theory.md, section 10). u and v of a warped valve are those before the warp, so the velocity is that of the wall
 * (docs/theory.md, "Warp"). The velocity is a mean over the step. It approximates the velocity in the middle of the step to
 * second order, and the velocity at either end to first order.
 * Errors: as riis_surface_update; RIIS_INVALID_PARAMETER for a valve_before of another kind or other patches, or
 * with parameters that do not fit together. */
RIIS_API riis_status riis_surface_update_moving(riis_surface *surface, const riis_valve *valve,
                                                const riis_valve *valve_before, double dt,
                                                const riis_surface_options *options,
                                                const riis_surface_options *options_before);

/* Interpolation between keys in time. A time counts as a key if it differs from the key plus whole periods by at
 * most 8 * 2^-52 of the largest of time, key and period. */
enum {
  RIIS_INTERPOLATION_LINEAR = 0, /* the rate jumps at keys; a key itself has the rate after the jump */
  RIIS_INTERPOLATION_CUBIC = 1   /* monotone between keys, with a continuous rate (Fritsch, Butland 1984) */
};
/* A surface that moves by frames, such as a patient's valve: the vertices move, the faces stay the same. */
typedef struct riis_keyframes riis_keyframes;
/* The frames of a surface that moves, in the caller's arrays. */
typedef struct riis_keyframe_arrays {
  int64_t struct_size;   /* set by the init function */
  int64_t n_keys;        /* 1 to 1,000,000 */
  int64_t n_vertices;    /* of each frame, as in riis_surface_arrays */
  const double *time;    /* (n_keys), strictly ascending, magnitude at most 1e30 */
  const void *xyz;       /* (3, n_vertices, n_keys): the vertices, frame after frame; magnitude at most 1e60 */
  double period;         /* > 0: the motion repeats. All keys lie within a period of the first key. A last key one
                            period after the first must have the same frame. 0, the default: the surface rests
                            before the first key and after the last */
  int32_t interpolation; /* RIIS_INTERPOLATION_*, of each coordinate. Default RIIS_INTERPOLATION_LINEAR */
  int32_t real_bits;     /* of xyz */
} riis_keyframe_arrays;
/* Fills *frames with the defaults. */
RIIS_API riis_status riis_keyframe_arrays_init(riis_keyframe_arrays *frames, int64_t struct_size);
/* Makes keyframes from copies of arrays and frames.
 *   arrays  as for riis_surface_create_from_arrays; its vertices and velocities are ignored, and may be NULL
 * Errors: RIIS_INVALID_SURFACE naming the frame, vertex or face; RIIS_LIMIT_EXCEEDED for too many. */
RIIS_API riis_status riis_keyframes_create(const riis_surface_arrays *arrays,
                                           const riis_keyframe_arrays *frames, riis_keyframes **keyframes);
/* Destroys the keyframes. Surfaces made from them stay. */
RIIS_API void riis_keyframes_destroy(riis_keyframes **keyframes);
/* Makes a surface from the frames around a time, with velocities.
 *   time  finite, magnitude at most 1e30
 *   dt    the velocity is the mean from time - dt to time; if 0, the derivative of the interpolation
 * Errors: as riis_surface_create_from_arrays. */
RIIS_API riis_status riis_surface_create_from_keyframes(const riis_keyframes *keyframes, double time, double dt,
                                                        const riis_surface_options *options,
                                                        riis_surface **surface);
/* Replaces the surface's content by the frames around a time. Arguments and errors as
 * riis_surface_create_from_keyframes, options as in riis_surface_update. */
RIIS_API riis_status riis_surface_update_from_keyframes(riis_surface *surface, const riis_keyframes *keyframes,
                                                        double time, double dt,
                                                        const riis_surface_options *options);

/* ---- Closest points (paper, 4.1) ----------------------------------------------------------------------- */

/* The closest point of the surface to one point. For other measures than triangles see RIIS_MEASURE_*. */
typedef struct riis_closest {
  double distance;        /* >= 0, mesh units */
  double point[3];        /* on the triangle, mesh units */
  double barycentric[3];  /* the point's weights for the triangle's vertices, >= 0, sum 1 */
  double normal[3];       /* unit normal of the triangle, by the right-hand rule */
  int64_t triangle_id;    /* the lowest id of the closest triangles */
  int32_t leaflet_id;     /* of the triangle */
  int32_t side;           /* +1 on the side to which normals point (downstream), -1 on the other side, 0 on the surface
                             or level with its rim. At a shared edge or vertex (equal placed coordinates) the
                             angle-weighted normal of its triangles decides (Baerentzen, Aanaes 2005) */
} riis_closest;
/* Finds the closest point of the surface at any distance, with the result of a loop over all triangles in double
 * precision. Distances below 1e-154 underflow to 0.
 *   point  3 finite coordinates, magnitude at most 1e60
 * Errors: RIIS_INVALID_ARGUMENT naming the coordinate. */
RIIS_API riis_status riis_closest_point(const riis_surface *surface, const double *point, riis_closest *closest,
                                        int64_t struct_size);

/* The default distance of far points. It is finite, so that arithmetic raises no floating-point exceptions. */
#define RIIS_FAR_DISTANCE 1.0e30

/* Options of queries for many points. */
typedef struct riis_closest_options {
  int64_t struct_size;       /* set by the init function */
  double distance_limit;     /* >= 0, default infinity. Farther points get far_distance, ids -1 and otherwise zeros */
  double far_distance;       /* the distance of farther points, outside [0, distance_limit]. Default RIIS_FAR_DISTANCE */
  const uint8_t *point_mask; /* (n_points): points with 0 must be finite, but get no result. NULL: no mask */
  int64_t n_point_ids;       /* length of point_ids; 0 without it */
  const int64_t *point_ids;  /* strictly ascending, 0 to n_points - 1: only these points are read, and only their
                                entries are written. NULL: all points. Not together with point_mask */
  int32_t n_threads;         /* default 0 */
  int32_t reserved;          /* 0 */
} riis_closest_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_closest_options_init(riis_closest_options *options, int64_t struct_size);

/* The caller's arrays for the fields of riis_closest; NULL for fields that are not wanted. */
typedef struct riis_closest_arrays {
  int64_t struct_size;    /* set by the init function */
  double *distance;       /* (n_points) */
  double *point;          /* (3, n_points) */
  double *barycentric;    /* (3, n_points) */
  double *normal;         /* (3, n_points) */
  int64_t *triangle_id;   /* (n_points) */
  int32_t *leaflet_id;    /* (n_points) */
  int32_t *side;          /* (n_points) */
} riis_closest_arrays;
/* Fills *arrays with NULL. */
RIIS_API riis_status riis_closest_arrays_init(riis_closest_arrays *arrays, int64_t struct_size);

/* Finds the closest points of many points, in parallel.
 *   arrays  the arrays to write; none may overlap another or the coordinates
 * Errors: RIIS_INVALID_ARGUMENT naming the first bad point; nothing is then written. */
RIIS_API riis_status riis_closest_points(const riis_surface *surface, const riis_points *points,
                                         const riis_closest_options *options,
                                         const riis_closest_arrays *arrays);

/* ---- Crossings: self-intersections, where the surface goes through itself ------------------------------ */

/* Options of riis_find_crossings. */
typedef struct riis_crossing_options {
  int64_t struct_size; /* set by the init function */
  double depth;        /* half thicknesses, 0 to 1, default 1e-6: pairs up to this depth only touch */
  int32_t n_threads;   /* default 0 */
  int32_t reserved;    /* 0 */
} riis_crossing_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_crossing_options_init(riis_crossing_options *options, int64_t struct_size);

/* The pairs of triangles that riis_find_crossings found. Make one object and reuse it. */
typedef struct riis_crossings riis_crossings;
RIIS_API riis_status riis_crossings_create(riis_crossings **crossings); /* makes crossings without a pair */
RIIS_API void riis_crossings_destroy(riis_crossings **crossings); /* destroys the crossings and their list */

/* Finds every pair of the surface's triangles that go through each other.
 *   options    a pair crosses if it is deeper than depth. A depth within the rounding error also counts as touching. That
 *              error is 2^-24 of the pair's longest edge plus 2^-46 of the surface's largest coordinate
 *   crossings  its content is replaced
 * A pair's depth is its penetration depth: the length of the shortest translation of one triangle after which both only
 * touch (docs/theory.md, section 16). Triangles that touch or lie in one plane have depth 0. Triangles of one leaflet that
 * share a vertex (equal placed coordinates) are neighbours, not a pair. The call uses the triangles with every
 * RIIS_MEASURE_*. Triangles of smooth leaflets that touch may therefore cross by twice riis_surface_info.error_bound. A log
 * function (riis_set_log) gets warnings of deeper crossings without this call.
 * Errors: RIIS_INVALID_ARGUMENT naming the field. */
RIIS_API riis_status riis_find_crossings(const riis_surface *surface, const riis_crossing_options *options,
                                         riis_crossings *crossings);

/* Pairs of triangles that cross, ascending by first triangle, then by second. Lengths are in mesh units. */
typedef struct riis_crossing_list {
  int64_t n_pairs;            /* pairs that cross. If 0, ids are -1 and all other fields but seconds are 0 */
  const int64_t *triangle_id; /* (2, n_pairs): the two triangles, the lower id first */
  const double *point;        /* (3, n_pairs): the middle of the segment in which the two triangles meet */
  const double *depth;        /* (n_pairs): the penetration depth */
  const double *length;       /* (n_pairs): the length of this segment */
  double total_length;        /* the sum of length */
  double deepest_depth;       /* the depth of the deepest pair, which is the first one of equally deep pairs */
  double deepest_point[3];    /* the point of the deepest pair */
  int64_t deepest_triangle_id[2]; /* the triangles of the deepest pair */
  int32_t deepest_leaflet_id[2];  /* the leaflets of the deepest pair's triangles */
  double seconds;             /* wall time of riis_find_crossings */
} riis_crossing_list;
/* Gives the pairs of the last riis_find_crossings, until the next riis_find_crossings with these crossings. */
RIIS_API riis_status riis_crossings_get_list(const riis_crossings *crossings, riis_crossing_list *list,
                                             int64_t struct_size);

/* ---- Mesh: the nodes that are marked ------------------------------------------------------------------- */

/* The caller's nodes. The coordinates are borrowed or copied, depending on the last call that gave them. */
typedef struct riis_mesh riis_mesh;

/* Borrows node coordinates and checks them once. They must stay in place until an update or the destruction. A process
 * without nodes makes the same calls as the other processes.
 *   n_nodes  0 to 2^40; with 0 the pointers may be NULL
 * Errors: RIIS_INVALID_MESH naming the node and the value; RIIS_LIMIT_EXCEEDED for too many nodes. */
RIIS_API riis_status riis_mesh_create(int64_t n_nodes, const double *x, const double *y, const double *z,
                                      int64_t stride, riis_mesh **mesh);
/* Tells the handle that the coordinates moved, in place or to other arrays, and checks them again. Call it after every
 * change of coordinates. The adjacency stays if n_nodes is the same. For other nodes make a new handle.
 * Arguments and errors as riis_mesh_create. */
RIIS_API riis_status riis_mesh_update(riis_mesh *mesh, int64_t n_nodes, const double *x, const double *y,
                                      const double *z, int64_t stride);
/* Copies node coordinates, such as a Fortran temporary or single precision, and checks them. Single precision is
 * converted to double once, exactly. The handle keeps 24 bytes per node.
 * Errors: as riis_mesh_create. */
RIIS_API riis_status riis_mesh_create_copy(const riis_points *nodes, riis_mesh **mesh);
/* As riis_mesh_update, but copies the coordinates. A mesh may change between borrowed and copied coordinates. */
RIIS_API riis_status riis_mesh_update_copy(riis_mesh *mesh, const riis_points *nodes);
/* Destroys the handle. The caller's coordinates stay, and so do marks. */
RIIS_API void riis_mesh_destroy(riis_mesh **mesh);
/* Makes the clusters of RIIS_SEARCH_CLUSTERS now, not in the first marking that uses them. Clusters copy the
 * coordinates: they take 41 bytes per node while the handle lives, and 32 more while they are made.
 * Errors: RIIS_LIMIT_EXCEEDED for 2^32 nodes and more; RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads);

/* Neighbours of nodes, as compressed sparse rows. With base = index_base, node i of 0 to n_rows - 1 has the
 * neighbours columns[k] - base for k from offsets[i] - base to offsets[i + 1] - base - 1. */
typedef struct riis_csr {
  int64_t struct_size;   /* set by the init function */
  int64_t n_rows;        /* the mesh's n_nodes */
  int64_t n_all;         /* columns are below this number, at least n_rows. Columns from n_rows on are ghosts, nodes
                            of other ranks, and are ignored. Default 0 stands for n_rows */
  const void *offsets;   /* (n_rows + 1), ascending from the base; a row may be empty. NULL only for 0 rows */
  const void *columns;   /* (offsets[n_rows] - base), in any order; repetitions and the node itself are ignored */
  int32_t offset_bits;   /* of offsets */
  int32_t column_bits;   /* of columns */
  int32_t index_base;    /* of both offsets and columns */
  int32_t reserved;      /* 0 */
} riis_csr;
RIIS_API riis_status riis_csr_init(riis_csr *csr, int64_t struct_size); /* the defaults */

/* Gives the mesh the adjacency that the neighbour search walks along, and checks it once.
 *   csr  its arrays are borrowed: they must stay in place, unchanged, until the handle is destroyed or gets another
 *        adjacency. NULL removes the adjacency, and so does riis_mesh_update with another n_nodes
 * Errors: RIIS_INVALID_MESH naming the row and its value. */
RIIS_API riis_status riis_mesh_set_adjacency(riis_mesh *mesh, const riis_csr *csr);

/* ---- Adjacency from cells, faces, or a structured grid ------------------------------------------------- */

/* Compressed sparse rows that the library owns: ascending columns without repetition, symmetric, base 0. */
typedef struct riis_adjacency riis_adjacency;

/* Cells by their nodes, in the order of VTK, Abaqus, CGNS and Gmsh: the base, then the apex or the nodes above.
 * The number of nodes tells the shape: 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron. */
typedef struct riis_mesh_cells {
  int64_t struct_size;     /* set by the init function */
  int64_t n_nodes;         /* of the mesh, >= 0 */
  int64_t n_cells;         /* >= 0 */
  const void *node_ids;    /* the nodes of cell after cell; NULL only without cells */
  const void *offsets;     /* (n_cells + 1), ascending from 0 or from index_base: where each cell begins in
                              node_ids, and where the last ends. NULL: nodes_per_cell for all cells */
  int32_t nodes_per_cell;  /* 4, 5, 6 or 8; not used with offsets. Default 4 */
  int32_t id_bits;         /* of node_ids and offsets */
  int32_t index_base;      /* of node_ids */
  int32_t n_threads;       /* default 0 */
} riis_mesh_cells;
RIIS_API riis_status riis_mesh_cells_init(riis_mesh_cells *cells, int64_t struct_size); /* the defaults */
/* Makes an adjacency of nodes from cells. Two nodes are neighbours if an edge of a cell joins them.
 * Errors: RIIS_INVALID_MESH naming the cell and its value. */
RIIS_API riis_status riis_adjacency_create_from_cells(const riis_mesh_cells *cells, riis_adjacency **adjacency);

/* Faces between cells, for codes that mark cell centres. */
typedef struct riis_mesh_faces {
  int64_t struct_size;     /* set by the init function */
  int64_t n_cells;         /* the number of cells, >= 0. The nodes of the mesh are cell centres */
  int64_t n_faces;         /* >= 0 */
  const void *owner;       /* face i joins the cells owner[i * stride] and neighbor[i * stride] */
  const void *neighbor;    /* the second cell; index_base - 1 (-1 or 0) for a face at the boundary, which joins nothing */
  int64_t stride;          /* entries from face to face, 1 to 1024: 1, the default, or 2 for face_cells(2, n_faces) */
  int32_t id_bits;         /* of owner and neighbor */
  int32_t index_base;      /* of owner and neighbor */
  int32_t n_threads;       /* default 0 */
  int32_t reserved;        /* 0 */
} riis_mesh_faces;
RIIS_API riis_status riis_mesh_faces_init(riis_mesh_faces *faces, int64_t struct_size); /* the defaults */
/* Makes an adjacency of cells from faces. Two cells are neighbours if they have a common face.
 * Errors: RIIS_INVALID_MESH naming the face and the owner or neighbor that is no cell. */
RIIS_API riis_status riis_adjacency_create_from_faces(const riis_mesh_faces *faces, riis_adjacency **adjacency);

/* Makes the adjacency of a structured grid. Neighbours differ by 1 in one of i, j, k.
 *   ni, nj, nk  each >= 1; node (i, j, k) has the number i + ni (j + nj k), all from 0
 * Errors: RIIS_LIMIT_EXCEEDED for more nodes than memory can hold. */
RIIS_API riis_status riis_adjacency_create_from_grid(int64_t ni, int64_t nj, int64_t nk, int32_t n_threads,
                                                     riis_adjacency **adjacency);
/* Gives the rows as riis_mesh_set_adjacency takes them. The arrays belong to the adjacency: int64_t offsets, and
 * columns of column_bits, which is 32 for fewer than 2^31 nodes, else 64. */
RIIS_API riis_status riis_adjacency_get_csr(const riis_adjacency *adjacency, riis_csr *csr,
                                            int64_t struct_size);
/* Destroys the adjacency and its arrays. Destroy the mesh that borrows them first. */
RIIS_API void riis_adjacency_destroy(riis_adjacency **adjacency);

/* ---- Marking (paper, 4.2) ------------------------------------------------------------------------------ */

/* The nodes that a marking found. Make one object and reuse it every step, because it keeps its memory. */
typedef struct riis_marks riis_marks;
/* Makes empty marks. They belong to no mesh and no surface. */
RIIS_API riis_status riis_marks_create(riis_marks **marks);
RIIS_API void riis_marks_destroy(riis_marks **marks); /* destroys the marks and their lists */

/* How nodes are searched. All but RIIS_SEARCH_PAPER find the same nodes (docs/theory.md, section 7). */
enum {
  RIIS_SEARCH_AUTO = 0,       /* clusters, with three exceptions that take the exhaustive search: distances by sampling or
                                 minimisation; the first marking of a mesh without riis_mesh_prepare, if the distance
                                 limit is at most a fifth of the surface's extent; a larger limit with few nodes */
  RIIS_SEARCH_EXHAUSTIVE = 1, /* queries every node (paper, algorithm "Exhaustive node iteration") */
  RIIS_SEARCH_NEIGHBOR = 2,   /* walks from marked nodes to their neighbours (paper, algorithm "Recursive
                                 neighbor search") and queries every other node that it cannot prove to be far. The
                                 mesh must have an adjacency, which need not be connected */
  RIIS_SEARCH_PAPER = 3,      /* the paper's algorithm to the letter, for comparison: it misses nodes that are not
                                 connected to its one starting node. The mesh must have an adjacency */
  RIIS_SEARCH_CLUSTERS = 4    /* filters clusters of nodes in single precision, and decides in double precision.
                                 The exhaustive search runs instead (stats.search) for 2^32 nodes and more, and if
                                 the mesh or its distance from the surface is a million times the size of the
                                 surface */
};

/* The processor's instructions that a marking uses. The results are bitwise the same with all of them. */
enum {
  RIIS_INSTRUCTIONS_AUTO = 0,     /* the best available */
  RIIS_INSTRUCTIONS_BASELINE = 1, /* available on every processor that the library was built for: SSE2 on x86-64 */
  RIIS_INSTRUCTIONS_AVX2 = 2,     /* AVX2 and FMA */
  RIIS_INSTRUCTIONS_AVX512 = 3    /* AVX-512 F, DQ, BW and VL */
};

/* Fields of the closest point that a marking keeps on request. Add the values to request several. Distances by
 * sampling or minimisation have RIIS_FIELD_POINT, RIIS_FIELD_NORMAL and RIIS_FIELD_PATCH only. */
enum {
  RIIS_FIELD_POINT = 1,      /* riis_mark_list.point */
  RIIS_FIELD_NORMAL = 2,     /* riis_mark_list.normal */
  RIIS_FIELD_BARYCENTRIC = 4, /* riis_mark_list.barycentric */
  RIIS_FIELD_SIDE = 8,       /* riis_mark_list.side */
  RIIS_FIELD_RIM = 16,       /* riis_mark_list.rim */
  RIIS_FIELD_UV = 32,        /* riis_mark_list.uv; refused for surfaces from arrays */
  RIIS_FIELD_VELOCITY = 64,  /* riis_mark_list.velocity; refused unless the last update gave velocities */
  RIIS_FIELD_PATCH = 128,    /* riis_mark_list.patch_id */
  RIIS_FIELD_GRADIENT = 256  /* riis_mark_list.distance_gradient, and K_gradient with a resistance; refused unless the
                                surface has directions (riis_surface_add_direction) */
};

/* How the band around the surface ends at its rim. */
enum {
  RIIS_RIM_ROUND = 0, /* half a tube around the rim: every node within the half thickness resists */
  RIIS_RIM_CUT = 1    /* no half tube: nodes whose closest point is on the rim do not resist */
};

/* The term K (u - u_surface) of the momentum equation, with the fluid velocity u and the surface velocity u_surface
 * (paper, 2.1; docs/theory.md, "Resistance"). At a distance d < eps, K = (R / eps) delta(d) with
 * delta(d) = (1 + cos(pi d / eps)) / (2 eps). At larger distances K is 0. */
typedef struct riis_resistance {
  int64_t struct_size;   /* set by the init function */
  double R;              /* 0 to 1e60, mass / (length time): kg/(m s). A flat closed valve in a flow of
                            velocity u has a pressure drop of (R / eps) u. Default NaN, which is refused */
  double half_thickness; /* eps, 1e-50 to the distance limit. Default RIIS_AUTO: the marking's half thickness */
  int32_t rim;           /* RIIS_RIM_*, default RIIS_RIM_ROUND */
  int32_t reserved;      /* 0 */
} riis_resistance;
RIIS_API riis_status riis_resistance_init(riis_resistance *resistance, int64_t struct_size); /* the defaults */

/* Options of a marking. */
typedef struct riis_mark_options {
  int64_t struct_size;       /* set by the init function */
  double distance_limit;     /* the search finds nodes up to this distance; half thickness to 1e60. Default
                                RIIS_AUTO: the half thickness. The limit does not change which nodes are marked */
  const uint8_t *node_mask;  /* (n_nodes): nodes with 0 are left out, but must be finite. NULL: all nodes */
  const riis_resistance *resistance; /* requests riis_mark_list.K and, if the last update of the surface gave
                                        velocities, riis_mark_list.K_u_surface. Default NULL: neither */
  int32_t fields;            /* a sum of RIIS_FIELD_*, for the nodes of riis_mark_list. Default 0 */
  int32_t search;            /* RIIS_SEARCH_*, default RIIS_SEARCH_AUTO */
  int32_t n_threads;         /* default 0 */
  int32_t instructions;      /* RIIS_INSTRUCTIONS_*, for tests and measurements; default
                                RIIS_INSTRUCTIONS_AUTO. RIIS_UNAVAILABLE if the processor lacks them.
                                Distances by sampling or minimisation use RIIS_INSTRUCTIONS_BASELINE */
} riis_mark_options;
RIIS_API riis_status riis_mark_options_init(riis_mark_options *options, int64_t struct_size); /* the defaults */

/* Finds every node near the surface: at most the half thickness away (marked), or at most the distance limit. The
 * reported distance, in double precision, decides.
 *   marks  its content is replaced
 * The log warns if the largest sides of the boxes of mesh and surface differ by more than a factor of 50, or if one is
 * less than the half thickness. It warns once per surface and mesh, at most eight times per mesh, and never for fewer
 * than 1000 nodes.
 * Errors: RIIS_INVALID_MESH for a coordinate that became non-finite after it was given. */
RIIS_API riis_status riis_mark_nodes(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_mark_options *options, riis_marks *marks);

/* The lists of a marking. */
enum {
  RIIS_LIST_MARKED = 0,      /* the nodes within the half thickness */
  RIIS_LIST_WITHIN_LIMIT = 1 /* the nodes within the distance limit, marked or not */
};
/* A list of nodes, ascending by node_id. Lengths are in mesh units. The arrays from `point` on are NULL unless
 * options.fields requested them. Values equal those of riis_closest_point to the last bit. */
typedef struct riis_mark_list {
  int64_t n_nodes;            /* in the list */
  const int64_t *node_id;     /* (n_nodes) */
  const double *distance;     /* (n_nodes) */
  const int64_t *triangle_id; /* (n_nodes): of the closest triangle, as in riis_closest */
  const int32_t *leaflet_id;  /* (n_nodes): of that triangle */
  const double *K;            /* (n_nodes): K by options.resistance; NULL without a resistance */
  const double *K_u_surface;  /* (3, n_nodes): K u_surface; NULL without a resistance or velocities */
  const double *point;        /* (3, n_nodes): the closest point of the surface */
  const double *normal;       /* (3, n_nodes): the unit normal of its triangle */
  const double *barycentric;  /* (3, n_nodes): the point's weights for the triangle's vertices */
  const double *uv;           /* (2, n_nodes): the point's u and v on its patch, in [0,1]. S_u x S_v points along
                                 the normal, but against it on mirrored patches (cusps: patch_id % 4 >= 2;
                                 mitral: 3, 4, 5, 8, 9). With flipped normals it is the reverse */
  const double *velocity;     /* (3, n_nodes): the velocity of the surface at the point, from its last update.
                                 If several leaflets are equally near (within 1e-6 half thicknesses), or several
                                 patches of one leaflet (within 1e-9), it is the mean of the velocities at their
                                 closest points (docs/theory.md, section 10). Other fields are those of one triangle */
  const int32_t *side;        /* (n_nodes): as riis_closest.side */
  const int32_t *rim;         /* (n_nodes): 1 if the point lies on the rim of the surface, else 0. The rim of a valve
                                 has the sides that only one patch has, such as free edges and the annulus. Free edges
                                 that coincide when closed are not rim. The rim of a surface from arrays has the edges
                                 that only one triangle has; vertices with equal coordinates count as one */
  const int32_t *patch_id;    /* (n_nodes): as in riis_triangles */
  int64_t n_directions;       /* the surface's directions during the marking; 0 without RIIS_FIELD_GRADIENT */
  const double *distance_gradient; /* (n_directions, n_nodes): the derivative of the distance in each direction, -n.V. The
                                 unit vector n points from the closest point to the node, whatever the side, and V is the
                                 rate of the closest point on the triangle of triangle_id. 0 on the surface, where the
                                 distance has a kink. If several places are equally near, the distance has a kink, too */
  const double *K_gradient;   /* (n_directions, n_nodes): the derivative of K for constant R and half thickness. It is 0
                                 where K is 0; NULL without a resistance */
} riis_mark_list;
/* Gives a list of the last marking, until the next riis_mark_nodes with these marks or their destruction.
 *   which  RIIS_LIST_* */
RIIS_API riis_status riis_marks_get_list(const riis_marks *marks, int32_t which, riis_mark_list *list,
                                         int64_t struct_size);

/* The caller's arrays (n_nodes) with an entry for each node of the mesh; NULL for arrays that are not wanted. */
typedef struct riis_dense_arrays {
  int64_t struct_size;  /* set by the init function */
  int64_t n_nodes;      /* the number of nodes of the marking, 0 for empty marks */
  double far_distance;  /* the distance of nodes beyond the limit or masked out: NaN, or any value outside
                           [0, distance limit]. Default RIIS_FAR_DISTANCE */
  uint8_t *mark;        /* 1 for marked nodes, 0 for others */
  double *distance;     /* the distance of nodes within the distance limit, far_distance for others */
  int64_t *triangle_id; /* the closest triangle of nodes within the distance limit, -1 for others */
  int32_t *leaflet_id;  /* the leaflet of this triangle, -1 for others */
} riis_dense_arrays;
RIIS_API riis_status riis_dense_arrays_init(riis_dense_arrays *arrays, int64_t struct_size); /* the defaults */
/* Writes the marks to every entry of the caller's arrays.
 * Errors: RIIS_INVALID_ARGUMENT naming the field. */
RIIS_API riis_status riis_marks_get_dense(const riis_marks *marks, const riis_dense_arrays *arrays);

/* How the last marking went. */
typedef struct riis_mark_stats {
  int64_t n_nodes;      /* of the mesh, masked out or not */
  int64_t n_marked;     /* nodes within the half thickness */
  int64_t n_within_limit; /* nodes within the distance limit, marked or not */
  int64_t n_queries;    /* number of closest-point queries, of nodes and of parts of the mesh */
  double seconds;       /* wall time of riis_mark_nodes */
  int32_t search;       /* the search that ran, never RIIS_SEARCH_AUTO */
  int32_t n_threads;    /* the largest number of threads in any part. A caller's TBB limit affects walks, not loops */
  int32_t complete;     /* 1: every node within the limit was found, for the coordinates last given; 0: not certain */
  int32_t instructions; /* the instructions that were used, never RIIS_INSTRUCTIONS_AUTO */
  int64_t n_unreached;  /* nodes within the limit that the neighbour search found by its proof, not by its walk */
} riis_mark_stats;
/* Tells how the last marking with the marks went; all 0 for empty marks. */
RIIS_API riis_status riis_marks_get_stats(const riis_marks *marks, riis_mark_stats *stats, int64_t struct_size);

/* ---- Resistance: K and K u_surface in the caller's arrays, and sums of a flow around the surface ------- */

/* The caller's arrays with an entry for each node of the mesh, to which K and K u_surface are added. */
typedef struct riis_resistance_arrays {
  int64_t struct_size;         /* set by the init function */
  int64_t n_nodes;             /* the number of nodes of the marking */
  double *K;                   /* (n_nodes) by K_stride; NULL if not wanted */
  int64_t K_stride;            /* default 1 */
  double *K_u_surface[3];      /* (n_nodes) by K_u_surface_stride, for x, y and z; all NULL if not wanted */
  int64_t K_u_surface_stride;  /* numbers from node to node: default 1; 3 for xyz(3,n) with {xyz, xyz + 1, xyz + 2} */
} riis_resistance_arrays;
/* Fills *arrays with the defaults. */
RIIS_API riis_status riis_resistance_arrays_init(riis_resistance_arrays *arrays, int64_t struct_size);
/* Adds K and K u_surface to the caller's arrays, which then hold sums over several valves. The solver's term is
 * (sum of K) u - (sum of K u_surface). Nodes may be cell centres or quadrature points. riis_mark_list also has both.
 *   resistance  RIIS_RIM_CUT needs RIIS_FIELD_RIM, and K_u_surface needs RIIS_FIELD_VELOCITY
 * Errors: RIIS_INVALID_ARGUMENT also for marks that no marking has filled, and for a field that they lack. */
RIIS_API riis_status riis_marks_add_resistance(const riis_marks *marks, const riis_resistance *resistance,
                                               const riis_resistance_arrays *arrays);

/* The flow at the nodes, in the caller's arrays. */
typedef struct riis_flow_arrays {
  int64_t struct_size;       /* set by the init function */
  int64_t n_nodes;           /* the number of nodes of the marking */
  const double *velocity[3]; /* (n_nodes) by velocity_stride, for x, y and z; NULL only for 0 nodes */
  int64_t velocity_stride;   /* default 1; 3 for u(3,n) with {u, u + 1, u + 2} */
  const double *weight;      /* (n_nodes), volume around a node, 0 for nodes of other ranks; NULL only for 0 nodes */
} riis_flow_arrays;
RIIS_API riis_status riis_flow_arrays_init(riis_flow_arrays *flow, int64_t struct_size); /* the defaults */
/* The caller's arrays for the forces and moments of the flow, which are added to them. NULL leaves a sum out. The arrays
 * must not overlap. A node's force is weight K (velocity - u_surface), and acts at the node's closest point. The power of
 * a rigid surface is therefore force times velocity plus moment times angular velocity. */
typedef struct riis_reaction {
  int64_t struct_size;      /* set by the init function */
  double about[3];          /* the reference point of moment and leaflet_moment; magnitude at most 1e60.
                               Default 0 */
  double *force;            /* (3): force on the whole surface, in the unit of weight K velocity, N in SI units */
  double *moment;           /* (3): moment on the whole surface */
  int64_t n_leaflets;       /* the number of columns in both sums of leaflets, which alone use it: more than
                               riis_surface_info.largest_leaflet_id. Default 0 */
  double *leaflet_force;    /* (3, n_leaflets): force on each leaflet. A node belongs to the leaflet in
                               riis_mark_list.leaflet_id, also if two leaflets are equally near */
  double *leaflet_moment;   /* (3, n_leaflets): moment on each leaflet */
  int64_t n_edges;          /* number of edges, at least 1 if edge_force or edge_moment is given; else unused. Default 0 */
  const double *edges;      /* (3, 2, n_edges): both ends of each edge, for example riis_attachment.edges;
                               magnitude at most 1e60. An edge may have length 0 */
  const int32_t *edge_leaflet_id; /* (n_edges), >= 0: a node counts for the nearest edge of its leaflet, and each
                               leaflet needs an edge. NULL, the default: it counts for the nearest of all edges */
  double *edge_force;       /* (3, n_edges): force of the nodes that count for the edge. Distances are those of a
                               node's closest point. If edges are equally near, the first one counts */
  double *edge_moment;      /* (3, n_edges): moment of the same nodes about the middle of the edge */
} riis_reaction;
/* Fills *reaction with the defaults. */
RIIS_API riis_status riis_reaction_init(riis_reaction *reaction, int64_t struct_size);
/* Adds the force of the flow on the surface, and its moment, for the whole surface, each leaflet and each edge.
 *   flow      u and the volumes; u_surface is 0 if the marking lacked RIIS_FIELD_VELOCITY
 *   reaction  moments and sums of edges need RIIS_FIELD_POINT
 * Each result is a plain sum over nodes. With MPI all ranks pass the same points and edges, and add up their sums. The sums
 * of leaflets add up to the sum of the whole, up to rounding. The sums of edges are loads for tissue codes. They do not
 * model how a membrane carries loads to its edges. A node takes a time of order log n_edges, or of order n_edges if all
 * edges are equally near.
 * The force on a valve at rest is right. The force on a moving valve includes the inertia of the blood in the band. A scheme
 * with K at its faces then needs a source in its pressure equation, or the force is wrong by newtons. Cells that are bounded
 * only by walls and by faces with K dt > rho get the flow of u_surface out through these faces (docs/solvers.md, "The source
 * in the band"). Finite elements have the same fault for K dt > rho, and no source was found for them.
 * Errors: as riis_marks_add_resistance; RIIS_INVALID_ARGUMENT also for an n_leaflets that is too small, naming the
 * leaflet id, for a leaflet without edge, for a bad edge, and for a reaction without any sum. */
RIIS_API riis_status riis_marks_add_reaction(const riis_marks *marks, const riis_resistance *resistance,
                                             const riis_flow_arrays *flow, const riis_reaction *reaction);

/* Sums over the nodes on either side of the surface: entry 0 is upstream (side -1), entry 1 is downstream. The
 * mean is sum / weight; with MPI, add up the sums and weights of all ranks first. */
typedef struct riis_band_sums {
  double sum[2];      /* the sum of weight * value */
  double weight[2];   /* the sum of weight */
  int64_t n_nodes[2]; /* nodes in the band */
} riis_band_sums;
/* A band around the surface, and a value at the nodes. */
typedef struct riis_band {
  int64_t struct_size;  /* set by the init function */
  double inner, outer;  /* distances, 0 <= inner <= outer <= distance limit of the marking. Default 0 */
  int64_t n_nodes;      /* the number of nodes of the marking, which must have RIIS_FIELD_SIDE and RIIS_FIELD_RIM */
  const double *value;  /* (n_nodes), such as the pressure; NULL only for 0 nodes */
  const double *weight; /* (n_nodes), volume around a node, 0 for nodes of other ranks; NULL only for 0 nodes */
} riis_band;
RIIS_API riis_status riis_band_init(riis_band *band, int64_t struct_size); /* the defaults */
/* Gives the sums of the value over the nodes in the band, by side. Nodes whose closest point is on the rim are
 * left out, and so are nodes on neither side. With an open valve the two sides have no meaning.
 * Errors: RIIS_INVALID_ARGUMENT also for a field that the marks lack. */
RIIS_API riis_status riis_marks_get_band_sums(const riis_marks *marks, const riis_band *band,
                                              riis_band_sums *sums, int64_t struct_size);

/* ---- Leaks: where the mesh is too coarse for the marks to close the surface (docs/meshes.md) ----------- */

/* The edges that riis_find_leaks found. Make one object and reuse it. */
typedef struct riis_leaks riis_leaks;
RIIS_API riis_status riis_leaks_create(riis_leaks **leaks); /* makes leaks without an edge */
RIIS_API void riis_leaks_destroy(riis_leaks **leaks); /* destroys the leaks and their list */

/* Finds every edge of the mesh's adjacency that joins two unmarked nodes and crosses or touches a triangle of the surface.
 *   surface, mesh  the surface and the mesh of the marking. The mesh must have an adjacency
 *   marks          marks from riis_mark_nodes
 *   options        the options of the marking. An edge to a node that node_mask leaves out does not leak
 *   leaks          its content is replaced
 * The decision is exact for coordinates in double precision; coordinates below 1e-90 count as 0. An edge may be given in one
 * row or in both, and is listed once. Edges to ghosts are ignored. Edges that are at most two half thicknesses long do not
 * leak (docs/meshes.md). A marking of the same triangles with the half thickness of riis_leak_list closes all of these edges,
 * except by RIIS_SEARCH_PAPER. But riis_surface_update with that half thickness moves a valve's triangles by up to
 * tolerance * half_thickness, so search again after it.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, and for marks that no marking has filled, or that
 * have another number of nodes or half thickness; RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_marks *marks, const riis_mark_options *options,
                                     riis_leaks *leaks);

/* Mesh edges that leak, ascending by their first node, then by their second. Lengths are in mesh units. */
typedef struct riis_leak_list {
  int64_t n_edges;            /* edges that leak. If 0, node ids are -1 and all other fields but seconds are 0 */
  const int64_t *node_id;     /* (2, n_edges): the two nodes, the lower id first */
  const double *length;       /* (n_edges) */
  const double *distance;     /* (n_edges): the distance of the edge's nearer node, a half thickness that closes it */
  double half_thickness;      /* the smallest half thickness that gives each edge a marked node, for these triangles */
  int64_t longest_node_id[2]; /* the nodes of the longest edge, ascending. It is the first one of equally long edges */
  double longest_length;      /* the length of this edge */
  double longest_middle[3];   /* the middle of this edge */
  double seconds;             /* wall time of riis_find_leaks */
} riis_leak_list;
/* Gives the edges of the last riis_find_leaks, until the next riis_find_leaks with these leaks. */
RIIS_API riis_status riis_leaks_get_list(const riis_leaks *leaks, riis_leak_list *list, int64_t struct_size);

/* ---- Open regions and passages: whether the unmarked nodes connect two regions (docs/meshes.md) -------- */

/* Labels the open regions: the connected components of the nodes that a marking left unmarked, along mesh edges.
 *   mesh       the mesh of the marking, with an adjacency
 *   marks      marks from riis_mark_nodes
 *   options    the options of the marking; nodes that node_mask leaves out are in no region
 *   n_nodes    the number of nodes of the marking
 *   label      (n_nodes), the lowest node id of the node's region, -1 for nodes in no region
 *   n_regions  the number of regions; may be NULL
 * An edge may be given in one row or in both. Edges to ghosts are ignored: with MPI, ranks must exchange their labels
 * (examples/mpi_leaks.c).
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, and for marks that no marking has filled, or that
 * have another number of nodes. */
RIIS_API riis_status riis_label_open_regions(const riis_mesh *mesh, const riis_marks *marks,
                                             const riis_mark_options *options, int64_t n_nodes, int64_t *label,
                                             int64_t *n_regions);

/* Whether there is a passage between two sets of nodes. */
enum {
  RIIS_PASSAGE_CLOSED = 0, /* no: each path between the sets has a node within the half thickness */
  RIIS_PASSAGE_OPEN = 1,   /* yes: some path has no node within the half thickness */
  RIIS_PASSAGE_NONE = 2    /* no: the mesh itself has no path between the sets */
};
/* The widest passage from one set of nodes to another: the path whose least distance from the surface is largest. */
typedef struct riis_passage {
  int64_t node_id;  /* the path's node that is nearest to the surface; -1 without a path. Of nodes at equal
                       distances, the one with the higher id counts as nearest */
  double distance;  /* the distance of node_id. A half thickness closes the passage, for these triangles, if it
                       is at least this distance; a smaller one leaves it open. 0 without a path */
  double point[3];  /* the coordinates of node_id; 0 without a path */
  double seconds;   /* wall time of riis_find_passage */
  int32_t state;    /* RIIS_PASSAGE_* */
  int32_t reserved; /* 0 */
} riis_passage;
/* The two sets of nodes that a passage joins. */
typedef struct riis_passage_ends {
  int64_t struct_size; /* set by the init function */
  int64_t n_from;      /* at least 1 */
  const int64_t *from; /* (n_from), node ids in any order: where paths begin */
  int64_t n_to;        /* at least 1 */
  const int64_t *to;   /* (n_to), node ids in any order: where paths end. A node in both sets is a path by itself */
} riis_passage_ends;
RIIS_API riis_status riis_passage_ends_init(riis_passage_ends *ends, int64_t struct_size); /* the defaults */
/* Finds the widest passage along the edges of the mesh's adjacency, whether it is open or closed.
 *   mesh     with an adjacency; it need not have been marked
 *   ends     farther from the surface than the passage is wide, because paths include their ends
 *   options  only node_mask, n_threads and instructions are used. A node that node_mask leaves out is on no path
 * A new half thickness moves a valve's triangles by up to tolerance * half_thickness: search again after
 * riis_surface_update.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, and for a node of from or to that the mesh lacks,
 * that node_mask leaves out, or that is within the half thickness; RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_passage(const riis_surface *surface, const riis_mesh *mesh,
                                       const riis_passage_ends *ends, const riis_mark_options *options,
                                       riis_passage *passage, int64_t struct_size);

/* ---- Measures: what a valve means for the flow --------------------------------------------------------- */

/* A leaflet of a surface. Lengths are in mesh units. */
typedef struct riis_leaflet {
  int64_t n_triangles; /* the number of its triangles that answer queries */
  double area;         /* the area of its triangles */
  double free_edge;    /* the length of its free edge: the sides v = 1 that only one of its patches has. Of a surface
                          from arrays: the edges that only one of its triangles has, without the outline of
                          riis_orifice. 0 for a skirt */
  int32_t leaflet_id;  /* as in riis_triangles */
  int32_t reserved;    /* 0 */
} riis_leaflet;
/* Gives the number of the surface's leaflets. */
RIIS_API riis_status riis_surface_get_n_leaflets(const riis_surface *surface, int64_t *n_leaflets);
/* Gives the sizes of a leaflet.
 *   leaflet  0 to n_leaflets - 1, ascending by leaflet_id */
RIIS_API riis_status riis_surface_get_leaflet(const riis_surface *surface, int64_t leaflet, riis_leaflet *sizes,
                                              int64_t struct_size);

/* The outline of an orifice. */
enum {
  RIIS_OUTLINE_NONE = 0,      /* no disc, and the sides v = 0 that only one patch has, or the open edges of a surface
                                 from arrays or keyframes, enclose no area */
  RIIS_OUTLINE_DISC = 1,      /* the disc of root_radius (three cusps) or radius (bileaflet) about the axis */
  RIIS_OUTLINE_ATTACHMENT = 2, /* the sides v = 0 that only one patch has: the annulus of the mitral valve */
  RIIS_OUTLINE_BOUNDARY = 3   /* a surface from arrays or keyframes: the longest closed line of edges that only one
                                 triangle has */
};
/* The orifice of a surface: the part of an outline that the triangles do not cover, seen along an axis. The axis of a valve
 * is its z axis, placed. Its skirt does not count. The axis of arrays and keyframes is the vector area of the outline, towards
 * the side to which normals point. Lengths are in mesh units (docs/theory.md, section 15). */
typedef struct riis_orifice {
  double area;           /* the area of the orifice. Without an outline only axis and rim_reach differ from 0 */
  double outline_area;   /* the area inside the outline */
  double perimeter;      /* the length of the orifice's edge along the triangles. The edge is first moved inwards by
                            a tenth of the half thickness, so that narrower slits do not count. Parts of the edge
                            on the outline are walls and do not count */
  double effective_area; /* the area that the band around the valve leaves to the flow. The edge along the triangles
                            is moved inwards by rim_reach * half_thickness. To first order the result is area -
                            rim_reach * half_thickness * perimeter. It is never below 0 */
  double rim_reach;      /* the factor c: 0.84 for a round rim, 0.70 for a cut rim. Flows through open valves gave 0.70
                            to 0.98 (round) and 0.46 to 0.95 (cut); see docs/validation.md */
  double half_thickness; /* eps of the resistance */
  double radius;         /* the radius of the disc, or of a circle as large as a warped disc; 0 for other outlines */
  double axis[3];        /* unit vector; of a warped disc its normal; 0 for arrays and keyframes without an outline */
  int32_t outline;       /* RIIS_OUTLINE_* */
  int32_t reserved;      /* 0 */
} riis_orifice;
/* Measures the orifice of a surface.
 *   resistance  only half_thickness and rim are used. RIIS_AUTO stands for the surface's half thickness. NULL
 *               stands for the defaults */
RIIS_API riis_status riis_surface_get_orifice(const riis_surface *surface, const riis_resistance *resistance,
                                              riis_orifice *orifice, int64_t struct_size);

/* A value for an argument leaflet_id. */
enum {
  RIIS_ALL_LEAFLETS = -1 /* the sum over all leaflets, without a skirt */
};
/* The coaptation of a surface's leaflets: the parts that touch another leaflet. Lengths are in mesh units. */
typedef struct riis_coaptation {
  double area;  /* the area of the points of the leaflet's triangles that lie within reach of another leaflet */
  double edge;  /* the length of the part of its free edge (riis_leaflet) within reach of another leaflet */
  double reach; /* the distance within which leaflets touch */
} riis_coaptation;
/* Measures the coaptation. The bileaflet housing and a skirt are no leaflets, and touch nothing.
 *   reach       1e-50 to 1e50. RIIS_AUTO stands for the surface's half thickness
 *   leaflet_id  as in riis_triangles, or RIIS_ALL_LEAFLETS for the sum over all leaflets, which counts a contact from
 *               both sides
 * Areas are right to 1e-3 of the contact's outline times reach (docs/theory.md, section 15). The extent of a surface is the
 * diagonal of its box. If the reach is below 1/250 of the extent, details below 1/2000 of the extent are lost.
 * Errors: RIIS_INVALID_ARGUMENT for a leaflet that the surface lacks, and for a reach out of range. */
RIIS_API riis_status riis_surface_get_coaptation(const riis_surface *surface, double reach, int32_t leaflet_id,
                                                 riis_coaptation *coaptation, int64_t struct_size);

/* Gives the ideal leak of a closed surface: the volume flow drop * (eps / R) * area that a pressure drop causes. The
 * bileaflet housing does not count in the area. The leak in a solver differs from the ideal (docs/solvers.md).
 *   resistance  only R, 1e-60 to 1e60, and half_thickness are used. RIIS_AUTO stands for the surface's half thickness
 *   drop        upstream pressure minus downstream pressure, magnitude at most 1e30
 *   flow        in the unit of drop * area * eps / R, which is m^3/s in SI units
 * Errors: RIIS_INVALID_ARGUMENT naming the field or argument and its value. */
RIIS_API riis_status riis_surface_get_leak(const riis_surface *surface, const riis_resistance *resistance,
                                           double drop, double *flow);

/* Options of riis_find_first_passage. */
typedef struct riis_first_passage_options {
  int64_t struct_size;                 /* set by the init function */
  const riis_surface_options *surface; /* options of the valve's surface. NULL, the default, stands for defaults */
  const riis_mark_options *marking;    /* options of riis_find_passage. NULL, the default, stands for defaults */
  double tolerance;                    /* tolerance of the opening, 1e-6 to 1. Default 1e-3 */
} riis_first_passage_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_first_passage_options_init(riis_first_passage_options *options, int64_t struct_size);
/* The result of riis_find_first_passage. */
enum {
  RIIS_FIRST_PASSAGE_FOUND = 0,  /* the valve closes the mesh at opening 0, and opens it later */
  RIIS_FIRST_PASSAGE_ALWAYS = 1, /* there is a passage at opening 0 */
  RIIS_FIRST_PASSAGE_NEVER = 2,  /* no opening that was tried has a passage */
  RIIS_FIRST_PASSAGE_NONE = 3    /* the mesh itself has no path */
};
/* The opening at which a valve first lets the mesh pass. */
typedef struct riis_first_passage {
  double opening;        /* the first opening with a passage; 0 for ALWAYS, 1 for NEVER, 0 for NONE */
  double closed_opening; /* FOUND: the largest tried opening below `opening`, which has no passage. Else: `opening` */
  int64_t node_id;       /* the passage at `opening`, as in riis_passage */
  double distance;       /* as in riis_passage */
  double point[3];       /* as in riis_passage */
  double seconds;        /* wall time of riis_find_first_passage */
  int32_t n_openings;    /* the number of openings tried */
  int32_t state;         /* RIIS_FIRST_PASSAGE_* */
} riis_first_passage;
/* Finds the opening at which riis_find_passage first finds a passage.
 *   valve  its own opening is ignored
 *   mesh   must have an adjacency, and need not have been marked
 *   ends   as for riis_find_passage; each end must be outside the band at each tried opening
 * The call tries 0, 1/8, 2/8, ... until a passage is open. It then halves the last step until opening and closed_opening
 * differ by at most the tolerance. A passage may close again as the valve opens further. So the call may miss a passage that
 * ends before the next multiple of 1/8.
 * Errors: the errors of riis_surface_create and riis_find_passage, with the opening. RIIS_INVALID_PARAMETER for a
 * valve with only one state. */
RIIS_API riis_status riis_find_first_passage(const riis_valve *valve, const riis_mesh *mesh,
                                             const riis_passage_ends *ends,
                                             const riis_first_passage_options *options,
                                             riis_first_passage *first, int64_t struct_size);

/* The number of mesh edges across the band, from the lengths of the mesh edges with a marked node. */
typedef struct riis_cells_across {
  double least, mean, most; /* 2 * half_thickness over the longest, the mean and the shortest length */
  double shortest_edge, mean_edge, longest_edge; /* the lengths of the mesh edges with a marked node */
  double half_thickness; /* the half thickness of the marking */
  int64_t n_edges;       /* edges with at least one marked node. If it is 0, only half_thickness differs from 0 */
} riis_cells_across;
/* Computes the number of mesh edges across the band. An edge counts once, whether one or both of its nodes list it. Edges to
 * ghosts and edges of length 0 do not count.
 *   marks  marks from riis_mark_nodes
 *   mesh   the mesh of the marking, with an adjacency
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, for empty marks, and for marks with another number of
 * nodes; RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_marks_get_cells_across(const riis_marks *marks, const riis_mesh *mesh,
                                                 riis_cells_across *cells, int64_t struct_size);

/* Gives the volume that the valve sweeps between two openings, in mesh units cubed. It is the integral of u_surface . n over
 * surface and time, positive along the normals. A flow displaces less, because blood slips past the leaflets.
 *   opening_from, opening_to  0 to 1. The valve's own opening is ignored
 *   options     only scale, flip_normals and n_threads are used. NULL stands for the defaults
 *   leaflet_id  RIIS_LEAFLET_*, or the id of a patch's leaflet, or RIIS_ALL_LEAFLETS
 * The result is within 1e-3 of the largest volume that a leaflet sweeps from 0 to 1 (docs/theory.md, section 15).
 * Errors: RIIS_INVALID_ARGUMENT for an opening out of range and for a leaflet that the valve lacks;
 * RIIS_INVALID_PARAMETER for inconsistent parameters, and for a valve with one state unless both are 0. */
RIIS_API riis_status riis_valve_get_swept_volume(const riis_valve *valve, double opening_from, double opening_to,
                                                 const riis_surface_options *options, int32_t leaflet_id,
                                                 double *volume);

/* ---- Landmarks: a valve's sizes and placement from points that a person marks in an image ----------------- */

/* The anatomy that a landmark marks, on the closed valve. */
enum {
  RIIS_LANDMARK_COMMISSURE = 0,     /* three cusps: the top of the attachment between two of them; exactly 3 */
  RIIS_LANDMARK_NADIR = 1,          /* three cusps: the lowest point of a cusp's attachment; exactly 3 */
  RIIS_LANDMARK_COAPTATION = 2,     /* three cusps: where the closed cusps meet; at most 1. The valve's axis
                                       passes through it; its height is not used */
  RIIS_LANDMARK_ANNULUS = 3,        /* mitral: a point of the annulus; 4 or more, in their order around it.
                                       bileaflet: a point of the housing's circle at mid-height; 3 or more */
  RIIS_LANDMARK_ANTERIOR_HORN = 4,  /* mitral: the annulus at the middle of the anterior leaflet; exactly 1 */
  RIIS_LANDMARK_POSTERIOR_HORN = 5, /* mitral: the annulus at the middle of the posterior leaflet; at most 1 */
  RIIS_LANDMARK_TRIGONE = 6,        /* mitral: the annulus at an end of IT_distance; at most 2 */
  RIIS_LANDMARK_POSTEROMEDIAL = 7,  /* mitral: the annulus at the posteromedial commissure; at most 1 */
  RIIS_LANDMARK_ANTEROLATERAL = 8,  /* mitral: the annulus at the anterolateral commissure; at most 1 */
  RIIS_LANDMARK_HINGE = 9,          /* bileaflet: an end of a leaflet's hinge line; 2 of one leaflet, or 4 */
  RIIS_LANDMARK_ATTACHMENT = 10     /* three cusps: a further point of the attachment; at most 900. The sizes and the
                                       placement do not depend on it: it is for a warp, by riis_placement_arrays.place */
};
/* Landmarks of a patient, in the caller's arrays. */
typedef struct riis_landmarks {
  int64_t struct_size;       /* set by the init function */
  int64_t n_landmarks;       /* 1 to 10,000 */
  const void *x, *y, *z;     /* (n_landmarks) by stride, in mesh units */
  int64_t stride;            /* of x, y and z. Default 1 */
  const int32_t *role;       /* (n_landmarks): RIIS_LANDMARK_* */
  const int32_t *leaflet_id; /* (2, n_landmarks): of a nadir or a point of the attachment, its cusp and -1; of a
                                commissure, its two cusps, in any order. -1 and -1: not known. NULL: all -1. Enough of
                                an aortic valve's must be known to name all. Without names, cusp 0 of three equal cusps
                                is at the first nadir */
  double scale;              /* mesh units in a centimetre: 10 for millimetres, 1, or 0.01 for metres. Must be set */
  double noise;              /* the scatter of the landmarks, each coordinate's standard deviation, mesh units, >= 0.
                                Default RIIS_AUTO: 0.03 * scale */
  double flow[3];            /* the direction of flow, of any length; default 0: not known. bileaflet: must be set.
                                mitral: needed if neither both commissures nor the horns show the atrium's side */
  int32_t real_bits;         /* of x, y and z */
  int32_t reserved;          /* 0 */
} riis_landmarks;
RIIS_API riis_status riis_landmarks_init(riis_landmarks *landmarks, int64_t struct_size); /* the defaults */

/* Where a parameter's value comes from. */
enum {
  RIIS_SIZE_KEPT = 0,        /* it is the valve's own */
  RIIS_SIZE_DETERMINED = 1,  /* the landmarks determine the parameter: its standard error at their noise moves the
                                valve by at most a fifteenth of its radius */
  RIIS_SIZE_TIED = 2,        /* no landmark bears on the parameter; other sizes give it by the valve's proportions */
  RIIS_SIZE_UNDETERMINED = 3 /* landmarks bear on the parameter but do not determine it; it tends to the proportions */
};
/* The placement that riis_place finds, for the fields of riis_surface_options with these names. */
typedef struct riis_placement {
  double scale;              /* the scale of the landmarks, which also gives the default half thickness of 0.1 cm */
  double rotation_axis[3];   /* unit vector */
  double rotation_angle;     /* degrees, 0 to 180 */
  double translation[3];     /* mesh units */
  double rms;                /* root mean square of the residuals, mesh units */
  double worst;              /* the largest residual, mesh units */
  double noise;              /* noise behind standard errors: that of the landmarks, or more if the residuals show more */
  double rotation_error;     /* standard error of the rotation, degrees */
  double position_error;     /* standard error of the place of the valve's origin, mesh units */
  int64_t worst_landmark_id; /* the landmark with the largest residual */
  int32_t n_undetermined;    /* the number of parameters with RIIS_SIZE_UNDETERMINED */
  int32_t reserved;          /* 0 */
} riis_placement;
/* The caller's arrays for the results of riis_place. NULL arrays, the default, are not written. */
typedef struct riis_placement_arrays {
  int64_t struct_size;       /* set by the init function */
  double *residual;          /* (n_landmarks): distances from the landmarks to their places, mesh units */
  double *standard_error;    /* (number of parameters, in the order of riis_valve_get_parameter), in the parameter's
                                unit; infinite for RIIS_SIZE_TIED, 0 for RIIS_SIZE_KEPT */
  int32_t *size_state;       /* (number of parameters): RIIS_SIZE_* */
  double *place;             /* (3, n_landmarks): the landmarks' places on the closed valve, mesh units: the sources of a
                                warp whose targets are the landmarks. A commissure's place is the mean of its cusps' ends.
                                A point of the attachment has the place that this warp, smoothed by the noise, takes
                                nearest to it */
} riis_placement_arrays;
RIIS_API riis_status riis_placement_arrays_init(riis_placement_arrays *arrays, int64_t struct_size); /* NULL arrays */
/* Sets a valve's sizes, in centimetres, to those of a patient, and finds its placement.
 *   valve   the template, a kind with any parameters: lengths that no landmark bears on keep their proportions. Translation
 *           and opening stay, and so does the open state of riis_valve_set_open_state
 *   held    names of parameters that keep the valve's values, separated by blanks or commas; "": none
 *   arrays  its arrays are written; NULL: not wanted
 * The result has the least squares of the distances between the landmarks and their places on the closed valve
 * (docs/theory.md, section 17). Rotations and leaflet angles of an aortic valve follow from the landmarks. A leaflet_power
 * that would make its cusps overlap is lowered.
 * Errors: RIIS_INVALID_ARGUMENT for landmarks that are missing, too many, in one place, collinear, mirrored, not those
 * of a heart valve at this scale, or that do not show the flow; the message names them. RIIS_INVALID_PARAMETER for a
 * valve from patches, an unknown name in held, and sizes that do not fit together. */
RIIS_API riis_status riis_place(riis_valve *valve, const riis_landmarks *landmarks, const char *held,
                                const riis_placement_arrays *arrays, riis_placement *placement,
                                int64_t struct_size);

/* ---- Warp: a valve that meets a patient's landmarks, and moves with them ------------------------------- */

/* A smooth map of space that takes landmarks on a valve to landmarks in a patient. The map is affine plus a term |r|^3 for
 * each landmark (docs/theory.md, "Warp"). Its matrix is factored once, so new targets in each time step cost little. */
typedef struct riis_warp riis_warp;

/* Options of riis_warp_create. */
typedef struct riis_warp_options {
  int64_t struct_size; /* set by the init function */
  double noise;        /* standard deviation of each coordinate of the targets, 0 to 1e50. The map is smoothed until it
                          misses the targets by about that much. Default 0: it meets the targets exactly */
  const riis_surface_options *placement; /* NULL, the default: landmarks and noise are in the valve's own coordinates.
                          Otherwise they are in the mesh's: scale, rotation and translation of these options place them.
                          Use the same options for the surface */
} riis_warp_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_warp_options_init(riis_warp_options *options, int64_t struct_size);

/* Makes a warp from landmarks on the valve at rest. Until riis_warp_set_targets, it is the identity.
 *   sources  3 to 1000 landmarks. If they lie nearly in a plane, they do not determine the map across that plane. The map then
 *            stretches that direction as it stretches the plane, and keeps it at right angles (riis_warp_info.is_planar)
 * Errors: RIIS_INVALID_ARGUMENT naming the landmark or field and its value, also for two landmarks in one place, and for
 * landmarks on a line. */
RIIS_API riis_status riis_warp_create(const riis_points *sources, const riis_warp_options *options, riis_warp **warp);
/* Destroys the warp. Valves that have it keep their copies. */
RIIS_API void riis_warp_destroy(riis_warp **warp);
/* Takes the landmarks to these places. The same targets give the same bits, even after other targets.
 *   targets  as many points as the sources, in their order
 * Errors: RIIS_INVALID_ARGUMENT naming the point; RIIS_INVALID_PARAMETER for a warp that folds: half way from some
 * landmark to the nearest other one, its determinant is not above 0. */
RIIS_API riis_status riis_warp_set_targets(riis_warp *warp, const riis_points *targets);
/* Takes the landmarks to their places at a time, from a table of keys in time.
 *   frames  n_vertices is the number of landmarks. The keys are read during the call only
 *   time    magnitude at most 1e30
 * Errors: as riis_warp_set_targets; RIIS_INVALID_ARGUMENT naming the field, key or landmark and its value. */
RIIS_API riis_status riis_warp_set_targets_at(riis_warp *warp, const riis_keyframe_arrays *frames, double time);

/* A warp's quality, in the units of its landmarks. */
typedef struct riis_warp_info {
  int64_t n_landmarks;         /* the number of landmarks */
  double rms_residual;         /* root mean square of the distances between mapped sources and targets */
  double largest_residual;     /* the largest distance between a mapped source and its target */
  int64_t largest_landmark_id; /* its landmark */
  double smoothing;            /* lambda of the smoothing, 0 without noise; infinite if the map is affine */
  double least_determinant;    /* the least determinant of the map's derivative, half way from a landmark to the
                                  nearest other one */
  double least_point[3];       /* the point between the sources where the determinant is least */
  int32_t is_planar;           /* 1 if the landmarks lie nearly in a plane, else 0 */
  int32_t reserved;            /* 0 */
} riis_warp_info;
/* Gives the quality of a warp. */
RIIS_API riis_status riis_warp_get_info(const riis_warp *warp, riis_warp_info *info, int64_t struct_size);
/* Maps points, such as the chords of a mitral valve.
 *   points  in the coordinates of the landmarks
 *   mapped  (3, n_points); may be the array of the points
 * Errors: RIIS_INVALID_ARGUMENT naming the point. */
RIIS_API riis_status riis_warp_map(const riis_warp *warp, const riis_points *points, double *mapped);

/* Warps a valve: its curves are mapped at every opening, before the placement. The valve copies both maps.
 *   closed  the map at opening 0; NULL, with `open` NULL, removes the warp
 *   open    the map at opening 1; NULL: `closed` serves for all openings
 * Between the openings the map is (1 - opening) times `closed` plus opening times `open`. The valve's patches stay patches
 * between the mapped curves. Error bounds, fixed triangulations and velocities therefore hold as for any valve, and with
 * RIIS_TRIANGULATION_FIXED the warp may move. A disc that is the outline of the orifice is also warped.
 * An annulus that moves needs two valves in turn. In each step call riis_warp_set_targets and this function for one of them,
 * and pass both to riis_surface_update_moving. Both must be warped, or neither. A surface's call refuses a warp that folds at
 * the valve or turns a part of it over, as RIIS_INVALID_PARAMETER naming the place and the value.
 * Errors: RIIS_INVALID_ARGUMENT for `open` without `closed`; RIIS_INVALID_PARAMETER for a bileaflet valve, which is rigid. */
RIIS_API riis_status riis_valve_set_warp(riis_valve *valve, const riis_warp *closed, const riis_warp *open);

/* ---- Skirt: the gap between the attachment and a wall -------------------------------------------------- */

/* The gap between the attachment of a valve and a wall. Lengths are in mesh units. */
typedef struct riis_gap {
  double least, mean, most; /* the gap at the ends of the edges; the mean is weighted by the edges' lengths. 0 without a
                               wall at any end */
  double widest_point[3];   /* the end of an edge with the widest gap */
  int64_t n_ends;           /* number of ends of edges: 2 * riis_attachment.n_edges */
  int64_t n_without_wall;   /* the ends whose line misses the wall. They count in no other field */
} riis_gap;
/* Measures the gap between a valve's attachment and a wall, such as a patient's vessel.
 *   wall      a surface in the same frame, usually by riis_surface_create_from_arrays
 *   distance  (2, n_edges): the gap at both ends of each edge of riis_attachment, RIIS_FAR_DISTANCE where the line
 *             misses the wall. NULL if it is not wanted
 * The gap is the distance along the skirt's direction: outwards from the valve's axis and perpendicular to it (docs/theory.md,
 * "Skirt"). Of all places at which that line meets the wall, the nearest counts. The gap is negative if the wall lies inside.
 * Errors: RIIS_INVALID_ARGUMENT for a surface from arrays, for one without an attachment, and for an attachment that
 * encloses no area. */
RIIS_API riis_status riis_surface_get_gap(const riis_surface *surface, const riis_surface *wall, double *distance,
                                          riis_gap *gap, int64_t struct_size);
/* Gives a valve a skirt that reaches a wall, and no farther. It replaces the valve's skirt.
 *   wall     as in riis_surface_get_gap
 *   longest  the longest length to accept, mesh units, 1e-50 to 1e50
 *   options  scale, rotation and translation place the valve, and n_threads is used. NULL stands for the defaults
 * At each point of the attachment of the closed valve, the length is the gap. If the gap is below 0.01 of the attachment's mean
 * distance from the axis, the length is that limit. These lengths stay while the valve opens. The parameter "skirt_length"
 * becomes the largest of them, before placement. Setting that parameter removes the lengths.
 * Errors: RIIS_INVALID_ARGUMENT for a wall that is missed or farther than longest, with the first such point;
 * RIIS_INVALID_PARAMETER for a bileaflet valve, and for an attachment that encloses no area. */
RIIS_API riis_status riis_valve_set_skirt_to_wall(riis_valve *valve, const riis_surface *wall, double longest,
                                                  const riis_surface_options *options);

/* ---- Gradients: directions in which the surface of a valve changes ------------------------------------- */

/* Adds a direction in which the surface of a valve changes: with a parameter, with a landmark, or with the placement.
 *   valve_after, valve_before  two copies of the surface's valve, with the parameter a little larger and a little smaller than
 *                   in the surface. If only the placement changes, pass the same valve twice
 *   dp              the parameter's difference from valve_before to valve_after, 1e-30 to 1e30 in magnitude
 *   options_after, options_before  scale, rotation and translation of both states; other fields are ignored. NULL: those
 *                   of the surface
 * The first call makes direction 0, the next call direction 1. An update removes all directions. A marking with
 * RIIS_FIELD_GRADIENT gives the derivatives of distances and of K in all directions (docs/theory.md, "Sensitivities").
 * Each vertex moves by the difference between both states, on the triangles of the surface, divided by dp. The error of the
 * derivative is of second order in dp if the surface is midway between the states, otherwise of first order. A dp of 1e-5 of
 * the parameter's size suits most parameters. The limits of a fixed triangulation hold for the surface only.
 * Errors: RIIS_INVALID_ARGUMENT for a surface from arrays and for a dp out of range; RIIS_INVALID_PARAMETER for a state of
 * another kind or with other patches, and for parameters that do not fit together; RIIS_LIMIT_EXCEEDED for more than 1000
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
  double area_rate;    /* the derivative of riis_surface_info.area. Each call computes it from all triangles */
} riis_direction;
/* Gives the rates of a surface's vertices along a direction, until the surface's next update or its destruction.
 *   direction_id  0 for the first riis_surface_add_direction after the last update, 1 for the second, and so on
 * With the rates a caller computes derivatives of other numbers that depend on the triangles (docs/theory.md,
 * "Sensitivities"). They are those of the triangles with every RIIS_MEASURE_*.
 * Errors: RIIS_INVALID_ARGUMENT for a direction that the surface lacks. */
RIIS_API riis_status riis_surface_get_direction(const riis_surface *surface, int64_t direction_id,
                                                riis_direction *direction, int64_t struct_size);

/* ---- Laws of opening: a valve's opening from the time, the pressure difference and the flow ------------ */

/* These rules hold for all laws:
 * - The functions are pure: the same arguments give the same bits, and the library keeps nothing.
 * - Times, pressures and flows have the solver's units.
 * - The pressure difference is the upstream pressure minus the downstream pressure. Flow is positive downstream. So
 *   positive values open a valve.
 * - `rate` is the time derivative of the opening.
 * - A state has no pointers: a solver that restores it from a restart file continues with the same bits.
 * - `now` may be the same struct as `before`, and gets its struct_size. To repeat a step, start from `before` again. */

/* An opening by its values at keys in time. */
typedef struct riis_opening_table {
  int64_t struct_size;   /* set by the init function */
  int64_t n_keys;        /* 1 to 1,000,000 */
  const double *time;    /* (n_keys), strictly ascending, magnitude at most 1e30 */
  const double *opening; /* (n_keys), 0 to 1 */
  double period;         /* > 0: the table repeats. All keys lie within a period of the first key. A last key one
                            period after the first must have the same opening. 0, the default: the opening is
                            constant before the first key and after the last */
  int32_t interpolation; /* RIIS_INTERPOLATION_*, default RIIS_INTERPOLATION_LINEAR */
  int32_t reserved;      /* 0 */
} riis_opening_table;
RIIS_API riis_status riis_opening_table_init(riis_opening_table *table, int64_t struct_size); /* the defaults */
/* Gives the opening of a table at a time. opening and rate may be NULL.
 *   time  magnitude at most 1e30
 * Errors: RIIS_INVALID_ARGUMENT naming the field, the key and its value. */
RIIS_API riis_status riis_opening_from_table(const riis_opening_table *table, double time, double *opening,
                                             double *rate);

/* An opening by the times of two ramps. The ramps are of fifth degree, so neither the rate nor its derivative jumps. A mitral
 * valve may begin to open at 0.45 s and to close at 0.95 s, every second, and take 0.05 s for both. */
typedef struct riis_opening_times {
  int64_t struct_size;    /* set by the init function */
  double opening_start;   /* when the valve begins to open. Default NaN, which is refused, also in the next three */
  double opening_duration; /* how long opening takes, > 0 */
  double closing_start;   /* when the valve begins to close, at least opening_start + opening_duration */
  double closing_duration; /* how long closing takes, > 0 */
  double closed, open;    /* the opening when closed and when open, 0 to 1. Default 0 and 1 */
  double period;          /* > 0: the valve opens and closes once in each period. Default 0: only once */
} riis_opening_times;
RIIS_API riis_status riis_opening_times_init(riis_opening_times *times, int64_t struct_size); /* the defaults */
/* Gives the opening at a time by the times of the ramps. opening and rate may be NULL.
 *   time  magnitude at most 1e30
 * Errors: RIIS_INVALID_ARGUMENT naming the field and its value. */
RIIS_API riis_status riis_opening_from_times(const riis_opening_times *times, double time, double *opening,
                                             double *rate);

/* The phases of a switch. */
enum {
  RIIS_PHASE_CLOSING = 0, /* closing or closed */
  RIIS_PHASE_OPENING = 1  /* opening or open */
};

/* A valve that opens when the pressure difference exceeds a value, and closes when the flow falls below one. An aortic valve
 * in SI units has opening_duration 0.04, closing_duration 0.04, open_above 0, close_below 0 (the flow reverses),
 * filter_time 0.002 and dwell_time 0.02. */
typedef struct riis_opening_switch {
  int64_t struct_size;    /* set by the init function */
  double opening_duration; /* time from closed to open, > 0. Default NaN, which is refused. So is that of the next field */
  double closing_duration; /* time from open to closed, > 0 */
  double open_above;      /* pressure difference. Default 0 */
  double close_below;     /* flow. Default 0 */
  double filter_time;  /* time constant of a filter of pressure difference and flow, >= 0. Default 0: no filter */
  double dwell_time;   /* the least time from one change of phase to the next, >= 0. Default 0 */
} riis_opening_switch;
RIIS_API riis_status riis_opening_switch_init(riis_opening_switch *law, int64_t struct_size); /* the defaults */
/* The state of a switch. */
typedef struct riis_opening_switch_state {
  int64_t struct_size;        /* set by the init function */
  double time;                /* of this state */
  double opening, rate;       /* at that time */
  double progress;            /* share of the way to open, 0 to 1; the opening is a smooth ramp over this share */
  double pressure_difference; /* filtered; NaN: none yet */
  double flow;                /* filtered; NaN: none yet */
  double turn_time;           /* time of the last change of phase; NaN: none yet */
  int32_t phase;              /* RIIS_PHASE_* */
  int32_t reserved;           /* 0 */
} riis_opening_switch_state;
/* Fills *state with a closed valve at time 0. */
RIIS_API riis_status riis_opening_switch_state_init(riis_opening_switch_state *state, int64_t struct_size);
/* Advances a switch to a time. Its phase changes at the end of the step in which the condition is met. So the opening
 * is accurate to first order in the length of steps.
 *   time                       at least before->time, magnitude at most 1e30
 *   pressure_difference, flow  at that time, magnitude at most 1e30
 * Errors: RIIS_INVALID_ARGUMENT naming the field or argument and its value; *now stays unchanged. */
RIIS_API riis_status riis_opening_switch_advance(const riis_opening_switch *law,
                                                 const riis_opening_switch_state *before, double time,
                                                 double pressure_difference, double flow,
                                                 riis_opening_switch_state *now);

/* The angle law of T. Korakianitis and Y. Shi, "A concentrated parameter model for the human cardiovascular
 * system including heart valve dynamics and atrioventricular interaction", Med. Eng. Phys. 28 (2006):
 *   angle'' = -friction angle' + (pressure_gain dp + flow_gain Q) cos(angle)
 *             - vortex_gain max(Q, 0) sin(2 angle)
 * with angles in radians, between stops where the speed becomes 0. The opening is the angle's share of its range.
 * The paper's values, for mmHg, ml and s: pressure_gain 5500, flow_gain 2, friction 50, vortex_gain 7 for the
 * aortic and 3.5 for the mitral valve. */
typedef struct riis_opening_angle {
  int64_t struct_size;  /* set by the init function */
  double pressure_gain; /* K_p, >= 0. Default NaN, which is refused, also in the next three fields */
  double flow_gain;     /* K_q, >= 0 */
  double friction;      /* K_f, >= 0 */
  double vortex_gain;   /* K_v, >= 0 */
  double angle_min;     /* degrees, 0 to 90: closed. Default 0 */
  double angle_max;     /* degrees, above angle_min, at most 90: open. Default 75 */
} riis_opening_angle;
RIIS_API riis_status riis_opening_angle_init(riis_opening_angle *law, int64_t struct_size); /* the defaults */
/* The state of the angle law. */
typedef struct riis_opening_angle_state {
  int64_t struct_size;        /* set by the init function */
  double time;                /* of this state */
  double opening, rate;       /* at that time */
  double angle, angle_rate;   /* degrees, degrees per time */
  double pressure_difference; /* at that time; NaN: none yet */
  double flow;                /* at that time; NaN: none yet */
} riis_opening_angle_state;
/* Fills *state with a closed valve at rest, at time 0. Until the first step its angle 0 stands for angle_min. */
RIIS_API riis_status riis_opening_angle_state_init(riis_opening_angle_state *state, int64_t struct_size);
/* Advances the angle law to a time. Pressure difference and flow are taken as linear over the step. So the angle is accurate
 * to second order in the length of steps. If `before` has no pressure difference and flow, the present ones are used for the
 * whole step.
 *   time                       at least before->time, magnitude at most 1e30
 *   pressure_difference, flow  at that time, magnitude at most 1e30
 * Errors: RIIS_INVALID_ARGUMENT naming the field or argument and its value; RIIS_LIMIT_EXCEEDED for a step so
 * long that the integration would need more than a million smaller steps. *now stays unchanged. */
RIIS_API riis_status riis_opening_angle_advance(const riis_opening_angle *law,
                                                const riis_opening_angle_state *before, double time,
                                                double pressure_difference, double flow,
                                                riis_opening_angle_state *now);

#ifdef __cplusplus
}
#endif

#endif
