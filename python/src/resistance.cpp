// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

namespace riis_python {
namespace {

riis_resistance model_of(nb::handle resistance, nb::handle half_thickness, nb::handle rim) {
  riis_resistance model;
  call_shortly(riis_resistance_init(&model, sizeof model));
  model.resistance = number(resistance, "resistance");
  model.half_thickness = number_or(half_thickness, "half_thickness", RIIS_AUTO);
  model.rim = choice(rim, "rim", {{"round", RIIS_RIM_ROUND}, {"cut", RIIS_RIM_CUT}});
  return model;
}

// Refuses a result that was never marked with.
std::int64_t n_nodes_of(const MarkResult &result) {
  if (result.n_nodes < 0) refuse_value("marks", "is empty; riis.mark fills it");
  return result.n_nodes;
}

void add_to(MarkResult &result, nb::handle coefficient_, nb::handle momentum_, nb::handle resistance, nb::handle half_thickness,
            nb::handle rim) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const riis_resistance model = model_of(resistance, half_thickness, rim);
  const std::int64_t n = n_nodes_of(result);
  std::optional<Array> coefficient, momentum;
  if (!coefficient_.is_none())
    coefficient.emplace(Array::of<double>(coefficient_, "coefficient", Access::write)).expect({n});
  if (!momentum_.is_none()) momentum.emplace(Array::of<double>(momentum_, "momentum", Access::write)).expect({n, 3});
  call_library([&] {
    return riis_marks_add_resistance(result.handle, &model, n, coefficient ? coefficient->data<double>() : nullptr,
                                           momentum ? momentum->data<double>() : nullptr);
  });
}

nb::object add_reaction(MarkResult &result, nb::handle velocity_, nb::handle weight_, nb::handle force_, nb::handle resistance,
                        nb::handle half_thickness, nb::handle rim) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const riis_resistance model = model_of(resistance, half_thickness, rim);
  const std::int64_t n = n_nodes_of(result);
  const Array velocity = Array::of<double>(velocity_, "velocity"), weight = Array::of<double>(weight_, "weight");
  velocity.expect({n, 3});
  weight.expect({n});
  const nb::object force = force_.is_none() ? new_filled_array("float64", {3}, nb::float_(0.0)) : nb::borrow(force_);
  const Array to = Array::of<double>(force, "force", Access::write);
  to.expect({3});
  call_library([&] {
    return riis_marks_add_reaction(result.handle, &model, n, velocity.data<double>(), weight.data<double>(),
                                         to.data<double>());
  });
  return force;
}

nb::object band_sums(MarkResult &result, nb::handle value_, nb::handle weight_, nb::handle inner_, nb::handle outer_) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const std::int64_t n = n_nodes_of(result);
  const Array value = Array::of<double>(value_, "value"), weight = Array::of<double>(weight_, "weight");
  value.expect({n});
  weight.expect({n});
  const double inner = number(inner_, "inner"), outer = number(outer_, "outer");
  riis_band_sums sums;
  call_library([&] {
    return riis_marks_get_band_sums(result.handle, inner, outer, n, value.data<double>(), weight.data<double>(), &sums,
                                      sizeof sums);
  });
  return record("BandSums")(array_of(sums.sum, "float64"), array_of(sums.weight, "float64"), array_of(sums.n_nodes, "int64"));
}

#define RIIS_MODEL \
  "resistance: float, half_thickness: float | None = None, rim: typing.Literal['round', 'cut'] = 'round'"
#define RIIS_REALS "numpy.typing.NDArray[numpy.float64]"

}  // namespace

void add_resistance(nb::class_<MarkResult> &result) {
  result
      .def("add_resistance", &add_to, nb::arg("coefficient").none() = nb::none(), nb::arg("momentum").none() = nb::none(), nb::kw_only(),
           nb::arg("resistance").none(), nb::arg("half_thickness").none() = nb::none(), nb::arg("rim").none() = "round",
           nb::sig("def add_resistance(self, coefficient: " RIIS_REALS " | None = None, momentum: " RIIS_REALS
                   " | None = None, *, " RIIS_MODEL ") -> None"),
           R"(Adds K and K u_surface to the caller's arrays, so that several valves add up.

coefficient     (n_nodes,) float64: K = (R / eps) delta(d) is added
momentum        (n_nodes, 3) float64: K u_surface is added; the marking needs fields='velocity'
resistance      R, mass / (length time), such as kg/(m s)
half_thickness  eps, mesh units, at most the distance limit of the marking; None: that of the marking
rim             'round': every node within eps resists; 'cut': not those whose closest point is on the rim, which needs
                fields='rim')")
      .def("add_reaction", &add_reaction, nb::arg("velocity").none(), nb::arg("weight").none(), nb::arg("force").none() = nb::none(), nb::kw_only(),
           nb::arg("resistance").none(), nb::arg("half_thickness").none() = nb::none(), nb::arg("rim").none() = "round",
           nb::sig("def add_reaction(self, velocity: " RIIS_REALS ", weight: " RIIS_REALS ", force: " RIIS_REALS
                   " | None = None, *, " RIIS_MODEL ") -> " RIIS_REALS),
           R"(Adds the force of the flow on the surface, the sum of weight K (velocity - u_surface), to force, and returns it.

velocity  (n_nodes, 3) float64: of the flow
weight    (n_nodes,) float64: the volume that a node stands for, 0 for nodes of other ranks
force     (3,) float64; None: a new array)")
      .def("band_sums", &band_sums, nb::arg("value").none(), nb::arg("weight").none(), nb::arg("inner").none(), nb::arg("outer").none(),
           nb::sig("def band_sums(self, value: " RIIS_REALS ", weight: " RIIS_REALS
                   ", inner: float, outer: float) -> riis._records.BandSums"),
           R"(Sums a value, such as the pressure, over the nodes at a distance from inner to outer, by side.

value, weight  (n_nodes,) float64
inner, outer   mesh units, 0 <= inner <= outer <= distance limit of the marking, which needs fields='side, rim')");
}

}  // namespace riis_python
