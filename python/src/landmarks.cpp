// SPDX-License-Identifier: Apache-2.0
// riis_place. The Python file _place.py reads landmarks and calls this function.
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "errors.hpp"
#include "module.hpp"

namespace riis_python {
namespace {

nb::tuple place_landmarks(nb::handle valve_, nb::handle xyz_, nb::handle role_, nb::handle leaflet_id_,
                          nb::handle scale, nb::handle noise, nb::handle flow, nb::handle held_) {
  Valve &valve = object<Valve>(valve_, "valve");
  const Writing writing(valve.usage, "valve");
  const Array xyz = Array::of<double>(xyz_, "points"), role = Array::of<std::int32_t>(role_, "roles"),
              leaflet_id = Array::of<std::int32_t>(leaflet_id_, "leaflet_ids");
  xyz.expect({-1, 3});
  role.expect({xyz.size(0)});
  leaflet_id.expect({xyz.size(0), 2});
  const std::string held = text(held_, "held");
  riis_landmarks landmarks;
  call_shortly(riis_landmarks_init(&landmarks, sizeof landmarks));
  landmarks.n_landmarks = xyz.size(0);
  landmarks.x = xyz.data<double>();
  landmarks.y = xyz.data<double>() + 1;
  landmarks.z = xyz.data<double>() + 2;
  landmarks.stride = 3;
  landmarks.role = role.data<std::int32_t>();
  landmarks.leaflet_id = leaflet_id.data<std::int32_t>();
  landmarks.scale = number(scale, "scale");
  landmarks.noise = number_or(noise, "noise", RIIS_AUTO);
  if (!flow.is_none()) three_numbers(flow, "flow", landmarks.flow);
  std::int64_t n_parameters = 0;
  call_shortly(riis_valve_get_n_parameters(valve.handle, &n_parameters));
  const auto n = static_cast<std::size_t>(n_parameters), n_points = static_cast<std::size_t>(xyz.size(0));
  std::vector<double> residual(n_points), error(n), place(3 * n_points);
  std::vector<std::int32_t> state(n);
  riis_placement at;
  riis_placement_arrays arrays;
  call_shortly(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.residual = residual.data();
  arrays.standard_error = error.data();
  arrays.size_state = state.data();
  arrays.place = place.data();
  call_to_write(valve.usage,
                [&] { return riis_place(valve.handle, &landmarks, held.c_str(), &arrays, &at, sizeof at); });
  nb::dict placement;
  placement["scale"] = at.scale;
  placement["rotation_axis"] = nb::make_tuple(at.rotation_axis[0], at.rotation_axis[1], at.rotation_axis[2]);
  placement["rotation_angle"] = at.rotation_angle;
  placement["translation"] = nb::make_tuple(at.translation[0], at.translation[1], at.translation[2]);
  return nb::make_tuple(placement, copy_of(residual.data(), {n_points}), copy_of(error.data(), {n}),
                        copy_of(state.data(), {n}), at.rms, at.worst, at.noise, at.rotation_error, at.position_error,
                        at.worst_landmark_id, copy_of(place.data(), {n_points, 3}));
}

}  // namespace

void add_landmarks(nb::module_ &module) {
  module.def("place_landmarks", &place_landmarks, nb::arg("valve").none(), nb::arg("points").none(),
             nb::arg("roles").none(), nb::arg("leaflet_ids").none(), nb::arg("scale").none(), nb::arg("noise").none(),
             nb::arg("flow").none(), nb::arg("held").none(),
             nb::sig("def place_landmarks(valve: Valve, points: numpy.typing.NDArray[numpy.float64], roles: "
                     "numpy.typing.NDArray[numpy.int32], leaflet_ids: numpy.typing.NDArray[numpy.int32], scale: float, "
                     "noise: float | None, flow: typing.Any, held: str) -> tuple[typing.Any, ...]"),
             "Does the work of riis.place, which names landmarks and results.");
}

}  // namespace riis_python
