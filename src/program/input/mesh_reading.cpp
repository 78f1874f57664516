// SPDX-License-Identifier: Apache-2.0
#include "program/input/mesh_reading.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "program/base/refusal.hpp"
#include "program/base/system.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

// Returns whether a damaged file of this format can crash its reader. HDF5's reader and VTK's reader of Exodus can crash.
bool may_crash(const std::string &path) {
  static const std::set<std::string> endings = {".xdmf", ".xmf", ".e", ".exo", ".ex2", ".exii"};
  return endings.count(ending_of(path)) != 0;
}

// A folder for the mesh that a child process has read. If a signal ends this process, the folder is removed.
class PassingFolder {
 public:
  PassingFolder() { remove_if_ended(folder_.path(), mesh()); }
  ~PassingFolder() { remove_if_ended("", ""); }
  PassingFolder(const PassingFolder &) = delete;
  PassingFolder &operator=(const PassingFolder &) = delete;

  std::string mesh() const { return folder_.path() + "/mesh.vtu"; }

 private:
  const TemporaryFolder folder_;
};

// Limits the memory of this process, because damaged files may claim any size. To read an undamaged file, the process needs a few
// times the file's size in memory. For a compressed file, it may need a thousand times the file's size. Builds with the address
// sanitizer have no limit, because the sanitizer reserves terabytes.
void limit_memory([[maybe_unused]] const std::string &path) {
#ifndef __SANITIZE_ADDRESS__
  std::error_code error;
  std::uintmax_t size = fs::file_size(path, error);
  for (const std::string &file : data_files_of(path)) {
    std::error_code unknown;
    const std::uintmax_t more = fs::file_size(file, unknown);
    if (!unknown) size += more;
  }
  const auto now = limited_memory();
  if (error || !now) return;
  constexpr rlim_t base = rlim_t{2} << 30, per_byte = 1000;
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, *now + base + per_byte * size);
  setrlimit(RLIMIT_AS, &limit);
#endif
}

// The result of the child process: a status, and notes about the mesh or an error message.
struct Answer {
  riis_status status = RIIS_INTERNAL_ERROR;
  std::string text;
};

// Reads the mesh, writes it to a .vtu file, and sends the result through the pipe.
[[noreturn]] void read_as_child(const std::string &path, const std::string &passed, int answer, pid_t parent) {
  // Readers print their own errors, which the child process discards. The child process sends its message through the pipe.
  const int nowhere = open("/dev/null", O_WRONLY);
  // The child process ends with its parent, and does not remove the parent's files.
  for (const int ending : UnbrokenWrite::signals)
    if (signal(ending, SIG_DFL) == SIG_IGN) signal(ending, SIG_IGN);
  end_with_parent(SIGKILL);
  if (getppid() != parent) _exit(1);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  limit_memory(path);
  riis_vtk_mesh *mesh = nullptr;
  riis_status status = riis_vtk_mesh_read(path.c_str(), &mesh);
  const char *notes = "";
  if (status == RIIS_OK) status = riis_vtk_mesh_get_notes(mesh, &notes);
  if (status == RIIS_OK) status = riis_vtk_mesh_write(mesh, passed.c_str());
  const char *const text = status == RIIS_OK ? notes : riis_last_error();
  // The text is short, so one call of write puts all of it into the pipe.
  const auto n_bytes = static_cast<ssize_t>(std::strlen(text));
  const bool is_written =
      write(answer, &status, sizeof status) == sizeof status && write(answer, text, std::strlen(text)) == n_bytes;
  _exit(is_written ? 0 : 1);
}

Answer answer_of(int from) {
  Answer answer;
  char bytes[4096];
  std::string all;
  for (;;) {
    const ssize_t n = read(from, bytes, sizeof bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    all.append(bytes, static_cast<std::size_t>(n));
  }
  if (all.size() < sizeof answer.status) return answer;
  std::memcpy(&answer.status, all.data(), sizeof answer.status);
  answer.text = all.substr(sizeof answer.status);
  return answer;
}

std::string kept_notes;

void note(const std::string &path, const std::string &text) {
  if (!text.empty()) kept_notes += "note      " + path + ": " + text + "\n";
}

MeshFile read_by_child(const std::string &path) {
  const PassingFolder folder;
  int ends[2];
  if (pipe(ends) != 0) refuse_data(std::string("no pipe to a child process: ") + system_text(errno));
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    refuse_data(std::string("no child process to read ") + path + ": " + system_text(errno));
  }
  if (child == 0) read_as_child(path, folder.mesh(), ends[1], parent);
  close(ends[1]);
  const Answer answer = answer_of(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status))
    refuse_data(path + ": is damaged: its reader ended with signal " + std::to_string(WTERMSIG(status)) + " (" +
                strsignal(WTERMSIG(status)) + ")");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    refuse_data(path + ": is damaged: its reader ended with status " + std::to_string(WEXITSTATUS(status)));
  if (answer.status == RIIS_OUT_OF_MEMORY)
    refuse_data(answer.text + "; the reader of a file gets 2 GB plus a thousand times the size of the file");
  if (answer.status != RIIS_OK)
    throw Refusal{
        exit_bad_data,
        answer.text + (answer.status == RIIS_FILE_ERROR ? conversion_hint(path, Content::mesh, answer.text) : "")};
  note(path, answer.text);
  return create<MeshFile>(riis_vtk_mesh_read, folder.mesh().c_str());
}

bool has_poly_mesh(const fs::path &folder) {
  std::error_code error;
  return fs::is_directory(folder / "constant" / "polyMesh", error);
}

}  // namespace

std::vector<std::string> data_files_of(const std::string &path) {
  if (!has_ending(path, ".xdmf") && !has_ending(path, ".xmf")) return {};
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::vector<std::string> found;
  constexpr std::size_t longest = PATH_MAX;
  while (std::getline(file, text, '<')) {
    text.erase(0, text.find('>') + 1);
    if (text.size() > longest) continue;  // numbers, not a file's name
    const std::size_t begin = text.find_first_not_of(" \t\r\n"), end = text.find_last_not_of(" \t\r\n");
    if (begin == std::string::npos) continue;
    text = text.substr(begin, end + 1 - begin);
    // A dataset may follow the file's name, as in FILE.h5:/DATASET. The slash may be missing.
    for (const char *separator : {":/", ":"}) {
      const fs::path place = fs::path(path).parent_path() / text.substr(0, text.find(separator));
      std::error_code error;
      if (!fs::is_regular_file(place, error)) continue;
      found.push_back(place.string());
      break;
    }
  }
  return found;
}

namespace {

MeshFile read_here(const std::string &path) {
  MeshFile file;
  check_read(riis_vtk_mesh_read(path.c_str(), file.out()), path, Content::mesh);
  const char *text = nullptr;
  check(riis_vtk_mesh_get_notes(file, &text));
  note(path, text);
  return file;
}

}  // namespace

MeshFile read_mesh_file(const std::string &path, const std::string &cells_where) {
  MeshFile file = may_crash(path) ? read_by_child(path) : read_here(path);
  if (!cells_where.empty()) check(riis_vtk_mesh_choose_cells(file, cells_where.c_str(), nullptr));
  return file;
}

std::string text_of_regions(const std::string &path, riis_vtk_mesh *mesh) {
  constexpr std::int64_t most_listed = 4;
  const char *array = nullptr;
  std::int64_t n = 0;
  const double *values = nullptr;
  check(riis_vtk_mesh_find_regions(mesh, &array, &n, &values));
  if (n == 0) return "";
  std::string list;
  for (std::int64_t i = 0; i < std::min(n, most_listed); ++i)
    list += (i == 0 ? "" : i + 1 == n ? " and " : ", ") + shortest(values[i]);
  return path + " has the regions " + list + (n > most_listed ? ", ..." : "") + " of the cell array " + array +
         ", and they touch: --cells-where " + array + "=" + shortest(values[0]) + " takes only the cells of one region";
}

std::string take_notes() { return std::exchange(kept_notes, ""); }

bool is_foam_case(const std::string &path) { return has_poly_mesh(path); }

bool is_foam_time(const std::string &path) {
  fs::path folder = path;
  if (!folder.has_filename()) folder = folder.parent_path();
  const std::string name = folder.filename().string();
  return number_in(name) && has_poly_mesh(folder_of(folder));
}

std::string foam_time(const std::string &foam_case, double time) {
  return (fs::path(foam_case) / shortest(time)).string();
}

}  // namespace riis::program
