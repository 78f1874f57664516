/* SPDX-License-Identifier: Apache-2.0
 * base.h - results and messages of calls, the log, and points in the caller's arrays.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_BASE_H
#define RIIS_BASE_H

#include <stdint.h>

#if defined(__GNUC__) && !defined(RIIS_STATIC)
#define RIIS_API __attribute__((visibility("default"))) /* marks every exported function */
#else
#define RIIS_API /* a static library has no exports */
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Status, errors, log, version ---------------------------------------------------------------------- */

/* The result of a call. The number of a status never changes. A later release may add a status above the largest or below the
 * smallest number. */
typedef int32_t riis_status;
/* Values of riis_status. */
enum {
  RIIS_OK = 0,                  /* success */
  RIIS_INVALID_ARGUMENT = 1,    /* a NULL pointer, a number out of range, a non-finite option */
  RIIS_INVALID_STRUCT_SIZE = 2, /* a struct size that fits no release: the struct is not initialised, or riis.h is newer than the
                                   library */
  RIIS_INVALID_PARAMETER = 3,   /* a valve: unknown kind or name, value out of range, values that do not fit together */
  RIIS_INVALID_SURFACE = 4,     /* the caller's surface: empty, non-finite, index out of range, zero area */
  RIIS_INVALID_MESH = 5,        /* the caller's mesh: empty, non-finite coordinate */
  RIIS_LIMIT_EXCEEDED = 6,      /* the request is valid but too large for the library */
  RIIS_OUT_OF_MEMORY = 7,       /* memory ran out; nothing changed */
  RIIS_FILE_ERROR = 8,          /* a file cannot be read or written, or has unexpected content (riis_vtk.h) */
  RIIS_UNAVAILABLE = 9,         /* something cannot be used now: threads after a fork(), a display, a handle that another thread
                                   uses */
  RIIS_INTERNAL_ERROR = -1      /* an error in riis or in a library that it uses */
};

/* Returns the name of a status as static text, such as "RIIS_INVALID_ARGUMENT". The name of any other number is "unknown
 * status". */
RIIS_API const char *riis_status_name(riis_status status);

/* Returns the message of the calling thread's last failed call. If an argument was refused, the message names the argument and
 * its value. If no call has failed, the message is "". The returned pointer is never NULL. The library owns the message, and
 * keeps it until the thread's next failed call. */
RIIS_API const char *riis_last_error(void);

/* Returns the version of the linked library, not of this header, as static text such as "1.0.0". */
RIIS_API const char *riis_version_string(void);

/* The type of a log function. The library calls the log function in the thread whose call sends the message. A log function must
 * not call the library, throw an exception or leave by longjmp.
 *   `user_data`: the pointer that was passed to riis_set_log.
 *   `level`: RIIS_LOG_INFO or RIIS_LOG_WARNING.
 *   `message`: one line without a newline; valid only until the log function returns. */
typedef void (*riis_log_function)(void *user_data, int32_t level, const char *message);
/* The levels of a message. */
enum {
  RIIS_LOG_INFO = 0,   /* a note of the shape that was built, and of its size */
  RIIS_LOG_WARNING = 1 /* a warning of skipped triangles, of sizes that seem to have different units, or of leaflets that cross */
};
/* Sets the log function, which is the same for all threads of the process. Any thread may call riis_set_log.
 *   `function`: receives the messages; NULL, the default, means no log.
 *   `user_data`: a pointer that the library passes to the function. The pointer must stay valid as long as the function is set.
 * While riis_set_log runs, a message from another thread may still go to the previous log function. While a log function is set,
 * calls that make or update a surface from a valve also search the surface for crossings (riis_find_crossings). A search takes
 * longer than an update, so the library searches rarely. A valve with the default shape of its kind is never searched. For other
 * valves, the openings are divided into five ranges, which end at 0, 0.05, 1/3, 2/3 and 1. When a valve first has an opening in
 * one of these ranges, the library searches the surface. After a warning, the library searches this valve again only if its
 * parameters change. */
RIIS_API void riis_set_log(riis_log_function function, void *user_data);

/* If a field is RIIS_AUTO, the library chooses the value of the field. The comment of the field says which value. */
#define RIIS_AUTO (-1.0)

/* Points in the caller's arrays. A call copies these points or reads them once, so the arrays may change after the call. */
typedef struct riis_points {
  int64_t struct_size;     /* set by the init function */
  int64_t n_points;        /* 0 to 2^40 */
  const void *x, *y, *z;   /* (n_points) by stride; NULL only for 0 points */
  int64_t stride;          /* of x, y and z. Default 1 */
  int32_t real_bits;       /* of x, y and z */
  int32_t reserved;        /* 0 */
} riis_points;
RIIS_API riis_status riis_points_init(riis_points *points, int64_t struct_size); /* the defaults */

#ifdef __cplusplus
}
#endif

#endif
