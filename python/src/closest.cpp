// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

namespace riis_python {
namespace {

nb::object closest_point(Surface &surface, nb::handle point_) {
  const Reading reading(surface.usage, "surface");
  double point[3];
  three_numbers(point_, "point", point);
  riis_closest found;
  call_shortly(riis_closest_point(surface.handle, point, &found, sizeof found));
  return record("ClosestPoint")(found.distance, array_of(found.point, "float64"),
                                array_of(found.barycentric, "float64"), array_of(found.normal, "float64"),
                                found.triangle_id, found.leaflet_id, found.side);
}

nb::object closest_points(Surface &surface, nb::handle points_, nb::handle distance, nb::handle point,
                          nb::handle barycentric, nb::handle normal, nb::handle triangle_id, nb::handle leaflet_id,
                          nb::handle side, nb::handle distance_limit, nb::handle far_distance, nb::handle mask_,
                          nb::handle ids_, nb::handle n_threads) {
  const Reading reading(surface.usage, "surface");
  const Points points = points_of(points_, "points");
  riis_closest_options options;
  call_shortly(riis_closest_options_init(&options, sizeof options));
  options.distance_limit = number_or(distance_limit, "distance_limit", options.distance_limit);
  options.far_distance = number(far_distance, "far_distance");
  options.n_threads = thread_count(n_threads);
  std::optional<Array> mask, ids;
  if (!mask_.is_none()) {
    mask.emplace(Array::of<std::uint8_t>(mask_, "mask")).expect({points.n});
    options.point_mask = mask->data<std::uint8_t>();
  }
  if (!ids_.is_none()) {
    ids.emplace(Array::of<std::int64_t>(ids_, "ids")).expect({-1});
    options.n_point_ids = ids->size(0);
    options.point_ids = ids->data<std::int64_t>();
  }
  // If the call leaves out entries, new arrays are first filled with the values of far points.
  const bool is_partial = mask || ids;
  const auto fill = [&](nb::object value) { return is_partial ? value : nb::object(nb::none()); };
  const nb::object none = fill(nb::int_(-1)), zero = fill(nb::int_(0));
  const std::int64_t n = points.n;
  const Output outputs[] = {
      output_of<double>(distance, "distance", "float64", {n}, fill(nb::float_(options.far_distance))),
      output_of<double>(point, "point", "float64", {n, 3}, zero),
      output_of<double>(barycentric, "barycentric", "float64", {n, 3}, zero),
      output_of<double>(normal, "normal", "float64", {n, 3}, zero),
      output_of<std::int64_t>(triangle_id, "triangle_id", "int64", {n}, none),
      output_of<std::int32_t>(leaflet_id, "leaflet_id", "int32", {n}, none),
      output_of<std::int32_t>(side, "side", "int32", {n}, zero),
  };
  riis_closest_arrays arrays;
  call_shortly(riis_closest_arrays_init(&arrays, sizeof arrays));
  arrays.distance = outputs[0].data<double>();
  arrays.point = outputs[1].data<double>();
  arrays.barycentric = outputs[2].data<double>();
  arrays.normal = outputs[3].data<double>();
  arrays.triangle_id = outputs[4].data<std::int64_t>();
  arrays.leaflet_id = outputs[5].data<std::int32_t>();
  arrays.side = outputs[6].data<std::int32_t>();
  riis_points given;
  call_shortly(riis_points_init(&given, sizeof given));
  given.n_points = n;
  given.x = points.x;
  given.y = points.y;
  given.z = points.z;
  given.stride = points.stride;
  call_library([&] { return riis_closest_points(surface.handle, &given, &options, &arrays); });
  return record("ClosestPoints")(outputs[0].array, outputs[1].array, outputs[2].array, outputs[3].array,
                                 outputs[4].array, outputs[5].array, outputs[6].array);
}

#define RIIS_OUTPUT(name, type, wanted) name ": bool | numpy.typing.NDArray[numpy." type "] = " wanted ", "

}  // namespace

void add_closest(nb::class_<Surface> &surface) {
  surface
      .def("closest_point", &closest_point, nb::arg("point").none(),
           nb::sig("def closest_point(self, point: collections.abc.Sequence[float] | "
                   "numpy.typing.NDArray[numpy.float64]) -> "
                   "riis._records.ClosestPoint"),
           "Finds the closest point of the surface to one point of three coordinates, mesh units.")
      .def(
          "closest_points", &closest_points, nb::arg("points").none(), nb::kw_only(), nb::arg("distance").none() = true,
          nb::arg("point").none() = true, nb::arg("barycentric").none() = false, nb::arg("normal").none() = true,
          nb::arg("triangle_id").none() = true, nb::arg("leaflet_id").none() = true, nb::arg("side").none() = false,
          nb::arg("distance_limit").none() = nb::none(), nb::arg("far_distance").none() = RIIS_FAR_DISTANCE,
          nb::arg("mask").none() = nb::none(), nb::arg("ids").none() = nb::none(), nb::arg("n_threads").none() = 0,
          nb::sig(
              "def closest_points(self, points: numpy.typing.NDArray[numpy.float64], *, " RIIS_OUTPUT(
                  "distance", "float64", "True") RIIS_OUTPUT("point", "float64", "True")
                  RIIS_OUTPUT("barycentric", "float64", "False") RIIS_OUTPUT("normal", "float64", "True")
                      RIIS_OUTPUT("triangle_id", "int64", "True") RIIS_OUTPUT("leaflet_id", "int32", "True")
                          RIIS_OUTPUT("side", "int32",
                                      "False") "distance_limit: float | None = None, far_distance: float = 1e30, mask: "
                                               "numpy.typing.NDArray[numpy.bool_] | numpy.typing.NDArray[numpy.uint8] "
                                               "| None = None, ids: "
                                               "numpy.typing.NDArray[numpy.int64] | None = None, n_threads: int = 0) "
                                               "-> riis._records.ClosestPoints"),
          R"(Finds the closest points of many points, in parallel.

points          (n, 3) float64 of any forward strides, mesh units
distance        (n,) float64         each of these is True for a new array, False for no array, or an array to write;
point           (n, 3) float64       riis.ClosestPoint describes their content
barycentric     (n, 3) float64
normal          (n, 3) float64
triangle_id     (n,) int64
leaflet_id      (n,) int32
side            (n,) int32
distance_limit  points farther away get far_distance, ids -1, side 0 and zeros; None: no limit
mask            (n,) bool or uint8: the results of other points are not written
ids             strictly ascending int64: only these points are read and written

In new arrays, points without a result get the values of far points.)");
}

}  // namespace riis_python
