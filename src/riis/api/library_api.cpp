// SPDX-License-Identifier: Apache-2.0
// Defines the public functions that belong to no handle: the last error, names of statuses, version, log. Counts the calls of a
// thread.
#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "base/log.hpp"

namespace riis {

UsesOfCall *&UsesOfCall::innermost() noexcept {
  static thread_local UsesOfCall *call = nullptr;
  return call;
}

}  // namespace riis

extern "C" {

const char *riis_last_error(void) { return riis::recorded_error(); }

const char *riis_status_name(riis_status status) {
  switch (status) {
    case RIIS_OK:
      return "RIIS_OK";
    case RIIS_INVALID_ARGUMENT:
      return "RIIS_INVALID_ARGUMENT";
    case RIIS_INVALID_STRUCT_SIZE:
      return "RIIS_INVALID_STRUCT_SIZE";
    case RIIS_INVALID_PARAMETER:
      return "RIIS_INVALID_PARAMETER";
    case RIIS_INVALID_SURFACE:
      return "RIIS_INVALID_SURFACE";
    case RIIS_INVALID_MESH:
      return "RIIS_INVALID_MESH";
    case RIIS_LIMIT_EXCEEDED:
      return "RIIS_LIMIT_EXCEEDED";
    case RIIS_OUT_OF_MEMORY:
      return "RIIS_OUT_OF_MEMORY";
    case RIIS_FILE_ERROR:
      return "RIIS_FILE_ERROR";
    case RIIS_UNAVAILABLE:
      return "RIIS_UNAVAILABLE";
    case RIIS_INTERNAL_ERROR:
      return "RIIS_INTERNAL_ERROR";
    default:
      return "unknown status";
  }
}

RIIS_DEFINE_INIT(riis_points_init, riis_points, points, riis::default_points)

void riis_set_log(riis_log_function function, void *user_data) { riis::set_log_function(function, user_data); }

#define RIIS_TEXT_(x) #x
#define RIIS_TEXT(x) RIIS_TEXT_(x)

const char *riis_version_string(void) {
  return RIIS_TEXT(RIIS_VERSION_MAJOR) "." RIIS_TEXT(RIIS_VERSION_MINOR) "." RIIS_TEXT(RIIS_VERSION_PATCH);
}
}
