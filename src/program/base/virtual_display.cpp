// SPDX-License-Identifier: Apache-2.0
#include "program/base/virtual_display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include "program/base/other_program.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"

namespace riis::program {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds longest_start{30000};  // of Xvfb; it takes less than a second on an idle machine
constexpr milliseconds longest_end{3000};
constexpr const char *name_of_server = "Xvfb";

// The numbers that the file descriptors have in Xvfb.
enum ServerFile : int { display_file = 3, key_file = 4, n_server_files = 5 };

// A file descriptor whose number is so large that Xvfb's files cannot replace it.
class File {
 public:
  explicit File(int low) : number_(low < 0 ? -1 : fcntl(low, F_DUPFD_CLOEXEC, 10)) {
    if (low >= 0) close(low);
  }
  ~File() { reset(); }
  File(const File &) = delete;
  File &operator=(const File &) = delete;
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  int release() { return std::exchange(number_, -1); }
  void reset() {
    if (number_ >= 0) close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

[[noreturn]] void refuse(const std::string &what) {
  const char *display = std::getenv("DISPLAY");
  const bool is_set = display != nullptr && *display != '\0';
  refuse_data("a picture needs an X display: DISPLAY " +
              (is_set ? display + std::string(" cannot be used") : "is not set") + ", and " + name_of_server + what);
}

std::optional<std::string> variable(const char *name) {
  const char *text = std::getenv(name);
  return text ? std::optional<std::string>(text) : std::nullopt;
}

void set_variable(const char *name, const std::optional<std::string> &text) {
  text ? setenv(name, text->c_str(), 1) : unsetenv(name);
}

bool write_all(int file, const std::vector<unsigned char> &bytes) {
  return write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

// Makes a file in memory with a random key, in the format of Xauthority files. The key is valid for any host and any display.
int file_with_key() {
  std::vector<unsigned char> bytes;
  const auto append = [&bytes](const std::string &text) {
    bytes.push_back(static_cast<unsigned char>(text.size() >> 8U));
    bytes.push_back(static_cast<unsigned char>(text.size() & 0xffU));
    bytes.insert(bytes.end(), text.begin(), text.end());
  };
  std::string key(16, '\0');
  if (getrandom(&key[0], key.size(), 0) != static_cast<ssize_t>(key.size())) return -1;
  bytes = {0xff, 0xff};  // of any family of hosts
  for (const std::string &field : {std::string(), std::string(), std::string("MIT-MAGIC-COOKIE-1"), key}) append(field);
  const int file = memfd_create("riis-display", MFD_CLOEXEC);
  if (file >= 0 && write_all(file, bytes)) return file;
  if (file >= 0) close(file);
  return -1;
}

// Turns this process into Xvfb. The function runs between fork and exec, so it calls only functions that are safe in a signal
// handler.
[[noreturn]] void become_server(char *const *words, pid_t parent, int display, int key, int messages) {
  setsid();  // so that the user's Ctrl-C does not reach Xvfb before a file is complete
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGXFSZ, SIGUSR1}) std::signal(signal, SIG_DFL);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(messages, STDERR_FILENO);
  dup2(display, display_file);
  dup2(key, key_file);
  syscall(SYS_close_range, static_cast<unsigned>(n_server_files), ~0U, 0U);
  execv(words[0], words);
  _exit(127);
}

// Reads the number of the display from Xvfb. Xvfb writes the number and a line break when it is ready. Returns "" if Xvfb has
// ended, or if no time is left.
std::string read_number(int file, Clock::time_point end) {
  std::string text;
  for (;;) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now()).count();
    pollfd ready{file, POLLIN, 0};
    if (left <= 0) return "";
    const int n_ready = poll(&ready, 1, static_cast<int>(left));
    if (n_ready < 0 && errno != EINTR) return "";
    if (n_ready <= 0) continue;
    char c = 0;
    const ssize_t n = read(file, &c, 1);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return "";
    if (c == '\n') return text;
    text += c;
  }
}

// Returns whether a process has ended within this time.
bool has_ended(pid_t process, milliseconds time) {
  const Clock::time_point end = Clock::now() + time;
  for (;;) {
    const pid_t ended = waitpid(process, nullptr, WNOHANG);
    if (ended == process || (ended < 0 && errno != EINTR)) return true;
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(milliseconds(5));
  }
}

void end_process(pid_t process) {
  kill(process, SIGTERM);
  if (has_ended(process, longest_end)) return;
  kill(process, SIGKILL);
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
  }
}

// Returns the last message of Xvfb that gives a reason for its failure.
std::string reason_of(int messages) {
  constexpr off_t most = 4096;
  std::array<char, most> bytes{};
  const off_t size = lseek(messages, 0, SEEK_END);
  const ssize_t n = pread(messages, bytes.data(), bytes.size(), std::max<off_t>(0, size - most));
  std::string reason;
  for (std::string line : split(std::string(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(0, n))), "\n")) {
    for (std::size_t at = line.find("(EE)"); at != std::string::npos; at = line.find("(EE)")) line.erase(at, 4);
    line.erase(0, line.find_first_not_of(' '));
    line.erase(line.find_last_not_of(' ') + 1);
    if (!line.empty()) reason = line;
  }
  return reason.substr(0, 200);
}

struct Server {
  pid_t process = -1;
  std::string display{};  // its number, or "" if the process has ended
  int error = 0;          // the errno of the failed start, or 0
};

// Starts Xvfb with these additional options, and waits until it is ready. Xvfb chooses a free number for its display.
Server start(const std::vector<std::string> &options, const File &key, const File &messages, Clock::time_point end) {
  std::vector<std::string> words = {program_on_path(name_of_server),
                                    "-displayfd",
                                    std::to_string(display_file),
                                    "-auth",
                                    "/proc/self/fd/" + std::to_string(key_file),
                                    "-screen",
                                    "0",
                                    "1600x1200x24",
                                    "-noreset",
                                    "-nolisten",
                                    "tcp"};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char *> arguments;
  for (std::string &word : words) arguments.push_back(&word[0]);
  arguments.push_back(nullptr);
  Server server;
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) {
    server.error = errno;
    return server;
  }
  const File number(ends[0]);
  File writing(ends[1]);
  const pid_t parent = getpid();
  server.process = fork();
  if (server.process == 0) become_server(arguments.data(), parent, writing.number(), key.number(), messages.number());
  if (server.process < 0) {
    server.error = errno;
    return server;
  }
  writing.reset();
  server.display = read_number(number.number(), end);
  if (server.display.empty()) end_process(server.process);
  return server;
}

}  // namespace

void check_virtual_display() {
  if (program_on_path(name_of_server).empty())
    refuse(", which makes one without a screen, is not on the PATH; on Debian the package xvfb has it");
}

VirtualDisplay::VirtualDisplay() : display_before_(variable("DISPLAY")), key_before_(variable("XAUTHORITY")) {
  check_virtual_display();
  File key(file_with_key()), messages(memfd_create("riis-xvfb", MFD_CLOEXEC));
  if (!key.is_open() || !messages.is_open()) refuse(" cannot be started: " + system_text(errno));
  const Clock::time_point end = Clock::now() + longest_start;
  // An abstract socket leaves no file behind, so Xvfb needs no writable folder in /tmp. If a release of Xvfb has no abstract
  // sockets, Xvfb uses a socket in a file.
  Server server = start({"-nolisten", "unix"}, key, messages, end);
  if (server.display.empty() && server.error == 0 && Clock::now() < end) server = start({}, key, messages, end);
  if (server.error != 0) refuse(" cannot be started: " + system_text(server.error));
  if (server.display.empty()) {
    if (Clock::now() >= end) refuse(" was not ready within " + std::to_string(longest_start.count() / 1000) + " s");
    const std::string reason = reason_of(messages.number());
    refuse(" ends" + (reason.empty() ? "" : ": " + reason));
  }
  process_ = server.process;
  key_ = key.release();
  set_variable("DISPLAY", ":" + server.display);
  set_variable("XAUTHORITY", "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(key_));
}

VirtualDisplay::~VirtualDisplay() {
  set_variable("DISPLAY", display_before_);
  set_variable("XAUTHORITY", key_before_);
  end_process(process_);
  close(key_);
}

}  // namespace riis::program
