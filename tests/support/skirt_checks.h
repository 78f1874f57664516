/* SPDX-License-Identifier: Apache-2.0
 * Counts the pairs of triangles in which a skirt passes through another part. Include after handles.h. */
#ifndef RIIS_TEST_SKIRT_CHECKS_H
#define RIIS_TEST_SKIRT_CHECKS_H

/* The numbers of pairs of triangles that penetrate by more than rounding errors. */
typedef struct pair_counts {
  int64_t of_leaflets; /* without the skirt */
  int64_t of_skirt;    /* pairs of the skirt and another part, without the patch that the skirt continues */
  int64_t of_own;      /* pairs of the skirt and the patch that the skirt continues */
} pair_counts;

static inline pair_counts crossings_of(const riis_surface *surface, riis_crossings *crossings) {
  riis_crossing_list list;
  CHECK_OK(riis_find_crossings(surface, NULL, crossings)); /* the default depth is 1e-7 of these valves' unit */
  CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
  const riis_triangles all = triangles_of(surface);
  pair_counts counts = {0, 0, 0};
  int32_t largest = 0;
  for (int64_t t = 0; t < all.n_triangles; ++t)
    if (all.leaflet_id[t] != RIIS_LEAFLET_SKIRT && all.patch_id[t] > largest) largest = all.patch_id[t];
  for (int64_t k = 0; k < list.n_pairs; ++k) {
    int n_of_skirt = 0;
    int32_t patch[2] = {0, 0};
    for (int end = 0; end < 2; ++end) {
      /* A fixed triangulation leaves out triangles without area, so a triangle's id may differ from its position in the list. */
      int64_t low = 0, high = all.n_triangles - 1;
      while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (all.triangle_id[middle] < list.triangle_id[2 * k + end])
          low = middle + 1;
        else
          high = middle;
      }
      assert_true(all.triangle_id[low] == list.triangle_id[2 * k + end]);
      patch[end] = all.patch_id[low];
      n_of_skirt += all.leaflet_id[low] == RIIS_LEAFLET_SKIRT;
    }
    const int is_own = n_of_skirt == 1 && abs(patch[0] - patch[1]) == largest + 1;
    ++*(n_of_skirt == 0 ? &counts.of_leaflets : is_own ? &counts.of_own : &counts.of_skirt);
  }
  return counts;
}

#endif
