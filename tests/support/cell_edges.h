/* SPDX-License-Identifier: Apache-2.0
 * The edges of cells, without a table. */
#ifndef RIIS_TEST_CELL_EDGES_H
#define RIIS_TEST_CELL_EDGES_H

/* Tells whether two corners of a cell share an edge, by the places of the unit shapes' corners rather than by a table. A corner
 * of a prism or a hexahedron has a place round the base, and lies at the lower or the upper end. Corners at different ends
 * share an edge if they have the same place. Corners at the same end share an edge if their places are neighbours. */
static inline int on_an_edge(int n_corners, int a, int b) {
  const int n_base = n_corners == 8 || n_corners == 5 ? 4 : 3;
  const int base_a = a % n_base, base_b = b % n_base, floor_a = a / n_base, floor_b = b / n_base;
  if (a == b) return 0;
  if (n_corners == 4 || n_corners == 5) /* the apex is joined to all */
    if (floor_a != floor_b) return 1;
  if (floor_a != floor_b) return base_a == base_b;
  return (base_a + 1) % n_base == base_b || (base_b + 1) % n_base == base_a;
}

#endif
