// SPDX-License-Identifier: Apache-2.0
#include "api/errors.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "api/component.h"

namespace riis {
namespace {

thread_local char last_error[error_text_size] = "";

}  // namespace

void fail(riis_status status, const char *format, ...) {
  Error error{status, {}};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(error.text, sizeof error.text, format, arguments);
  va_end(arguments);
  throw error;
}

riis_status record_error(riis_status status, const char *text) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s", text);
  return status;
}

riis_status record_current_exception() noexcept {
  try {
    throw;
  } catch (const Error &error) {
    return record_error(error.status, error.text);
  } catch (const std::bad_alloc &) {
    return record_error(RIIS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error &) {  // a container asked for more than memory can hold
    return record_error(RIIS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception &exception) {
    char text[error_text_size];
    std::snprintf(text, sizeof text, "internal error: %s", exception.what());
    return record_error(RIIS_INTERNAL_ERROR, text);
  } catch (...) {
    return record_error(RIIS_INTERNAL_ERROR, "internal error: unknown exception");
  }
}

}  // namespace riis

extern "C" {

const char *riis_last_error(void) { return riis::last_error; }

riis_status riis_component_error(riis_status status, const char *text) { return riis::record_error(status, text); }

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

void riis_version(int32_t *major, int32_t *minor, int32_t *patch) {
  if (major) *major = RIIS_VERSION_MAJOR;
  if (minor) *minor = RIIS_VERSION_MINOR;
  if (patch) *patch = RIIS_VERSION_PATCH;
}

#define RIIS_TEXT_(x) #x
#define RIIS_TEXT(x) RIIS_TEXT_(x)

const char *riis_version_string(void) {
  return RIIS_TEXT(RIIS_VERSION_MAJOR) "." RIIS_TEXT(RIIS_VERSION_MINOR) "." RIIS_TEXT(RIIS_VERSION_PATCH);
}
}
