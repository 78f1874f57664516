// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"
#include "surface.hpp"

namespace riis_python {
namespace {

void create(Keyframes *self, nb::handle time, nb::handle vertices, nb::handle faces, nb::handle leaflet_id,
            nb::handle period, nb::handle interpolation, nb::handle index_base, nb::handle skirt_length,
            nb::handle attached, nb::handle skirt_lengths) {
  const Array times = Array::of<double>(time, "time");
  times.expect({-1});
  const Array frames = Array::of<double>(vertices, "vertices");
  frames.expect({times.size(0), -1, 3});
  FaceArrays of_faces(faces, leaflet_id, index_base);
  of_faces.arrays.n_vertices = frames.size(1);
  of_faces.set_skirt({skirt_length, attached, skirt_lengths});
  riis_keyframe_arrays arrays;
  call_shortly(riis_keyframe_arrays_init(&arrays, sizeof arrays));
  arrays.n_keys = times.size(0);
  arrays.n_vertices = frames.size(1);
  arrays.time = times.data<double>();
  arrays.xyz = frames.data<double>();
  arrays.period = number(period, "period");
  arrays.interpolation = interpolation_of(interpolation);
  new (self) Keyframes();
  try {
    call_library([&] { return riis_keyframes_create(&of_faces.arrays, &arrays, &self->handle); });
  } catch (...) {
    self->~Keyframes();
    throw;
  }
}

}  // namespace

std::int32_t interpolation_of(nb::handle value) {
  return choice(value, "interpolation", {{"linear", RIIS_INTERPOLATION_LINEAR}, {"cubic", RIIS_INTERPOLATION_CUBIC}});
}

void add_keyframes(nb::module_ &module) {
  nb::class_<Keyframes> keyframes(module, "Keyframes",
                                  R"(A surface that moves by frames. All frames have the same faces.

time           (n_keys,) float64, strictly ascending
vertices       (n_keys, n_vertices, 3) float64: the positions in one frame after the other
faces          (n_faces, 3 or 4) int32 or int64: vertex numbers from index_base
leaflet_id     (n_faces,) int32, >= 0; default 0
period         > 0: the motion repeats. 0: the surface rests before the first frame and after the last
interpolation  'linear' or 'cubic', for each coordinate
skirt_length, attached, skirt_lengths
               as in Surface.from_arrays; the attachment of the first frame stays

Arrays are copied.)");
  keyframes.def(
      "__init__", &create, nb::arg("time").none(), nb::arg("vertices").none(), nb::arg("faces").none(), nb::kw_only(),
      nb::arg("leaflet_id").none() = nb::none(), nb::arg("period").none() = 0.0,
      nb::arg("interpolation").none() = "linear", nb::arg("index_base").none() = 0,
      nb::arg("skirt_length").none() = 0.0, nb::arg("attached").none() = nb::none(),
      nb::arg("skirt_lengths").none() = nb::none(),
      nb::sig("def __init__(self, time: numpy.typing.NDArray[numpy.float64], vertices: "
              "numpy.typing.NDArray[numpy.float64], faces: numpy.typing.NDArray[numpy.integer], *, leaflet_id: "
              "numpy.typing.NDArray[numpy.int32] | None = None, period: float = 0.0, interpolation: "
              "typing.Literal['linear', 'cubic'] = 'linear', index_base: int = 0, " RIIS_SKIRT ") -> None"));
  refuse_pickle(keyframes, "keep the arrays, and make the keyframes from them");
  add_closing(keyframes);
}

}  // namespace riis_python
