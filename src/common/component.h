/* SPDX-License-Identifier: Apache-2.0
 *
 * The project's components are separate libraries, such as riis_vtk, and report errors as the core's last error. The function
 * below is exported for these components, but it is not part of the public interface, and its header is not installed.
 */
#ifndef RIIS_COMMON_COMPONENT_H
#define RIIS_COMMON_COMPONENT_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Records `text` as the calling thread's last error, cut to the library's limit. Returns `status`. */
RIIS_API riis_status riis_component_error(riis_status status, const char *text);

#ifdef __cplusplus
}
#endif

#endif
