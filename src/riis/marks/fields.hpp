// SPDX-License-Identifier: Apache-2.0
// Computes fields. A field is a number or vector at a node's closest point, such as the velocity, which a solver's force needs
// besides the distance. In: nodes within the limit, each with the closest triangle that the search found. Out: an array for each
// requested field.
#pragma once

#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "kernels/kernels.hpp"
#include "marks/node_list.hpp"
#include "search/found_nodes.hpp"
#include "search/search.hpp"

namespace riis {

// Fields, and the number of the surface's directions, which RIIS_FIELD_GRADIENT needs.
struct FieldSet {
  std::int32_t bits;  // a sum of RIIS_FIELD_*
  std::int64_t n_directions;
};

// The fields of one list of nodes, in the list's order. The array of a field that was not requested is empty.
struct NodeFields {
  UnfilledVector<double> point, normal, barycentric, velocity;  // (3, n)
  UnfilledVector<double> uv;                                    // (2, n)
  UnfilledVector<double> distance_gradient;                     // (n_directions, n)
  UnfilledVector<std::int32_t> side, rim, patch_id;             // (n)

  // Reserves memory for n nodes. Then resize(m) with m <= n does not throw.
  void reserve(const FieldSet &fields, std::int64_t n);
  bool has_room(const FieldSet &fields, std::int64_t n) const;
  void resize(const FieldSet &fields, std::int64_t n);
};

// Memory that the next marking's fields reuse.
struct FieldScratch {
  UnfilledVector<VertexNumbers> at_vertices;
  std::vector<Tie> ties;  // by node, then by leaflet; a leaflet's closest triangle comes first

  // Reserves memory for the fields of the nodes that a search found, and sorts their ties.
  void prepare(const SearchRequest &request, std::int32_t fields, const FoundNodes &found);
};

// Fails with RIIS_INVALID_ARGUMENT if `fields`, a sum of RIIS_FIELD_*, contains a field that the surface lacks.
void check_fields(const Surface &surface, std::int32_t fields);

// Returns whether the fields of n_nodes nodes need Surface::pseudonormals().
bool need_normals(const Surface &surface, std::int32_t fields, std::int64_t n_nodes);

// Returns the rule by which a search must collect ties, if these fields are requested.
TieRule ties_for(const Surface &surface, std::int32_t fields);

// Writes the fields of the nodes in the list. The memory must be reserved, so this function does not throw.
void make_fields(const SearchRequest &request, std::int32_t fields, const NodeList &list, FieldScratch &scratch,
                 NodeFields &made);

// Writes the fields of the nodes in `some`, which is a part of `all`. Both lists are in ascending order of nodes.
void select_fields(const FieldSet &fields, const NodeList &all, const NodeFields &fields_of_all, const NodeList &some,
                   NodeFields &made);

}  // namespace riis
