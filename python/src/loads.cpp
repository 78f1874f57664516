// SPDX-License-Identifier: Apache-2.0
// The forces of the leaflets at nodes of tissue.
#include "arguments.hpp"
#include "errors.hpp"
#include "module.hpp"

namespace riis_python {
namespace {

constexpr std::int64_t n_sums = 11;  // of each leaflet

// The arguments that both calls share, in the form of riis.h.
struct Tissue {
  Tissue(nb::handle nodes_, nb::handle radius, nb::handle edges_, nb::handle edge_leaflet_id_, nb::handle weight_,
         nb::handle n_threads)
      : nodes(points_of(nodes_, "nodes")), edges(Array::of<double>(edges_, "edges")) {
    call_shortly(riis_loads_init(&loads, sizeof loads));
    call_shortly(riis_points_init(&points, sizeof points));
    edges.expect({-1, 2, 3});
    loads.radius = number(radius, "radius");
    loads.n_edges = edges.size(0);
    loads.edges = edges.data<double>();
    loads.n_threads = thread_count(n_threads);
    if (!edge_leaflet_id_.is_none()) {
      edge_leaflet_id.emplace(Array::of<std::int32_t>(edge_leaflet_id_, "edge_leaflet_id")).expect({loads.n_edges});
      loads.edge_leaflet_id = edge_leaflet_id->data<std::int32_t>();
    }
    if (!weight_.is_none()) weight.emplace(Array::of<double>(weight_, "weight")).expect({nodes.n});
    points.n_points = nodes.n;
    points.x = nodes.x, points.y = nodes.y, points.z = nodes.z;
    points.stride = nodes.stride;
  }
  const double *weights() const { return weight ? weight->data<double>() : nullptr; }
  // Adds the sums to an array (n_leaflets, 11).
  void add_sums(const Array &sums) const {
    call_library([&] { return riis_loads_add_sums(&loads, &points, weights(), sums.data<double>()); });
  }

  Points nodes;
  Array edges;
  std::optional<Array> edge_leaflet_id, weight;
  riis_loads loads;
  riis_points points;
};

nb::object new_zeros(std::int64_t rows, std::int64_t columns) {
  return new_filled_array("float64", {rows, columns}, nb::float_(0.0));
}

nb::object load_sums(nb::handle nodes, nb::handle radius, nb::handle edges, nb::handle n_leaflets,
                     nb::handle edge_leaflet_id, nb::handle weight, nb::handle n_threads) {
  Tissue tissue(nodes, radius, edges, edge_leaflet_id, weight, n_threads);
  tissue.loads.n_leaflets = integer(n_leaflets, "n_leaflets");
  if (tissue.loads.n_leaflets < 1 || tissue.loads.n_leaflets > (std::int64_t{1} << 31))
    refuse_value("n_leaflets", "must be from 1 to 2^31");
  const nb::object sums = new_zeros(tissue.loads.n_leaflets, n_sums);
  tissue.add_sums(Array::of<double>(sums, "sums", Access::write));
  return sums;
}

nb::object loads(nb::handle nodes, nb::handle radius, nb::handle edges, nb::handle leaflet_force_,
                 nb::handle leaflet_moment_, nb::handle about, nb::handle edge_leaflet_id, nb::handle weight,
                 nb::handle sums_, nb::handle n_threads) {
  Tissue tissue(nodes, radius, edges, edge_leaflet_id, weight, n_threads);
  riis_loads &of = tissue.loads;
  const Array leaflet_force = Array::of<double>(leaflet_force_, "leaflet_force"),
              leaflet_moment = Array::of<double>(leaflet_moment_, "leaflet_moment");
  leaflet_force.expect({-1, 3});
  of.n_leaflets = leaflet_force.size(0);
  leaflet_moment.expect({of.n_leaflets, 3});
  of.leaflet_force = leaflet_force.data<double>();
  of.leaflet_moment = leaflet_moment.data<double>();
  if (!about.is_none()) three_numbers(about, "about", of.about);
  const bool is_alone = sums_.is_none();
  const nb::object sums_of_all = is_alone ? new_zeros(of.n_leaflets, n_sums) : nb::borrow(sums_);
  const Array sums = Array::of<double>(sums_of_all, "sums", is_alone ? Access::write : Access::read);
  sums.expect({of.n_leaflets, n_sums});
  if (is_alone) tissue.add_sums(sums);
  const nb::object forces = new_zeros(tissue.nodes.n, 3);
  const Array to = Array::of<double>(forces, "forces", Access::write);
  call_library([&] {
    return riis_loads_add_forces(&of, &tissue.points, tissue.weights(), sums.data<double>(), to.data<double>());
  });
  return forces;
}

#define RIIS_REALS "numpy.typing.NDArray[numpy.float64]"
#define RIIS_LEAFLETS \
  "edge_leaflet_id: numpy.typing.NDArray[numpy.int32] | None = None, weight: " RIIS_REALS " | None = None, "

}  // namespace

void add_loads(nb::module_ &module) {
  module.def("load_sums", &load_sums, nb::arg("nodes").none(), nb::arg("radius").none(), nb::arg("edges").none(),
             nb::arg("n_leaflets").none(), nb::kw_only(), nb::arg("edge_leaflet_id").none() = nb::none(),
             nb::arg("weight").none() = nb::none(), nb::arg("n_threads").none() = 0,
             nb::sig("def load_sums(nodes: " RIIS_REALS ", radius: float, edges: " RIIS_REALS
                     ", n_leaflets: int, *, " RIIS_LEAFLETS "n_threads: int = 0) -> " RIIS_REALS),
             R"(Returns the sums over a rank's nodes of tissue that loads needs, (n_leaflets, 11). Ranks add their sums.

The arguments are those of loads. n_leaflets is the length of leaflet_force.)");
  module.def("loads", &loads, nb::arg("nodes").none(), nb::arg("radius").none(), nb::arg("edges").none(),
             nb::arg("leaflet_force").none(), nb::arg("leaflet_moment").none(), nb::kw_only(),
             nb::arg("about").none() = nb::none(), nb::arg("edge_leaflet_id").none() = nb::none(),
             nb::arg("weight").none() = nb::none(), nb::arg("sums").none() = nb::none(),
             nb::arg("n_threads").none() = 0,
             nb::sig("def loads(nodes: " RIIS_REALS ", radius: float, edges: " RIIS_REALS ", leaflet_force: " RIIS_REALS
                     ", leaflet_moment: " RIIS_REALS ", *, about: collections.abc.Sequence[float] | " RIIS_REALS
                     " | None = None, " RIIS_LEAFLETS "sums: " RIIS_REALS
                     " | None = None, n_threads: int = 0) -> " RIIS_REALS),
             R"(Returns the forces of the leaflets at nodes of tissue, (n, 3).

For each leaflet the sum of the forces is leaflet_force, and their moment is leaflet_moment. The forces act at the nodes that
are nearer than radius to the edges that hold the leaflet. They fall to 0 at the radius, and are linear along the edges
(docs/theory/loads.md). They do not come from the mechanics of a membrane.

nodes            (n, 3) float64: the nodes of a surface or a volume of tissue, in the frame of the edges
radius           mesh units
edges            (n_edges, 2, 3): both ends of each edge, such as Surface.attachment.edges
leaflet_force    (n_leaflets, 3): from Marks.add_reaction, the sum over all ranks
leaflet_moment   (n_leaflets, 3): from Marks.add_reaction, the sum over all ranks
about            the point of leaflet_moment; None: (0, 0, 0)
edge_leaflet_id  (n_edges,) int32, such as Surface.attachment.leaflet_id: the leaflet that the edge holds. All edges hold a
                 leaflet without an edge of its own, such as a skirt; None: all edges hold all leaflets
weight           (n,): the area or volume around a node, 0 for nodes of other ranks; None: 1
sums             (n_leaflets, 11): the sum of load_sums over all ranks; None: these nodes are all nodes)");
}

}  // namespace riis_python
