/* SPDX-License-Identifier: Apache-2.0
 * Links and runs the installed VTK component: one call succeeds, and one fails with the core's message. */
#include <riis/riis_vtk.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  riis_vtk_picture_options options;
  if (riis_vtk_picture_options_init(&options, sizeof options) != RIIS_OK || options.view != RIIS_VTK_VIEW_OBLIQUE) {
    fprintf(stderr, "picture options: %s\n", riis_last_error());
    return 1;
  }
  riis_vtk_mesh *mesh = NULL;
  if (riis_vtk_mesh_read("there/is/no/such.vtu", &mesh) != RIIS_FILE_ERROR || mesh != NULL ||
      strstr(riis_last_error(), "there/is/no/such.vtu") == NULL) {
    fprintf(stderr, "missing file: %s\n", riis_last_error());
    return 1;
  }
  return 0;
}
