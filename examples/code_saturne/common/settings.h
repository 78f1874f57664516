/* SPDX-License-Identifier: Apache-2.0
 * Reads the numbers of a run from the environment. A user's own case would have its numbers in the user files instead. */
#ifndef SETTINGS_H
#define SETTINGS_H

/* Returns the number of the environment variable of this name, or its default. Stops the run by bft_error if the variable is
 * not a number in its range. settings.c lists the names. */
double setting(const char *name);

/* Returns the kind of the valve from VALVE_KIND, or "trileaflet". */
const char *valve_kind(void);

#endif
