/* SPDX-License-Identifier: Apache-2.0 */
#include "moving_sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"

void sheet_vertex(int64_t vertex, double time, double xyz[3], double velocity[3]) {
  const double i = (double)(vertex % 5), j = (double)(vertex / 5);
  const double from[3] = {i / 4, j / 4, i * j / 16}, by[3] = {-j / 8, i / 8, (i + j + 2) / 8};
  for (int k = 0; k < 3; ++k) {
    if (xyz) xyz[k] = from[k] + time * by[k];
    if (velocity) velocity[k] = by[k];
  }
}

void sheet_triangle(int64_t triangle, int64_t corners[3], int32_t *leaflet) {
  const int64_t square = triangle / 2, i = square % 4, first = i + 5 * (square / 4);
  corners[0] = first;
  corners[1] = triangle % 2 ? first + 6 : first + 1;
  corners[2] = triangle % 2 ? first + 5 : first + 6;
  *leaflet = i < 2 ? 3 : 7;
}

static FILE *open_file(const char *name) {
  FILE *file = fopen(scratch_path(name), "wb");
  if (file) return file;
  perror(name);
  exit(1);
}

static void write_points(FILE *file, double time) {
  fputs("<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">", file);
  for (int64_t v = 0; v < sheet_n_vertices; ++v) {
    double x[3];
    sheet_vertex(v, time, x, NULL);
    fprintf(file, "%.17g %.17g %.17g\n", x[0], x[1], x[2]);
  }
  fputs("</DataArray></Points>\n", file);
}

static void write_cells(FILE *file, const char *element, int with_types) {
  int64_t corners[3];
  int32_t leaflet;
  fprintf(file, "<%s><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">", element);
  for (int64_t t = 0; t < sheet_n_triangles; ++t) {
    sheet_triangle(t, corners, &leaflet);
    fprintf(file, "%d %d %d ", (int)corners[0], (int)corners[1], (int)corners[2]);
  }
  fputs("</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">", file);
  for (int t = 1; t <= sheet_n_triangles; ++t) fprintf(file, "%d ", 3 * t);
  fputs("</DataArray>", file);
  if (with_types) fputs("<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">", file);
  for (int t = 0; with_types && t < sheet_n_triangles; ++t) fputs("5 ", file);
  if (with_types) fputs("</DataArray>", file);
  fprintf(file, "</%s>\n<CellData><DataArray type=\"Int32\" Name=\"riis_leaflet\" format=\"ascii\">", element);
  for (int64_t t = 0; t < sheet_n_triangles; ++t) {
    sheet_triangle(t, corners, &leaflet);
    fprintf(file, "%d ", (int)leaflet);
  }
  fputs("</DataArray></CellData>\n", file);
}

static void write_xml(FILE *file, int is_grid, double time, const sheet_extras *extras) {
  const char *type = is_grid ? "UnstructuredGrid" : "PolyData";
  fprintf(file, "<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"><%s>\n", type,
          type);
  if (extras && extras->field_data) fprintf(file, "<FieldData>%s</FieldData>\n", extras->field_data);
  fprintf(file, "<Piece NumberOfPoints=\"%d\" NumberOf%s=\"%d\">\n", sheet_n_vertices, is_grid ? "Cells" : "Polys",
          sheet_n_triangles);
  if (extras && extras->point_data) fprintf(file, "<PointData>%s</PointData>\n", extras->point_data);
  write_points(file, time);
  write_cells(file, is_grid ? "Cells" : "Polys", is_grid);
  fprintf(file, "</Piece></%s></VTKFile>\n", type);
}

static void write_stl(FILE *file, int is_ascii, double time) {
  const uint32_t n = sheet_n_triangles;
  char head[80] = "a moving sheet";
  if (is_ascii) fputs("solid sheet\n", file);
  if (!is_ascii) fwrite(head, 1, sizeof head, file);
  if (!is_ascii) fwrite(&n, 4, 1, file);
  for (int64_t t = 0; t < sheet_n_triangles; ++t) {
    int64_t corners[3];
    int32_t leaflet;
    const float normal[3] = {0, 0, 0};
    const uint16_t attributes = 0;
    sheet_triangle(t, corners, &leaflet);
    fputs(is_ascii ? "facet normal 0 0 0\nouter loop\n" : "", file);
    if (!is_ascii) fwrite(normal, 4, 3, file);
    for (int c = 0; c < 3; ++c) {
      double x[3];
      sheet_vertex(corners[c], time, x, NULL);
      const float narrow[3] = {(float)x[0], (float)x[1], (float)x[2]};
      if (is_ascii) fprintf(file, "vertex %.9g %.9g %.9g\n", narrow[0], narrow[1], narrow[2]);
      if (!is_ascii) fwrite(narrow, 4, 3, file);
    }
    fputs(is_ascii ? "endloop\nendfacet\n" : "", file);
    if (!is_ascii) fwrite(&attributes, 2, 1, file);
  }
  if (is_ascii) fputs("endsolid sheet\n", file);
}

void sheet_write(const char *name, double time, const sheet_extras *extras) {
  const char *ending = strrchr(name, '.');
  FILE *file = open_file(name);
  if (strcmp(ending, ".vtp") == 0 || strcmp(ending, ".vtu") == 0)
    write_xml(file, strcmp(ending, ".vtu") == 0, time, extras);
  else
    write_stl(file, strcmp(ending, ".STL") == 0, time);
  fclose(file);
}

char *sheet_displacement(char *text, const char *name, double time) {
  text += sprintf(text, "<DataArray type=\"Float64\" Name=\"%s\" NumberOfComponents=\"3\" format=\"ascii\">", name);
  for (int64_t v = 0; v < sheet_n_vertices; ++v) {
    double from[3], to[3];
    sheet_vertex(v, 0, from, NULL);
    sheet_vertex(v, time, to, NULL);
    text += sprintf(text, "%.17g %.17g %.17g\n", to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }
  return text + sprintf(text, "</DataArray>\n");
}
