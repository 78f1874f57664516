// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"
#include "surface.hpp"

namespace riis_python {
namespace {

// The caller's points (n, 3), borrowed for a call.
struct PointsOf {
  PointsOf(nb::handle given, const char *name) : array(Array::of<double>(given, name)) {
    array.expect({-1, 3});
    call_shortly(riis_points_init(&points, sizeof points));
    points.n_points = array.size(0);
    if (points.n_points == 0) return;
    const double *xyz = array.data<double>();
    points.x = xyz, points.y = xyz + 1, points.z = xyz + 2;
    points.stride = 3;
  }
  Array array;
  riis_points points;
};

nb::object own_copy(nb::handle array) { return nb::module_::import_("numpy").attr("array")(array); }

void create(Warp *self, nb::handle sources, nb::handle noise, nb::handle placement) {
  const PointsOf points(sources, "sources");
  riis_warp_options options;
  riis_surface_options placed;
  call_shortly(riis_warp_options_init(&options, sizeof options));
  call_shortly(riis_surface_options_init(&placed, sizeof placed));
  options.noise = number(noise, "noise");
  set_placement(placed, placement, "placement");
  if (!placement.is_none()) options.placement = &placed;
  new (self) Warp();
  try {
    self->sources = own_copy(sources);
    self->noise = options.noise;
    if (!placement.is_none()) self->placement = nb::module_::import_("builtins").attr("dict")(placement);
    call_library([&] { return riis_warp_create(&points.points, &options, &self->handle); });
  } catch (...) {
    self->~Warp();
    throw;
  }
}

void set_targets(Warp &warp, nb::handle targets) {
  const PointsOf points(targets, "targets");
  const Writing writing(warp.usage, "warp");
  nb::object kept = own_copy(targets);
  call_to_write(warp.usage, [&] { return riis_warp_set_targets(warp.handle, &points.points); });
  warp.targets = std::move(kept);
}

void set_targets_at(Warp &warp, nb::handle time, nb::handle targets, nb::handle at, nb::handle period,
                    nb::handle interpolation) {
  const Array times = Array::of<double>(time, "time");
  times.expect({-1});
  const Array frames = Array::of<double>(targets, "targets");
  frames.expect({times.size(0), -1, 3});
  riis_keyframe_arrays arrays;
  call_shortly(riis_keyframe_arrays_init(&arrays, sizeof arrays));
  arrays.n_keys = times.size(0);
  arrays.n_vertices = frames.size(1);
  arrays.time = times.data<double>();
  arrays.xyz = frames.data<double>();
  arrays.period = number(period, "period");
  arrays.interpolation = interpolation_of(interpolation);
  const double moment = number(at, "at");
  const Writing writing(warp.usage, "warp");
  const nb::object kept =
      nb::make_tuple(own_copy(time), own_copy(targets), moment, arrays.period, nb::borrow(interpolation));
  call_to_write(warp.usage, [&] { return riis_warp_set_targets_at(warp.handle, &arrays, moment); });
  warp.targets = kept;
}

nb::object map(Warp &warp, nb::handle given) {
  const PointsOf points(given, "points");
  const Reading reading(warp.usage, "warp");
  const nb::object mapped = own_copy(given);
  const Array written = Array::of<double>(mapped, "mapped", Access::write);
  if (points.points.n_points > 0)
    call_library([&] { return riis_warp_map(warp.handle, &points.points, written.data<double>()); });
  return mapped;
}

nb::object info(Warp &warp) {
  const Reading reading(warp.usage, "warp");
  riis_warp_info found;
  call_shortly(riis_warp_get_info(warp.handle, &found, sizeof found));
  return record("WarpInfo")(found.n_landmarks, found.rms_residual, found.largest_residual, found.largest_landmark_id,
                            found.smoothing, found.least_determinant, array_of(found.least_point, "float64"),
                            found.is_planar != 0);
}

// Returns the values from which pickle makes the warp.
nb::tuple state_of(Warp &warp) {
  warp.usage.check("warp");
  return nb::make_tuple(warp.sources, warp.noise, warp.placement, warp.targets);
}

void make_from_state(Warp *self, const nb::tuple &state) {
  const nb::object noise = state[1];
  create(self, nb::object(state[0]), noise, nb::object(state[2]));
  const nb::object targets = state[3];
  try {
    if (PyTuple_Check(targets.ptr()))
      set_targets_at(*self, nb::object(targets[0]), nb::object(targets[1]), nb::object(targets[2]),
                     nb::object(targets[3]), nb::object(targets[4]));
    else if (!targets.is_none())
      set_targets(*self, targets);
  } catch (...) {
    self->~Warp();
    throw;
  }
}

void set_warp(Valve &valve, nb::handle closed_, nb::handle open_) {
  Warp *closed = closed_.is_none() ? nullptr : &object<Warp>(closed_, "closed");
  Warp *open = open_.is_none() ? nullptr : &object<Warp>(open_, "open");
  for (const auto &[warp, name] : {std::pair(closed, "closed"), std::pair(open, "open")}) {
    if (!warp) continue;
    warp->usage.check(name);
    if (warp->usage.is_written) Reading::refuse_busy(name);
  }
  const Writing writing(valve.usage, "valve");
  nb::object kept = nb::none();
  if (closed) kept = nb::make_tuple(state_of(*closed), open ? nb::object(state_of(*open)) : nb::object(nb::none()));
  call_shortly(riis_valve_set_warp(valve.handle, closed ? closed->handle : nullptr, open ? open->handle : nullptr));
  valve.warp = kept;
}

nb::object patches(Valve &valve) {
  const Writing writing(valve.usage, "valve");
  riis_valve_patches found;
  call_library([&] { return riis_valve_get_patches(valve.handle, &found, sizeof found); });
  const auto n_pieces = static_cast<std::size_t>(found.n_pieces), n = static_cast<std::size_t>(found.n_patches);
  std::size_t n_points = 0;
  for (std::size_t i = 0; i < n_pieces; ++i) n_points += static_cast<std::size_t>(found.degree[i]) + 1;
  return record("ValvePatches")(copy_of(found.first_piece, {static_cast<std::size_t>(found.n_curves) + 1}),
                                copy_of(found.degree, {n_pieces}), copy_of(found.control, {n_points, 3}),
                                copy_of(found.curve_id, {n, 4}), copy_of(found.reversed, {n, 4}),
                                copy_of(found.leaflet_id, {n}), copy_of(found.patch_id, {n}),
                                copy_of(found.attached, {n}), copy_of(found.bulge, {n}));
}

}  // namespace

void warp_as_pickled(nb::handle valve, nb::handle state) {
  if (state.is_none()) return;
  const auto made = [](nb::handle one) {
    if (one.is_none()) return nb::object(nb::none());
    const nb::object warp = nb::type<Warp>().attr("__new__")(nb::type<Warp>());
    warp.attr("__setstate__")(one);
    return warp;
  };
  const nb::object closed = made(nb::object(state[0])), open = made(nb::object(state[1]));
  set_warp(object<Valve>(valve, "valve"), closed, open);
}

void add_warp(nb::module_ &module) {
  nb::class_<Warp> warp(
      module, "Warp",
      R"(A smooth map of space: it takes landmarks on a valve to landmarks in a patient. Its matrix is factored once, so
new targets in each time step cost little.

sources    (n, 3) float64: 3 to 1000 landmarks on the valve at rest
noise      standard deviation of each coordinate of the targets. The map is smoothed until it misses them by about
           that much. With 0 it meets the targets exactly
placement  None: landmarks are in the valve's own coordinates. Otherwise they are in the mesh's, and a dict of scale,
           rotation_axis, rotation_angle and translation places them, as these keywords place the surface

Until set_targets, the warp is the identity. Valve.set_warp gives it to a valve. If the landmarks lie nearly in a plane,
the map stretches across the plane as it does in the plane.)");
  warp.def("__init__", &create, nb::arg("sources").none(), nb::kw_only(), nb::arg("noise").none() = 0.0,
           nb::arg("placement").none() = nb::none(),
           nb::sig("def __init__(self, sources: numpy.typing.NDArray[numpy.float64], *, noise: float = 0.0, placement: "
                   "dict[str, typing.Any] | None = None) -> None"))
      .def("set_targets", &set_targets, nb::arg("targets").none(),
           nb::sig("def set_targets(self, targets: numpy.typing.NDArray[numpy.float64]) -> None"),
           "Takes the landmarks to these places, (n, 3). The same targets give the same bits. A warp that folds is "
           "refused.")
      .def("set_targets_at", &set_targets_at, nb::arg("time").none(), nb::arg("targets").none(), nb::arg("at").none(),
           nb::kw_only(), nb::arg("period").none() = 0.0, nb::arg("interpolation").none() = "linear",
           nb::sig("def set_targets_at(self, time: numpy.typing.NDArray[numpy.float64], targets: "
                   "numpy.typing.NDArray[numpy.float64], at: float, *, period: float = 0.0, interpolation: "
                   "typing.Literal['linear', 'cubic'] = 'linear') -> None"),
           R"(Takes the landmarks to their places at a time, from a table of keys in time.

time           (n_keys,) float64, strictly ascending
targets        (n_keys, n, 3) float64: the landmarks, one key after the other
at             the time
period         > 0: the motion repeats. 0: the landmarks rest before the first key and after the last
interpolation  'linear' or 'cubic', for each coordinate)")
      .def("map", &map, nb::arg("points").none(),
           nb::sig("def map(self, points: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]"),
           "Returns mapped points (n, 3), which are in the coordinates of the landmarks.")
      .def_prop_ro("info", attribute(&info), nb::sig("def info(self) -> riis._records.WarpInfo"),
                   "The quality of the warp: residuals, smoothing, and the least determinant.")
      .def("__getstate__", &state_of, nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def("__setstate__", &make_from_state, nb::arg("state"),
           nb::sig("def __setstate__(self, state: tuple[typing.Any, ...]) -> None"));
  add_closing(warp);
  add_method(module, "Valve", "set_warp", &set_warp, nb::arg("closed").none() = nb::none(),
             nb::arg("open").none() = nb::none(),
             nb::sig("def set_warp(self, closed: Warp | None = None, open: Warp | None = None) -> None"),
             R"(Warps the valve: its curves are mapped at every opening, before the placement.

closed  the warp at opening 0; None removes the warp
open    the warp at opening 1. Between them, both maps are blended. None: closed serves for all openings

The valve copies both. For an annulus that moves, call Warp.set_targets and this method in each step, for two valves in
turn, and pass both to Surface.update_moving.)");
  add_method(module, "Valve", "read_patches", &patches, nb::sig("def read_patches(self) -> riis._records.ValvePatches"),
             "Returns the curves and patches of the valve at its opening, after a warp and before placement.");
}

}  // namespace riis_python
