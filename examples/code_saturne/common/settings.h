/* SPDX-License-Identifier: Apache-2.0
 * The numbers of a run, from the environment. A case of one's own puts its numbers into the user files instead. */
#ifndef SETTINGS_H
#define SETTINGS_H

/* Returns the number of the environment variable of this name, or its default. Stops the run by bft_error if the variable is no
 * number in its range. settings.c lists the names. */
double setting(const char *name);

/* Returns the kind of the valve: that of VALVE_KIND, or "trileaflet". */
const char *valve_kind(void);

#endif
