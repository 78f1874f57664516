// SPDX-License-Identifier: Apache-2.0
#include "program/output_locks.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>

#include "program/outputs.hpp"
#include "program/refusal.hpp"
#include "program/warnings.hpp"

namespace riis::program {
namespace {

// The lock files that this process holds. Only the first object has any. It fills the list before it sets the handlers.
std::vector<std::string> held;

constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};

void remove_held() {
  for (const std::string &path : held) unlink(path.c_str());
}

// The default action follows: the signal stays blocked until the handler returns.
void remove_and_end(int signal) {
  remove_held();
  std::raise(signal);
}

void set_handlers(void (*from)(int), void (*to)(int)) {
  struct sigaction action {};
  action.sa_handler = to;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : ending_signals) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == from) sigaction(signal, &action, nullptr);
  }
}

// Ending signals wait while one of these lives, so a lock file always has the handlers that remove it.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int signal : ending_signals) sigaddset(&ending, signal);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait &) = delete;
  SignalsWait &operator=(const SignalsWait &) = delete;

 private:
  sigset_t before_{};
};

// A lock's name has only the end of an output's name that is too long.
std::string lock_of(const std::string &output) {
  constexpr std::size_t longest = 200;
  const std::filesystem::path place = std::filesystem::absolute(place_of(output));
  const std::string name = place.filename().string();
  return (place.parent_path() / (".riis-" + name.substr(name.size() - std::min(name.size(), longest)) + ".lock"))
      .string();
}

[[noreturn]] void refuse_lock(const std::string &output, const std::string &reason) {
  throw Refusal{exit_bad_data, output + ": " + reason};
}

bool is_at(int file, const std::string &path) {
  struct stat opened {};
  struct stat there {};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &there) == 0 && opened.st_ino == there.st_ino &&
         opened.st_dev == there.st_dev;
}

// Returns the lock's file, or -1 on a file system without locks.
int take(const std::string &output, const std::string &lock) {
  for (;;) {
    int file = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    // A killed run of another user left the file, and this user may only read it.
    if (file < 0 && errno == EACCES) file = open(lock.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
      refuse_lock(output, "its lock " + lock + " cannot be made: " + std::generic_category().message(errno));
    if (flock(file, LOCK_EX | LOCK_NB) == 0) {
      if (is_at(file, lock)) return file;
      close(file);  // the run that held it has just removed it
      continue;
    }
    const int error = errno;
    close(file);
    if (error == EINTR) continue;
    if (error == EWOULDBLOCK) refuse_lock(output, "another run of riis-mark is writing it, and holds " + lock);
    warn(output + ": it cannot be locked, so other runs may write it meanwhile: " + std::generic_category().message(error));
    unlink(lock.c_str());
    return -1;
  }
}

}  // namespace

OutputLocks::OutputLocks(const std::vector<std::string> &paths) {
  const SignalsWait wait;
  try {
    for (const std::string &path : paths) {
      const std::string lock = lock_of(path);
      // Outputs with long names may share a lock.
      if (std::find(held.begin(), held.end(), lock) != held.end()) continue;
      const int file = take(path, lock);
      if (file < 0) continue;
      files_.push_back(file);
      held.push_back(lock);
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
  remove_held();  // before the locks end: a file that another run has locked since would be lost
  set_handlers(remove_and_end, SIG_DFL);
  for (const int file : files_) close(file);
  files_.clear();
  held.clear();
}

}  // namespace riis::program
