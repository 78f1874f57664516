/* SPDX-License-Identifier: Apache-2.0 */
#ifndef RIIS_TESTS_VIRTUAL_DISPLAY_H
#define RIIS_TESTS_VIRTUAL_DISPLAY_H

/* Starts the running program again under xvfb-run, and ends with its exit code. Does nothing if the program already runs under
 * xvfb-run. Ends with 77 if xvfb-run or its xauth is missing. CTest reports 77 as skipped. Without this call, a program keeps the
 * caller's DISPLAY. */
void enter_virtual_display(char **argv);

#endif
