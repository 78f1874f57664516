// SPDX-License-Identifier: Apache-2.0
// Makes the triangles of grids, image by image. The adapted and the fixed triangulation share this code. This file makes placed
// vertices, and the triangles between them, from grids with the levels of their quads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"
#include "triangulate/triangulate.hpp"

namespace riis {

// The triangles of one image of a patch. Each tile has its own range of vertices and triangles in a set. The thread that builds
// the tile writes to no other range.
struct Tile {
  std::size_t patch;
  const PatchImage *image;
  const PatchImage *twin;  // the image on the other side of the seam; null without a seam
  const Seam *seam;
  std::int64_t first_vertex, first_triangle;
  std::int64_t first_id;         // the triangle_id of the first triangle; ids also count triangles without area
  std::int64_t n_triangles = 0;  // the triangles that have an area; the range may have room for more
  Vector<LeftOut> left_out{};    // the triangles without area
  bool is_whole = true;          // false if one of the triangles left out is missed (is_missed)
};

// The vertices of a patch before its images are placed: first the grid's vertices, then the vertices of subdivided quads.
struct PatchVertices {
  Vector<Vec3> points;
  Vector<double> uv;
  Vector<Vec3> displacements;  // displacements since an earlier state of the same build; empty without such a state
};

// Two states of a moving valve that are built differently. Here each tile has its own patch, whose number is the tile's number.
struct OwnPatches {
  PatchSet now, before;
};

class Tiles {
 public:
  // Keeps references to its arguments. Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles.
  Tiles(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids, TriangleSet &triangles);

  const Vector<Tile> &all() const { return tiles_; }
  // The number of triangles for which all tiles together have room.
  std::int64_t room() const { return room_; }
  // Bounds the distance between the triangles and the smooth surface, in mesh units.
  double error_bound() const;

  // Places the vertices of all tiles, and then calls work(i) for each tile i. Several threads call work at the same time.
  template <class Work>
  void place_vertices(const Work &work) {
    make_patch_vertices();
    parallel_for(view(tiles_).size(), how_.n_threads, [&](std::int64_t i, int) {
      place_vertices_of(view(tiles_)[i]);
      work(i);
    });
  }

  // Makes vertices and triangles, and then calls work(i, first_of_quad) for each tile i, as place_vertices does. `first_of_quad`
  // has the position of each quad's first triangle. Its last entry is the end of the last quad's triangles. The ids also count
  // triangles without area. Returns the patches with missing triangles. If there is no such patch, the triangles are complete.
  template <class Work>
  Vector<std::size_t> make_triangles(const Work &work) {
    make_room_for_triangles();
    place_vertices([&](std::int64_t i) { work(i, add_triangles_of(view(tiles_)[i])); });
    return complete_triangles();
  }

 private:
  void make_patch_vertices();
  void place_vertices_of(const Tile &tile);
  void make_room_for_triangles();
  Vector<std::int32_t> add_triangles_of(Tile &tile);
  Vector<std::size_t> complete_triangles();

  const PatchSet &set_;
  const Triangulation &how_;
  const Vector<LevelledGrid> &grids_;
  TriangleSet &triangles_;
  Vector<Tile> tiles_;
  Vector<PatchVertices> of_patches_;
  std::optional<OwnPatches> own_;
  std::int64_t n_vertices_ = 0, room_ = 0;
};

// Returns true if nothing in the set takes the place of a triangle that was left out.
bool is_missed(const TriangleSet &set, const LeftOut &triangle);

// Returns the request `asked`, with the allowed error reduced by the patches' own deviation. Fails if the remaining error is too
// small, or if the earlier state is built differently.
Triangulation checked(const PatchSet &set, const Triangulation &asked);

// Adds the rims of the patches to the set. Also stores the grids in the set, because the rates in a direction are computed from
// them.
void finish(const PatchSet &set, Vector<LevelledGrid> grids, TriangleSet &triangles);

[[noreturn]] void fail_for_vanished(const PatchSet &set, std::size_t patch, const char *where);

// Calls attempt(tightness) until it returns no patch with missing triangles. A patch thinner than the tolerance loses its area if
// two opposite sides become the same chords. Each attempt therefore has finer curves for the patches that the previous attempt
// returned.
template <class Attempt>
void with_finer_curves(const PatchSet &set, const char *where, const Attempt &attempt) {
  constexpr int max_attempts = 12;
  Vector<double> tightness(set.curves.size(), 1);
  for (int i = 0;; ++i) {
    const Vector<std::size_t> vanished = attempt(tightness);
    if (vanished.empty()) return;
    if (i == max_attempts) fail_for_vanished(set, vanished.front(), where);
    for (const std::size_t patch : vanished)
      for (const Side &side :
           {set.patches[patch].v0, set.patches[patch].v1, set.patches[patch].u0, set.patches[patch].u1})
        tightness[side.curve] *= 0.1;
  }
}

}  // namespace riis
