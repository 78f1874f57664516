// SPDX-License-Identifier: Apache-2.0
// Leaks, open regions, passages, and crossings.
#include "module.hpp"

namespace riis_python {
namespace {

template <class T, void (*destroy)(T **)>
struct Destroy {
  void operator()(T *handle) const { destroy(&handle); }
};

nb::object pair(nb::object first, nb::object second) { return nb::make_tuple(first, second); }

nb::object find_leaks(nb::handle surface_, nb::handle mesh_, nb::handle marks_, nb::handle mask, nb::handle n_threads) {
  Surface &surface = object<Surface>(surface_, "surface");
  Mesh &mesh = object<Mesh>(mesh_, "mesh");
  Marks &marks = object<Marks>(marks_, "marks");
  const Reading reading_surface(surface.usage, "surface"), reading_mesh(mesh.usage, "mesh"),
      reading_marks(marks.usage, "marks");
  if (marks.n_nodes < 0) refuse_value("marks", "is empty; riis.mark fills it");
  const MarkOptions options(mesh, mask, n_threads);
  riis_leaks *handle = nullptr;
  call_shortly(riis_leaks_create(&handle));
  const std::unique_ptr<riis_leaks, Destroy<riis_leaks, riis_leaks_destroy>> leaks(handle);
  call_library([&] { return riis_find_leaks(surface.handle, mesh.handle, marks.handle, &options.options, handle); });
  riis_leak_list list;
  call_shortly(riis_leaks_get_list(handle, &list, sizeof list));
  const auto n = static_cast<std::size_t>(list.n_edges);
  return record("Leaks")(list.n_edges, copy_of(list.node_id, {n, 2}), copy_of(list.length, {n}),
                         copy_of(list.distance, {n}), list.half_thickness, array_of(list.longest_node_id, "int64"),
                         list.longest_length, array_of(list.longest_middle, "float64"), list.seconds);
}

nb::object label_open_regions(nb::handle mesh_, nb::handle marks_, nb::handle mask, nb::handle n_threads,
                              nb::handle label_) {
  Mesh &mesh = object<Mesh>(mesh_, "mesh");
  Marks &marks = object<Marks>(marks_, "marks");
  const Reading reading_mesh(mesh.usage, "mesh"), reading_marks(marks.usage, "marks");
  if (marks.n_nodes < 0) refuse_value("marks", "is empty; riis.mark fills it");
  const MarkOptions options(mesh, mask, n_threads);
  const std::int64_t n = mesh.points.n;
  const nb::object wanted = label_.is_none() ? nb::object(nb::bool_(true)) : nb::borrow(label_);
  const Output label = output_of<std::int64_t>(wanted, "label", "int64", {n});
  std::int64_t n_regions = 0;
  call_library([&] {
    return riis_label_open_regions(mesh.handle, marks.handle, &options.options, n, label.data<std::int64_t>(),
                                   &n_regions);
  });
  return pair(label.array, nb::int_(n_regions));
}

nb::object find_passage(nb::handle surface_, nb::handle mesh_, nb::handle from_, nb::handle to_, nb::handle mask,
                        nb::handle n_threads) {
  Surface &surface = object<Surface>(surface_, "surface");
  Mesh &mesh = object<Mesh>(mesh_, "mesh");
  const Reading reading_surface(surface.usage, "surface"), reading_mesh(mesh.usage, "mesh");
  const MarkOptions options(mesh, mask, n_threads);
  const Array from = Array::of<std::int64_t>(from_, "from_ids"), to = Array::of<std::int64_t>(to_, "to_ids");
  from.expect({-1});
  to.expect({-1});
  riis_passage_ends ends;
  call_shortly(riis_passage_ends_init(&ends, sizeof ends));
  ends.n_from = from.size(0);
  ends.from = from.data<std::int64_t>();
  ends.n_to = to.size(0);
  ends.to = to.data<std::int64_t>();
  riis_passage passage;
  call_library([&] {
    return riis_find_passage(surface.handle, mesh.handle, &ends, &options.options, &passage, sizeof passage);
  });
  static const char *const states[] = {"closed", "open", "none"};
  return record("Passage")(states[passage.state], passage.node_id, passage.distance, array_of(passage.point, "float64"),
                           passage.seconds);
}

nb::object find_crossings(nb::handle surface_, nb::handle depth, nb::handle n_threads) {
  Surface &surface = object<Surface>(surface_, "surface");
  const Reading reading(surface.usage, "surface");
  riis_crossing_options options;
  call_shortly(riis_crossing_options_init(&options, sizeof options));
  options.depth = number(depth, "depth");
  options.n_threads = thread_count(n_threads);
  riis_crossings *handle = nullptr;
  call_shortly(riis_crossings_create(&handle));
  const std::unique_ptr<riis_crossings, Destroy<riis_crossings, riis_crossings_destroy>> crossings(handle);
  call_library([&] { return riis_find_crossings(surface.handle, &options, handle); });
  riis_crossing_list list;
  call_shortly(riis_crossings_get_list(handle, &list, sizeof list));
  const auto n = static_cast<std::size_t>(list.n_pairs);
  return record("Crossings")(list.n_pairs, copy_of(list.triangle_id, {n, 2}), copy_of(list.point, {n, 3}),
                             copy_of(list.depth, {n}), copy_of(list.length, {n}), list.total_length, list.deepest_depth,
                             array_of(list.deepest_point, "float64"), array_of(list.deepest_triangle_id, "int64"),
                             array_of(list.deepest_leaflet_id, "int32"), list.seconds);
}

#define RIIS_MASK "mask: numpy.typing.NDArray[numpy.bool_] | numpy.typing.NDArray[numpy.uint8] | None = None"
#define RIIS_NODES "numpy.typing.NDArray[numpy.int64]"

}  // namespace

void add_leaks(nb::module_ &module) {
  module.def("find_leaks", &find_leaks, nb::arg("surface").none(), nb::arg("mesh").none(), nb::arg("marks").none(),
             nb::kw_only(), nb::arg("mask").none() = nb::none(), nb::arg("n_threads").none() = 0,
             nb::sig("def find_leaks(surface: Surface, mesh: Mesh, marks: Marks, *, " RIIS_MASK
                     ", n_threads: int = 0) -> riis._records.Leaks"),
             R"(Finds every edge of the mesh's adjacency that crosses the surface between two unmarked nodes.

surface, mesh and mask must be those of the marking.)");
  module.def(
      "label_open_regions", &label_open_regions, nb::arg("mesh").none(), nb::arg("marks").none(), nb::kw_only(),
      nb::arg("mask").none() = nb::none(), nb::arg("n_threads").none() = 0, nb::arg("label").none() = nb::none(),
      nb::sig("def label_open_regions(mesh: Mesh, marks: Marks, *, " RIIS_MASK
              ", n_threads: int = 0, label: " RIIS_NODES " | None = None) -> tuple[" RIIS_NODES ", int]"),
      R"(Labels the connected components of the unmarked nodes, along the mesh's adjacency. Returns (label, n_regions).

label  (n_nodes,) int64: the lowest node of the node's region, -1 for nodes in no region; if None, a new array)");
  module.def("find_passage", &find_passage, nb::arg("surface").none(), nb::arg("mesh").none(),
             nb::arg("from_ids").none(), nb::arg("to_ids").none(), nb::kw_only(), nb::arg("mask").none() = nb::none(),
             nb::arg("n_threads").none() = 0,
             nb::sig("def find_passage(surface: Surface, mesh: Mesh, from_ids: " RIIS_NODES ", to_ids: " RIIS_NODES
                     ", *, " RIIS_MASK ", n_threads: int = 0) -> riis._records.Passage"),
             R"(Finds the widest passage along the mesh's adjacency from one set of nodes to another.

from_ids, to_ids  (n,) int64, at least one node each, farther from the surface than the half thickness)");
  module.def("find_crossings", &find_crossings, nb::arg("surface").none(), nb::kw_only(),
             nb::arg("depth").none() = 1e-6, nb::arg("n_threads").none() = 0,
             nb::sig("def find_crossings(surface: Surface, *, depth: float = 1e-6, n_threads: int = 0) -> "
                     "riis._records.Crossings"),
             R"(Finds every pair of the surface's triangles that go through each other.

depth  in half thicknesses, 0 to 1: pairs of at most this depth only touch, and are left out.)");
}

}  // namespace riis_python
