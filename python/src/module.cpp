// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

#include "arguments.hpp"

NB_MODULE(_riis, module) {
  using namespace riis_python;
  module.doc() = "The compiled half of riis; import riis instead.";
  module.attr("FAR_DISTANCE") = RIIS_FAR_DISTANCE;
  module.def("version_string", &riis_version_string, nb::sig("def version_string() -> str"),
             "Returns the version of the C library, such as '1.0.0'.");
  module.def(
      "status_name", [](nb::handle status) { return riis_status_name(integer32(status, "status")); },
      nb::arg("status").none(), nb::sig("def status_name(status: int) -> str"),
      "Returns the name of a status of the C library.");
  add_log(module);
  add_valve(module);
  add_warp(module);
  add_keyframes(module);
  add_surface(module);
  add_mesh(module);
  add_marking(module);
  add_leaks(module);
  add_loads(module);
  add_laws(module);
  add_patient(module);
  add_measures(module);
}
