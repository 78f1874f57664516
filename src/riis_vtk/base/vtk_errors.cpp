// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/base/vtk_errors.hpp"

#include <cstdio>
#include <exception>
#include <utility>

#include <vtkLogger.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include "common/component.h"

namespace riis::vtk {
namespace {

// The largest length of a path in a message. With this limit, the core's message buffer also has room for the reason.
constexpr std::size_t longest_path = 250;

// Returns the part of VTK's message that helps a user. The message is "ERROR: In FILE, line N\nvtkClass (0xADDRESS):
// message\n\n".
std::string message_of(const std::string &vtk_text) {
  const std::size_t object = vtk_text.find("): ");
  const std::string message = object == std::string::npos ? vtk_text : vtk_text.substr(object + 3);
  std::string line;
  for (const char c : message) {
    const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    if (!blank) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line;
}

// Replaces control characters, so that a message stays on one line. A path may contain any byte, even a line break.
char printable(char c) { return static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c; }
std::string printable(std::string text) {
  for (char &c : text) c = printable(c);
  return text;
}

// This exception is thrown if memory runs out while a file is read or written. The exception contains the text of the message,
// because there may be no memory for a string.
struct OutOfMemory {
  char text[longest_path + 32];
};

}  // namespace

void fail(riis_status status, std::string text) { throw Failure{status, printable(std::move(text))}; }

void fail_reason(const std::string &path, const std::string &reason) {
  const bool fits = path.size() <= longest_path;
  fail(RIIS_FILE_ERROR, joined(fits ? path : "..." + path.substr(path.size() - longest_path), ": ", reason));
}

void fail_memory(const std::string &path) {
  const std::size_t n_left_out = path.size() <= longest_path ? 0 : path.size() - longest_path;
  OutOfMemory failure;
  std::snprintf(failure.text, sizeof failure.text, "%s%s: out of memory", n_left_out == 0 ? "" : "...",
                path.c_str() + n_left_out);
  for (char *c = failure.text; *c; ++c) *c = printable(*c);
  throw failure;
}

void check_core(riis_status status) {
  if (status != RIIS_OK) fail(status, riis_last_error());
}

void check_struct_size(std::int64_t size, std::int64_t first_size, std::int64_t size_here, const char *name) {
  if (size >= first_size && size <= size_here && size % 8 == 0) return;
  fail(RIIS_INVALID_STRUCT_SIZE,
       joined("the struct size of ", name, " is ", size, "; riis ", riis_version_string(), " knows ", first_size,
              " to ", size_here, ": use its init function, and a header no newer than the library"));
}

class CaughtOutput::Window : public vtkOutputWindow {
 public:
  static Window *New();
  vtkTypeMacro(Window, vtkOutputWindow);

  void DisplayText(const char *) override {}
  void DisplayErrorText(const char *text) override {
    if (first_error.empty()) first_error = text;
  }
  void DisplayWarningText(const char *) override {}
  void DisplayGenericWarningText(const char *) override {}
  void DisplayDebugText(const char *) override {}

  std::string first_error;
};
vtkStandardNewMacro(CaughtOutput::Window);

CaughtOutput::CaughtOutput()
    : window_(vtkSmartPointer<Window>::New()),
      caller_window_(vtkOutputWindow::GetInstance()),
      caller_displays_(vtkObject::GetGlobalWarningDisplay()),
      caller_log_level_(vtkLogger::GetCurrentVerbosityCutoff()) {
  vtkOutputWindow::SetInstance(window_);
  // Switches the display of warnings on. If warnings were off, VTK would drop errors before they reach a window.
  vtkObject::SetGlobalWarningDisplay(1);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

CaughtOutput::~CaughtOutput() {
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(caller_log_level_));
  vtkObject::SetGlobalWarningDisplay(caller_displays_);
  vtkOutputWindow::SetInstance(caller_window_);
}

void CaughtOutput::check(const std::string &path) const {
  if (!window_->first_error.empty()) fail_file(path, message_of(window_->first_error));
}

riis_status record_current_exception() noexcept {
  try {
    throw;
  } catch (const Failure &failure) {
    return riis_component_error(failure.status, failure.text.c_str());
  } catch (const OutOfMemory &failure) {
    return riis_component_error(RIIS_OUT_OF_MEMORY, failure.text);
  } catch (const std::bad_alloc &) {
    return riis_component_error(RIIS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception &exception) {
    try {
      return riis_component_error(RIIS_INTERNAL_ERROR, (std::string("internal error: ") + exception.what()).c_str());
    } catch (...) {
      return riis_component_error(RIIS_OUT_OF_MEMORY, "out of memory");
    }
  } catch (...) {
    return riis_component_error(RIIS_INTERNAL_ERROR, "internal error: unknown exception");
  }
}

}  // namespace riis::vtk
