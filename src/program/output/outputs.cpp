// SPDX-License-Identifier: Apache-2.0
#include "program/output/outputs.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/base/virtual_display.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/input/valve_file.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/marked_files.hpp"

namespace riis::program {

namespace {

namespace fs = std::filesystem;

void check_ending(const std::string &path, const std::string &ending, const std::string &option) {
  if (!has_ending(path, ending)) refuse_usage(option + ": " + path + " must end in " + ending);
}

[[noreturn]] void cannot_be_written(const std::string &path, const std::string &reason) {
  refuse_data(path + ": cannot be written: " + reason);
}

// Returns whether the path is a device or a pipe. The program writes into a device or a pipe, but replaces any other file as a
// whole.
bool is_special(const std::string &path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_regular_file(path, error);
}

void check_place(const std::string &path) {
  std::error_code error;
  if (fs::is_directory(path, error)) refuse_data(path + ": is a directory");
  const fs::path folder = folder_of(place_of(path));
  if (!fs::is_directory(folder, error)) cannot_be_written(path, "the folder " + folder.string() + " does not exist");
  // A new file is written beside the old file, and then replaces it.
  if (!is_special(path) && access(folder.c_str(), W_OK | X_OK) != 0) {
    cannot_be_written(path, "the folder " + folder.string() + ": " + system_text(errno));
  }
  if (fs::exists(path, error) && access(path.c_str(), W_OK) != 0) cannot_be_written(path, system_text(errno));
}

struct NamedFile {
  std::string option, path;
  std::string ending{};  // the required ending of the file; "": any ending
};

using NamedFiles = std::vector<NamedFile>;

NamedFiles inputs_of(const ValveOptions &options) {
  NamedFiles inputs = {{"--params", options.params},
                       {"--params-open", options.params_open},
                       {"--wall", options.wall},
                       {"--warp", options.warp},
                       {"--valve", is_valve_file(options.valve) ? options.valve : options.placed}};
  for (const std::string &path : options.surface_files) inputs.push_back({"--surface", path});
  return inputs;
}

NamedFiles inputs_of(const MarkOptions &options, const std::vector<std::string> &more_inputs) {
  NamedFiles inputs = inputs_of(static_cast<const ValveOptions &>(options));
  const SeriesOptions &series = options.series;
  for (const NamedFile &input :
       {NamedFile{"MESH", options.mesh}, {"--cycle", series.cycle}, {"--case", series.case_file}})
    inputs.push_back(input);
  for (const std::string &path : more_inputs)
    inputs.push_back({series.case_file.empty() ? "--surface" : "--case", path});
  for (const std::string &path : options.pieces) inputs.push_back({"MESH", path});
  for (const std::string &path : data_files_of(options.mesh)) inputs.push_back({"MESH", path});
  return inputs;
}

// Returns the path of the file with the numbers of an .xdmf file.
std::string numbers_of(const std::string &xdmf) { return fs::path(xdmf).replace_extension("h5").string(); }

NamedFiles outputs_of(const MarkOptions &options) {
  // Fields of OpenFOAM go into a folder.
  const bool is_folder = is_foam_case(options.output) || is_foam_time(options.output);
  const bool is_series = !options.series.times.empty();
  NamedFiles outputs = {{"--output", is_folder ? "" : options.output},
                        {options.surface_output_option, options.surface_output, is_series ? ".pvd" : ".vtp"}};
  if (has_ending(options.output, ".xdmf")) outputs.push_back({"--output", numbers_of(options.output)});
  for (const Picture &picture : options.pictures) outputs.push_back({"--picture", picture.path, ".png"});
  if (options.stats != "-") outputs.push_back({"--stats", options.stats});
  outputs.push_back({"--movie", options.series.movie});
  outputs.push_back({"--series-table", options.series.table});
  return outputs;
}

// Returns a text that is the same for all paths that lead to one file. The text consists of the device and the inode, or of the
// path if the file does not exist.
std::string identity_of(const std::string &path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path : place.string();
}

// Maps the identity of a file to the option that named the file.
using KnownFiles = std::map<std::string, std::string>;

KnownFiles known(const NamedFiles &files) {
  KnownFiles known;
  for (const NamedFile &file : files)
    if (!file.path.empty()) known.emplace(identity_of(file.path), file.option);
  return known;
}

// Refuses a folder for the steps' files if the folder contains an input, or a link to an input. A step's file could replace the
// input.
void check_folder_of_steps(const std::string &option, const std::string &folder, const KnownFiles &inputs) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const auto input = inputs.find(identity_of(at->path().string()));
    if (input == inputs.end()) continue;
    refuse_usage(option + ": the folder of its files, " + folder + ", holds the file of " + input->second);
  }
  if (error == std::errc::permission_denied) refuse_data(folder + ": the folder cannot be read: " + error.message());
}

void check_distinct(const KnownFiles &inputs, const NamedFiles &files) {
  KnownFiles outputs;
  for (const NamedFile &output : files) {
    if (output.path.empty()) continue;
    const std::string identity = identity_of(output.path);
    const auto input = inputs.find(identity);
    const auto [other, is_new] = outputs.emplace(identity, output.option);
    if (input == inputs.end() && is_new) continue;
    refuse_usage(output.option + ": " + output.path + " is also the file of " + (is_new ? input : other)->second);
  }
}

OutputLocks locks_of(const NamedFiles &outputs) {
  std::vector<std::string> written;
  for (const NamedFile &output : outputs)
    if (!output.path.empty() && !is_special(output.path)) written.push_back(output.path);
  return OutputLocks(written);
}

// Refuses a picture before all other work if the machine has neither a display nor a program that makes one.
void check_display() {
  const char *display = std::getenv("DISPLAY");
  if (!display || !*display) check_virtual_display();
}

// Writes the text to a file. Returns the system's error, or 0 if there is none.
int write_through(const std::string &path, const char *mode, const std::string &text) {
  std::FILE *file = std::fopen(path.c_str(), mode);
  if (!file) return errno;
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
  const int error = written ? 0 : errno;
  return std::fclose(file) == 0 || error ? error : errno;
}

int replace_file(const std::string &path, const std::string &text) {
  const UnbrokenWrite unbroken;
  const fs::path place = place_of(path);
  const std::string temporary = (folder_of(place) / (".riis-" + std::to_string(getpid()) + "-text.tmp")).string();
  std::remove(temporary.c_str());  // removes a file with this name that an ended process left behind
  int error = write_through(temporary, "wx", text);
  if (!error && std::rename(temporary.c_str(), place.c_str()) != 0) error = errno;
  if (error) std::remove(temporary.c_str());
  return error;
}

}  // namespace

fs::path place_of(const std::string &path) {
  std::error_code error;
  const fs::path place = fs::canonical(path, error);
  return error ? fs::path(path) : place;
}

fs::path folder_of(const fs::path &place) { return place.has_parent_path() ? place.parent_path() : fs::path("."); }

namespace {

// Returns whether the output is a grid, whose file stores axes instead of points. The file of the mesh must have a format for
// grids.
bool is_grid_of(const std::string &mesh, const std::string &output) {
  if (!has_ending(output, ".vti") && !has_ending(output, ".vtr")) return false;
  return has_ending(mesh, ".vti") || has_ending(mesh, ".vtr") || has_ending(mesh, ".vtk");
}

// Checks --output, which names a file, a time of an OpenFOAM case or, for a series, a whole OpenFOAM case.
void check_output(const MarkOptions &options, bool is_series, bool has_pieces) {
  const std::string &path = options.output;
  if (path.empty()) return;
  if (!has_pieces && (is_series ? is_foam_case(path) : is_foam_time(path))) {
    if (!options.at_cells) refuse_usage("--output: " + path + " takes fields of cells: write --cells");
    const fs::path folder = is_series ? fs::path(path) : folder_of(place_of(path));
    if (access(folder.c_str(), W_OK | X_OK) != 0) cannot_be_written(path, system_text(errno));
    return;
  }
  if (is_series)
    check_ending(path, ".pvd", "--output");
  else if (has_pieces || !(has_ending(path, ".xdmf") || is_grid_of(options.mesh, path)))
    check_ending(path, has_pieces ? ".pvtu" : ".vtu", "--output");
}

// Checks that all outputs can be written.
void check_files(const NamedFiles &outputs) {
  for (const auto &[option, path, ending] : outputs) {
    if (path.empty()) continue;
    if (!ending.empty()) check_ending(path, ending, option);
    check_place(path);
  }
}

}  // namespace

OutputLocks check_outputs(const MarkOptions &options, const std::vector<std::string> &more_inputs) {
  // The ranks of a run share their outputs. In a process, the first object of this type checks and locks the files.
  if (!ranks::is_first()) return OutputLocks({});
  const KnownFiles inputs = known(inputs_of(options, more_inputs));
  const NamedFiles outputs = outputs_of(options);
  const bool is_series = !options.series.times.empty();
  const bool has_pieces = !options.pieces.empty();  // then the pieces are written to a folder, as the steps of a series
  check_distinct(inputs, outputs);
  std::vector<SeriesFiles> folders;
  for (const auto &[option, path] :
       {std::pair<const char *, std::string>{"--output", options.output}, {"--surface-output", options.surface_output}})
    if (!path.empty() && !is_foam_case(path) && (is_series || (has_pieces && path == options.output))) {
      folders.emplace_back(path, "", 1);
      check_folder_of_steps(option, folders.back().folder(), inputs);
    }
  check_output(options, is_series, has_pieces);
  check_files(outputs);
  for (const SeriesFiles &files : folders) files.check_folder();
  if (!options.pictures.empty() || !options.series.movie.empty()) check_display();
  return locks_of(outputs);
}

namespace {

// Checks the outputs of a command that writes only texts. One of the outputs may be "-", which stands for stdout.
OutputLocks check_texts(const NamedFiles &inputs, const NamedFiles &texts) {
  NamedFiles files;
  std::string on_stdout;
  for (const NamedFile &text : texts) {
    if (text.path != "-") {
      files.push_back(text);
      continue;
    }
    if (!on_stdout.empty()) refuse_usage(text.option + " and " + on_stdout + " cannot both be on standard output");
    on_stdout = text.option;
  }
  check_distinct(known(inputs), files);
  check_files(files);
  return locks_of(files);
}

}  // namespace

OutputLocks check_outputs(const SizeFieldOptions &options, const std::vector<std::string> &more_inputs) {
  return check_texts(inputs_of(options, more_inputs), {{"OUT", options.field}});
}

OutputLocks check_outputs(const StatesOptions &options) {
  return check_texts(inputs_of(options), {{"OUT", options.output}});
}

OutputLocks check_outputs(const AreaOptions &options) {
  NamedFiles inputs = inputs_of(options);
  inputs.push_back({"--areas", options.areas});
  return check_texts(inputs, {{"--output", options.output}});
}

OutputLocks check_outputs(const PlaceOptions &options) {
  NamedFiles inputs = inputs_of(options);
  inputs.push_back({"LANDMARKS", options.landmarks});
  inputs.push_back({"--mesh", options.mesh});
  return check_texts(inputs, {{"--output", options.output},
                              {"--foam", options.foam_output},
                              {"--c", options.c_output},
                              {"--fortran", options.fortran_output}});
}

void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const MarkOptions &options) {
  std::set<std::string> identities;
  for (const std::string &file : files) identities.insert(identity_of(file));
  for (const NamedFile &output : outputs_of(options)) {
    if (!output.path.empty() && identities.count(identity_of(output.path)) != 0)
      refuse_usage(output.option + ": " + output.path + " is " + what);
  }
}

bool can_be_replaced(const std::string &path) { return path != "-" && !is_special(path); }

void write_text(const std::string &path, const std::string &text) {
  if (!ranks::is_first()) return;
  if (path == "-") {
    if (!(std::cout << text << std::flush)) refuse_data("standard output: cannot be written");
    return;
  }
  if (const int error = is_special(path) ? write_through(path, "w", text) : replace_file(path, text)) {
    cannot_be_written(path, system_text(error));
  }
}

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  path_ = ((error ? fs::path("/tmp") : place) / "riis-XXXXXX").string();
  if (!mkdtemp(path_.data()))
    refuse_data("no temporary folder can be made in " + folder_of(path_).string() + ": " + system_text(errno) +
                "; TMPDIR may name another place");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

// ---- Output locks ----

namespace {

// The lock files of this process. Only the first OutputLocks object of a process has lock files. The first object fills the list
// before the signal handlers are set.
std::vector<std::string> held_locks;

// A file of this process, and the folder that contains it. A signal that ends the process removes the file and the folder. An
// empty name stands for no file or no folder.
char scratch_file[PATH_MAX], scratch_folder[PATH_MAX];
std::atomic<const char *> last_words{nullptr};

void remove_held() {
  for (const std::string &path : held_locks) unlink(path.c_str());
}

// Removes the lock files, and raises the signal again. The signal is blocked until the handler returns. When the handler returns,
// the signal ends the process.
void remove_and_end(int signal) {
  remove_held();
  unlink(scratch_file);
  rmdir(scratch_folder);
  if (const char *const words = last_words) {
    const auto n_written = write(STDERR_FILENO, words, std::strlen(words));
    static_cast<void>(n_written);  // the process ends in any case
  }
  std::raise(signal);
}

void set_handlers(void (*from)(int), void (*to)(int)) {
  struct sigaction action {};
  action.sa_handler = to;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : UnbrokenWrite::signals) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == from) sigaction(signal, &action, nullptr);
  }
}

// While an object of this type lives, signals that end the process are blocked. Therefore no signal can come between the making
// of a lock file and the setting of the handlers.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int signal : UnbrokenWrite::signals) sigaddset(&ending, signal);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait &) = delete;
  SignalsWait &operator=(const SignalsWait &) = delete;

 private:
  sigset_t before_{};
};

// Returns the path of an output's lock. If the output's name is too long, only its end is used.
std::string lock_of(const std::string &output) {
  constexpr std::size_t longest = 200;
  const std::filesystem::path place = std::filesystem::absolute(place_of(output));
  const std::string name = place.filename().string();
  return (place.parent_path() / (".riis-" + name.substr(name.size() - std::min(name.size(), longest)) + ".lock"))
      .string();
}

[[noreturn]] void refuse_lock(const std::string &output, const std::string &reason) {
  refuse_data(output + ": " + reason);
}

bool is_at(int file, const std::string &path) {
  struct stat opened {};
  struct stat there {};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &there) == 0 && opened.st_ino == there.st_ino &&
         opened.st_dev == there.st_dev;
}

// Takes the lock, and returns the descriptor of the lock file. Returns -1 if the file system has no locks.
int take(const std::string &output, const std::string &lock) {
  for (;;) {
    int file = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    // The lock file may be left over from another user's run that was killed. Read permission for the lock file suffices for a
    // lock.
    if (file < 0 && errno == EACCES) file = open(lock.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) refuse_lock(output, "its lock " + lock + " cannot be made: " + system_text(errno));
    if (flock(file, LOCK_EX | LOCK_NB) == 0) {
      if (is_at(file, lock)) return file;
      close(file);  // the run that held the lock has just removed the lock file, so this run makes a new one
      continue;
    }
    const int error = errno;
    close(file);
    if (error == EINTR) continue;
    if (error == EWOULDBLOCK) refuse_lock(output, "another run of riis is writing it, and holds " + lock);
    warn(output + ": it cannot be locked, so other runs may write it at the same time: " + system_text(error));
    unlink(lock.c_str());
    return -1;
  }
}

}  // namespace

void remove_if_ended(const std::string &folder, const std::string &file) {
  if (folder.size() >= PATH_MAX || file.size() >= PATH_MAX) return;
  const SignalsWait wait;
  std::strcpy(scratch_folder, folder.c_str());
  std::strcpy(scratch_file, file.c_str());
}

void say_if_ended(const char *text) { last_words = text; }

OutputLocks::OutputLocks(const std::vector<std::string> &paths) {
  const SignalsWait wait;
  try {
    for (const std::string &path : paths) {
      const std::string lock = lock_of(path);
      // Several outputs with long names may have one lock, because the lock's name has only the end of the output's name.
      if (std::find(held_locks.begin(), held_locks.end(), lock) != held_locks.end()) continue;
      const int file = take(path, lock);
      if (file < 0) continue;
      files_.push_back(file);
      held_locks.push_back(lock);
    }
  } catch (...) {
    release();
    throw;
  }
  set_handlers(SIG_DFL, remove_and_end);
}

OutputLocks::~OutputLocks() { release(); }

void OutputLocks::release() {
  if (files_.empty()) return;
  remove_held();  // the files are removed before the locks are released, because afterwards another run could hold them
  set_handlers(remove_and_end, SIG_DFL);
  for (const int file : files_) close(file);
  files_.clear();
  held_locks.clear();
}

// ---- Interruption ----

namespace {

volatile std::sig_atomic_t waiting_signal = 0;
std::atomic<int> n_alive{0};

void keep_for_later(int signal) { waiting_signal = signal; }

}  // namespace

UnbrokenWrite::UnbrokenWrite() {
  if (n_alive++ > 0) return;
  struct sigaction keep {};
  keep.sa_handler = keep_for_later;
  keep.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (int i = 0; i < 3; ++i) {
    sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(signals[i], &keep, nullptr);
  }
}

UnbrokenWrite::~UnbrokenWrite() {
  if (--n_alive > 0) return;
  for (int i = 0; i < 3; ++i) sigaction(signals[i], &before_[i], nullptr);
  if (waiting_signal != 0) std::raise(waiting_signal);
}

bool UnbrokenWrite::has_signal() { return waiting_signal != 0; }

}  // namespace riis::program
