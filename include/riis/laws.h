/* SPDX-License-Identifier: Apache-2.0
 * laws.h - laws of opening: a valve's opening from the time, the pressure difference and the flow.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_LAWS_H
#define RIIS_LAWS_H

#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Laws of opening: a valve's opening from the time, the pressure difference and the flow ------------ */

/* These rules hold for all laws:
 * - The functions are pure: equal arguments give bitwise equal results, and the library stores no state.
 * - Times, pressures and flows have the solver's units.
 * - The pressure difference is the upstream pressure minus the downstream pressure, so a positive pressure difference opens a
 *   valve. Flow in the downstream direction is positive.
 * - `rate` is the time derivative of the opening.
 * - A state contains no pointers. A solver can therefore write a state to a restart file, read it again, and continue with
 *   bitwise the same results.
 * - `now` may point to the same struct as `before`. The call copies the struct_size of `before` to `now`. If a step may have to
 *   be repeated, keep the state before this step in another struct. */

/* A law that interpolates the opening between keys. A key is a time with the opening at this time. */
typedef struct riis_opening_table {
  int64_t struct_size;   /* set by the init function */
  int64_t n_keys;        /* 1 to 1,000,000 */
  const double *time;    /* (n_keys), strictly ascending, magnitude at most 1e30 */
  const double *opening; /* (n_keys), 0 to 1 */
  double period;         /* if above 0, the table repeats with this period. All keys must lie within one period after the first
                            key. If the last key is exactly one period after the first key, the two keys must have the same
                            opening. With 0, the default, the opening is constant before the first key and after the last key */
  int32_t interpolation; /* RIIS_INTERPOLATION_*, default RIIS_INTERPOLATION_LINEAR */
  int32_t reserved;      /* 0 */
} riis_opening_table;
RIIS_API riis_status riis_opening_table_init(riis_opening_table *table, int64_t struct_size); /* the defaults */
/* Gives the opening and its rate at a given time, from a table. `opening` or `rate` may be NULL.
 *   `time`: magnitude at most 1e30.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field or key; the message names the field or key and its value. */
RIIS_API riis_status riis_opening_from_table(const riis_opening_table *table, double time, double *opening,
                                             double *rate);

/* A law that opens and closes the valve by two ramps at given times. The ramps are polynomials of degree five, so the rate and
 * its derivative are continuous. For example, in a heartbeat of 1 s a mitral valve may open from 0.45 s to 0.5 s, and close from
 * 0.95 s to 1 s. */
typedef struct riis_opening_times {
  int64_t struct_size;    /* set by the init function */
  double opening_start;   /* the time at which the valve begins to open. This field and the next three have the default NaN, which
                             is refused */
  double opening_duration; /* how long opening takes, > 0 */
  double closing_start;   /* the time at which the valve begins to close, at least opening_start + opening_duration */
  double closing_duration; /* how long closing takes, > 0 */
  double closed, open;    /* the opening of the closed valve, and the opening of the open valve, each 0 to 1. Default 0 and 1 */
  double period;          /* if above 0, the valve opens and closes once in each period. With 0, the default, the valve opens and
                             closes only once */
} riis_opening_times;
RIIS_API riis_status riis_opening_times_init(riis_opening_times *times, int64_t struct_size); /* the defaults */
/* Gives the opening and its rate at a given time, from the times of the two ramps. `opening` or `rate` may be NULL.
 *   `time`: magnitude at most 1e30.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field and its value. */
RIIS_API riis_status riis_opening_from_times(const riis_opening_times *times, double time, double *opening,
                                             double *rate);

/* The phases of a valve that riis_opening_switch opens and closes. */
enum {
  RIIS_PHASE_CLOSING = 0, /* closing or closed */
  RIIS_PHASE_OPENING = 1  /* opening or open */
};

/* A law, called a switch, that opens the valve when the pressure difference exceeds open_above, and closes it when the flow falls
 * below close_below. These values suit an aortic valve in SI units: opening_duration 0.04, closing_duration 0.04, open_above 0,
 * close_below 0 (the valve closes when the flow reverses), filter_time 0.002, dwell_time 0.04 (a motion ends before the next
 * motion begins). */
typedef struct riis_opening_switch {
  int64_t struct_size;    /* set by the init function */
  double opening_duration; /* the time that the valve takes to open, > 0. Default NaN, which is refused */
  double closing_duration; /* the time that the valve takes to close, > 0. Default NaN, which is refused */
  double open_above;      /* the pressure difference above which the valve opens. Default 0 */
  double close_below;     /* the flow below which the valve closes. Default 0 */
  double filter_time;  /* the time constant of the filter that smooths pressure difference and flow, >= 0. Default 0: no filter */
  double dwell_time;   /* the shortest time between two changes of phase, >= 0. Default 0 */
} riis_opening_switch;
RIIS_API riis_status riis_opening_switch_init(riis_opening_switch *law, int64_t struct_size); /* the defaults */
/* The state of a switch. */
typedef struct riis_opening_switch_state {
  int64_t struct_size;        /* set by the init function */
  double time;                /* of this state */
  double opening, rate;       /* at that time */
  double progress;            /* the position within the motion from closed (0) to open (1). The opening is a smooth function of
                                 this position */
  double pressure_difference; /* filtered; NaN: none yet */
  double flow;                /* filtered; NaN: none yet */
  double turn_time;           /* the time of the last change of phase; NaN: none yet */
  int32_t phase;              /* RIIS_PHASE_* */
  int32_t reserved;           /* 0 */
} riis_opening_switch_state;
/* Fills *state with a closed valve at time 0. */
RIIS_API riis_status riis_opening_switch_state_init(riis_opening_switch_state *state, int64_t struct_size);
/* Advances the state of a switch to a later time. The phase changes only at the end of a step, so the error of the opening is of
 * first order in the length of the step.
 *   `time`: the end of the step; at least before->time, and at most 1e30 in magnitude.
 *   `pressure_difference`, `flow`: the values at `time`, each at most 1e30 in magnitude.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field or argument; the message names the field or argument and its value. After an
 * error, *now is unchanged. */
RIIS_API riis_status riis_opening_switch_advance(const riis_opening_switch *law,
                                                 const riis_opening_switch_state *before, double time,
                                                 double pressure_difference, double flow,
                                                 riis_opening_switch_state *now);

/* The angle law of T. Korakianitis and Y. Shi, "A concentrated parameter model for the human cardiovascular
 * system including heart valve dynamics and atrioventricular interaction", Med. Eng. Phys. 28 (2006):
 *   angle'' = -friction angle' + (pressure_gain dp + flow_gain Q) cos(angle)
 *             - vortex_gain max(Q, 0) sin(2 angle).
 * Here dp is the pressure difference, Q the flow, and angles are in radians. The motion stops at angle_min and angle_max. The
 * opening grows linearly with the angle, from 0 at angle_min to 1 at angle_max. With pressures in mmHg, flows in ml/s and times
 * in s, the paper has these values: pressure_gain 5500, flow_gain 2, friction 50, vortex_gain 7 for the aortic and 3.5 for the
 * mitral valve. */
typedef struct riis_opening_angle {
  int64_t struct_size;  /* set by the init function */
  double pressure_gain; /* K_p in the paper, >= 0. This field and the next three have the default NaN, which is refused */
  double flow_gain;     /* K_q, >= 0 */
  double friction;      /* K_f, >= 0 */
  double vortex_gain;   /* K_v, >= 0 */
  double angle_min;     /* the angle of the closed valve in degrees, 0 to 90. Default 0 */
  double angle_max;     /* the angle of the open valve in degrees, above angle_min, at most 90. Default 75 */
} riis_opening_angle;
RIIS_API riis_status riis_opening_angle_init(riis_opening_angle *law, int64_t struct_size); /* the defaults */
/* The state of the angle law. */
typedef struct riis_opening_angle_state {
  int64_t struct_size;        /* set by the init function */
  double time;                /* of this state */
  double opening, rate;       /* at that time */
  double angle, angle_rate;   /* in degrees, and in degrees per unit of time */
  double pressure_difference; /* at that time; NaN: none yet */
  double flow;                /* at that time; NaN: none yet */
} riis_opening_angle_state;
/* Fills *state with a closed valve at rest, at time 0. In the first step, the angle 0 of this state stands for angle_min. */
RIIS_API riis_status riis_opening_angle_state_init(riis_opening_angle_state *state, int64_t struct_size);
/* Advances the state of the angle law to a later time. The law assumes that the pressure difference and the flow change linearly
 * during a step. The error of the angle is therefore of second order in the length of the step. During the first step both are
 * assumed to be constant, because no earlier values are known.
 *   `time`: the end of the step; at least before->time, and at most 1e30 in magnitude.
 *   `pressure_difference`, `flow`: the values at `time`, each at most 1e30 in magnitude.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field or argument; the message names the field or argument and its value.
 * RIIS_LIMIT_EXCEEDED if the integration of the step needs more than a million smaller steps. After an error, *now is
 * unchanged. */
RIIS_API riis_status riis_opening_angle_advance(const riis_opening_angle *law,
                                                const riis_opening_angle_state *before, double time,
                                                double pressure_difference, double flow,
                                                riis_opening_angle_state *now);

#ifdef __cplusplus
}
#endif

#endif
