// SPDX-License-Identifier: Apache-2.0
// The nodes of a mesh file as the library takes them, and the neighbours of each node.
#pragma once

#include <riis/riis_vtk.h>

#include <cstdint>
#include <string>

#include "program/base/handles.hpp"

namespace riis::program {

double distance_between(const double *p, const double *q);

class FileNodes {
 public:
  // The file must outlive this object. `path` names it in refusals.
  FileNodes(const riis_vtk_mesh *file, std::string path);

  std::int64_t n() const { return n_; }
  const double *point(std::int64_t node) const { return xyz_ + 3 * node; }
  riis_mesh *mesh() const { return mesh_.get(); }

  // Finds the neighbours, unless they are known.
  void find_neighbors(std::int32_t n_threads);
  void forget_neighbors() { neighbors_.reset(); }
  // Both functions need the neighbours.
  template <class Visit>
  void for_each_neighbor(std::int64_t node, const Visit &visit) const {
    const auto *offsets = static_cast<const std::int64_t *>(rows_.offsets);
    for (std::int64_t k = offsets[node]; k < offsets[node + 1]; ++k)
      visit(rows_.column_bits == 64 ? static_cast<const std::int64_t *>(rows_.columns)[k]
                                    : static_cast<const std::int32_t *>(rows_.columns)[k]);
  }
  double longest_edge(std::int64_t node) const;

  // While an object of this type lives, the library's mesh has neighbours: these, or other rows.
  class Lent {
   public:
    explicit Lent(const FileNodes &nodes) : Lent(nodes, nodes.rows_) {}
    Lent(const FileNodes &nodes, const riis_csr &rows);
    ~Lent() { riis_mesh_set_adjacency(mesh_, nullptr); }  // this call changes no error message
    Lent(const Lent &) = delete;
    Lent &operator=(const Lent &) = delete;

   private:
    riis_mesh *mesh_;
  };

 private:
  const riis_vtk_mesh *file_;
  std::string path_;
  std::int64_t n_ = 0;
  const double *xyz_ = nullptr;
  Adjacency neighbors_;
  riis_csr rows_{};
  Mesh mesh_;
};

}  // namespace riis::program
