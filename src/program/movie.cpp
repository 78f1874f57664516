// SPDX-License-Identifier: Apache-2.0
#include "program/movie.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "program/interruption.hpp"
#include "program/numbers.hpp"
#include "program/outputs.hpp"
#include "program/refusal.hpp"

extern char **environ;

namespace riis::program {
namespace {

// Returns the program of that name on the PATH, or "" if there is none.
std::string program_on_path(const std::string &name) {
  const char *path = std::getenv("PATH");
  std::string folders = path ? path : "";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const std::string program = folders.substr(begin, end - begin) + "/" + name;
    std::error_code error;
    if (end > begin && std::filesystem::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0)
      return program;
    begin = end + 1;
  }
  return "";
}

[[noreturn]] void refuse_movie(const std::string &path, const std::string &reason) {
  throw Refusal{exit_bad_data, path + ": the movie cannot be made: " + reason};
}

// Returns the name of a frame's file, in which ffmpeg counts.
std::string frame_name(std::size_t number) {
  char text[32];
  std::snprintf(text, sizeof text, "frame_%06zu.png", number);
  return text;
}

// Returns ffmpeg's pattern for the frames. A % of the folder is doubled, because it has a meaning there.
std::string frame_pattern(const std::string &folder) {
  std::string pattern;
  for (const char c : folder) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern + "/frame_%06d.png";
}

std::vector<std::string> encoding_of(const std::string &path) {
  if (has_ending(path, ".gif")) {
    // The palette has the colours of the whole movie, which loops without end.
    return {
        "-filter_complex",
        "scale='min(800,iw)':-2:flags=lanczos,split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=bayer:bayer_scale=5",
        "-loop",
        "0",
        "-f",
        "gif"};
  }
  // Every player knows this kind of H.264.
  return {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"};
}

// Runs a program without a shell. Its messages go to a file. Returns its exit status, or -1 if it did not end by itself.
int run_program_to_log(const std::vector<std::string> &words, const std::string &log) {
  std::vector<char *> arguments;
  for (const std::string &word : words) arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions) != 0) throw std::bad_alloc();
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  const int error = posix_spawn(&process, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw Refusal{exit_bad_data, words[0] + ": cannot be run: " + std::generic_category().message(error)};
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string last_line_of(const std::string &path) {
  std::ifstream file(path);
  std::string last, line;
  while (std::getline(file, line))
    if (!line.empty()) last = line;
  return last.substr(0, 200);
}

}  // namespace

void check_movie(const std::string &path) {
  if (path.empty()) return;
  if (!has_ending(path, ".mp4") && !has_ending(path, ".gif"))
    throw Refusal{exit_wrong_usage, "--movie: " + path + " must end in .mp4 or .gif"};
  if (program_on_path("ffmpeg").empty())
    throw Refusal{exit_bad_data,
                  "--movie needs the program ffmpeg, which is not on the PATH; on Debian the package ffmpeg has it"};
}

Movie::Movie(const std::string &path, double frame_rate) : path_(path), frame_rate_(frame_rate) {
  std::string folder = (std::filesystem::temp_directory_path() / "riis-mark-XXXXXX").string();
  if (!mkdtemp(folder.data())) refuse_movie(path, folder + ": " + std::generic_category().message(errno));
  folder_ = folder;
}

Movie::~Movie() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Movie::next_frame() { return folder_ + "/" + frame_name(n_frames_++); }

void Movie::encode() const {
  const UnbrokenWrite unbroken;
  const std::filesystem::path place = place_of(path_);
  const std::string temporary = (folder_of(place) / (".riis-" + std::to_string(getpid()) + "-movie.tmp")).string();
  const std::string log = folder_ + "/ffmpeg.log";
  std::vector<std::string> words = {
      program_on_path("ffmpeg"), "-nostdin", "-loglevel",           "error", "-y", "-framerate",
      shortest(frame_rate_),     "-i",       frame_pattern(folder_)};
  const std::vector<std::string> encoding = encoding_of(path_);
  words.insert(words.end(), encoding.begin(), encoding.end());
  words.push_back(temporary);
  const int status = run_program_to_log(words, log);
  if (status == 0 && std::rename(temporary.c_str(), place.c_str()) == 0) return;
  const int error = errno;
  std::remove(temporary.c_str());
  // The user's Ctrl-C also reaches ffmpeg.
  if (UnbrokenWrite::has_signal()) return;
  if (status == 0) refuse_movie(path_, std::generic_category().message(error));
  refuse_movie(path_, "ffmpeg ends with status " + std::to_string(status) + ": " + last_line_of(log));
}

}  // namespace riis::program
