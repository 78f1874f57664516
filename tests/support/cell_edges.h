/* SPDX-License-Identifier: Apache-2.0 Finds the edges of cells without a table. */
#ifndef RIIS_TEST_CELL_EDGES_H
#define RIIS_TEST_CELL_EDGES_H

/* Returns whether two corners of a cell share an edge. The positions of the corners in the unit shapes decide which corners share
 * an edge. A corner of a prism or a hexahedron has a position around the base, at the lower or the upper end. A lower and an
 * upper corner share an edge if their positions around the base are equal. Two lower or two upper corners share an edge if their
 * positions around the base are adjacent. */
static inline int on_an_edge(int n_corners, int a, int b) {
  const int n_base = n_corners == 8 || n_corners == 5 ? 4 : 3;
  const int base_a = a % n_base, base_b = b % n_base, floor_a = a / n_base, floor_b = b / n_base;
  if (a == b) return 0;
  if (n_corners == 4 || n_corners == 5) /* an edge joins the apex to every other corner */
    if (floor_a != floor_b) return 1;
  if (floor_a != floor_b) return base_a == base_b;
  return (base_a + 1) % n_base == base_b || (base_b + 1) % n_base == base_a;
}

#endif
