// SPDX-License-Identifier: Apache-2.0
// The options of a marking, and the arrays of a marked mesh.
#pragma once

#include <riis/riis_vtk.h>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"

namespace riis::program {

Marks new_result();
// Marks the nodes of a mesh by a surface.
Marks marks_of(const riis_surface *surface, riis_mesh *mesh, const riis_mark_options &how);
// Returns options for marks by a surface that the user did not choose. Any search is allowed, and distances go up to a limit.
riis_mark_options how_to_mark_again(const MarkOptions &options, double limit = RIIS_AUTO);

bool needs_adjacency(int32_t search);

// K and K u_surface at every node. Each of the two fields is a sum over the valves that have a resistance.
class ResistanceSum {
 public:
  enum class WithVelocity { no, yes };
  ResistanceSum(int64_t n_nodes, WithVelocity with_velocity);
  void add(const MarkOptions &options, const riis_marks *result);
  // Sets PREFIX_K and PREFIX_K_u_surface. If no valve had a resistance, sets no array.
  void set_arrays(const std::string &prefix, riis_vtk_mesh *file) const;

 private:
  int64_t n_nodes_;
  bool with_velocity_;
  std::vector<double> K_, K_u_surface_;
  std::string K_unit_, K_u_surface_unit_;  // "" if not known
  bool has_any_ = false;
};

double distance_between(const double *p, const double *q);
// Returns the value in the middle, or the upper one of two such values.
double median(std::vector<double> values);

// The coordinates of the nodes of a file. A rectilinear grid has only the coordinates along its axes.
class NodePoints {
 public:
  using Point = std::array<double, 3>;

  // The file must outlive this object.
  explicit NodePoints(const riis_vtk_mesh *file);

  std::int64_t n() const { return n_; }
  const riis_grid *axes() const { return axes_.ni > 0 ? &axes_ : nullptr; }
  const double *xyz() const { return xyz_; }  // NULL if there are axes
  Point point(std::int64_t node) const {
    if (xyz_) return {xyz_[3 * node], xyz_[3 * node + 1], xyz_[3 * node + 2]};
    const std::int64_t layer = node / axes_.ni;
    return {x_[0][node % axes_.ni], x_[1][layer % axes_.nj], x_[2][layer / axes_.nj]};
  }

 private:
  std::int64_t n_ = 0;
  const double *xyz_ = nullptr;
  riis_grid axes_;
  const double *x_[3];
};

// The nodes of a mesh file as the library takes them, and the neighbours of each node.
class FileNodes : public NodePoints {
 public:
  // The file must outlive this object. Refusals call the file by `path`.
  FileNodes(const riis_vtk_mesh *file, std::string path);

  riis_mesh *mesh() const { return mesh_.get(); }
  // Returns whether the nodes form a grid. The library computes the neighbours in a grid, so none are stored.
  bool is_grid() const { return axes() != nullptr; }

  // Finds the neighbours of all nodes if they are not known yet.
  void find_neighbors(std::int32_t n_threads);
  void forget_neighbors() { neighbors_.reset(); }
  // Both functions below need the neighbours of the nodes.
  template <class Visit>
  void for_each_neighbor(std::int64_t node, const Visit &visit) const {
    if (const riis_grid *const grid = axes()) {
      std::int64_t stride = 1;
      for (const std::int64_t n : {grid->ni, grid->nj, grid->nk}) {
        const std::int64_t i = node / stride % n;
        if (i > 0) visit(node - stride);
        if (i + 1 < n) visit(node + stride);
        stride *= n;
      }
      return;
    }
    const auto *offsets = static_cast<const std::int64_t *>(rows_.offsets);
    for (std::int64_t k = offsets[node]; k < offsets[node + 1]; ++k)
      visit(rows_.column_bits == 64 ? static_cast<const std::int64_t *>(rows_.columns)[k]
                                    : static_cast<const std::int32_t *>(rows_.columns)[k]);
  }
  double longest_edge(std::int64_t node) const;

  // While an object of this type lives, the library's mesh has the neighbours of this object, or the given rows of neighbours. A
  // grid always has the neighbours that follow from its axes.
  class Lent {
   public:
    explicit Lent(const FileNodes &nodes) : Lent(nodes, nodes.rows_) {}
    Lent(const FileNodes &nodes, const riis_csr &rows);
    // The call leaves the library's last error message unchanged.
    ~Lent() {
      if (mesh_) riis_mesh_set_adjacency(mesh_, nullptr);
    }
    Lent(const Lent &) = delete;
    Lent &operator=(const Lent &) = delete;

   private:
    riis_mesh *mesh_;  // NULL for a grid
  };

 private:
  const riis_vtk_mesh *file_;
  std::string path_;
  Adjacency neighbors_;
  riis_csr rows_{};
  Mesh mesh_;
};

}  // namespace riis::program
