// SPDX-License-Identifier: Apache-2.0
// The common part of all objects: a handle of riis.h, a record of its users, and calls without the interpreter's lock.
#pragma once

#include <memory>
#include <utility>

#include "arguments.hpp"

namespace riis_python {

// Returns whether this process is a child of fork().
bool is_forked() noexcept;
// Returns whether another thread was inside the library at the fork.
bool was_inside_at_fork() noexcept;
// Returns how many forks led to this process.
int fork_number() noexcept;

// Refuses to make a surface in a child process if another thread of the parent was inside the library at the fork. TBB would wait
// for threads that do not exist in the child.
void check_surfaces_allowed(const char *name);

// Records which threads use an object. All fields are read and written under the interpreter's lock.
struct Usage {
  int n_readers = 0;
  bool is_written = false;
  bool is_closed = false;
  int fork = fork_number();

  // Refuses an object that is closed, or that another thread of the parent was using at the fork.
  void check(const char *name);
};

// Marks the object as being read during this object's lifetime.
class Reading {
 public:
  Reading(Usage &usage, const char *name) : usage_(usage) {
    usage.check(name);
    if (usage.is_written) refuse_busy(name);
    ++usage.n_readers;
  }
  ~Reading() { --usage_.n_readers; }
  Reading(const Reading &) = delete;
  Reading &operator=(const Reading &) = delete;

  [[noreturn]] static void refuse_busy(const char *name);

 private:
  Usage &usage_;
};

// Marks the object as being written during this object's lifetime.
class Writing {
 public:
  Writing(Usage &usage, const char *name) : usage_(usage) {
    usage.check(name);
    if (usage.is_written || usage.n_readers > 0) Reading::refuse_busy(name);
    usage.is_written = true;
  }
  ~Writing() { usage_.is_written = false; }
  Writing(const Writing &) = delete;
  Writing &operator=(const Writing &) = delete;

 private:
  Usage &usage_;
};

// Returns a Python object that keeps another alive.
template <class T>
nb::object keeper_of(T kept) {
  auto own = std::make_unique<T>(std::move(kept));
  nb::capsule made(own.get(), [](void *data) noexcept { delete static_cast<T *>(data); });
  (void)own.release();
  return made;
}

// Counts the threads inside the library, for forks.
class Inside {
 public:
  Inside() noexcept;
  ~Inside();
  Inside(const Inside &) = delete;
  Inside &operator=(const Inside &) = delete;
};

// Refuses a call from the log function, because the library is then inside another call.
void check_not_logging();
// Returns whether the calling thread is inside the log function.
bool is_in_log_function() noexcept;

// Calls the library without the interpreter's lock, so that other Python threads can run meanwhile. Returns the call's status,
// and the message if it failed.
template <class Call>
std::pair<riis_status, std::string> status_of(const Call &call) {
  check_not_logging();
  std::pair<riis_status, std::string> answer;
  const nb::gil_scoped_release release;
  const Inside inside;
  answer.first = call();
  if (answer.first) answer.second = riis_last_error();
  return answer;
}

// Calls the library without the lock, and throws an exception if the call fails.
template <class Call>
void call_library(const Call &call) {
  const auto answer = status_of(call);
  if (answer.first) raise_status(answer.first, in_python(answer.second.c_str()));
}

// Calls the library without the lock for a call that writes an object, and throws an exception if it fails. After an internal
// error, the object is closed.
template <class Call>
void call_to_write(Usage &usage, const Call &call) {
  const auto answer = status_of(call);
  if (answer.first < 0) usage.is_closed = true;
  if (answer.first) raise_status(answer.first, in_python(answer.second.c_str()));
}

// Calls the library with the lock held, for calls that take less time than it takes to release the lock.
inline void call_shortly(riis_status status) {
  if (status) raise_status(status, in_python(riis_last_error()));
}

// A handle of riis.h. The memory is destroyed with the handle or, if arrays show it, with the last of these arrays.
template <class C, void (*destroy)(C **)>
struct Handle {
  Handle() = default;
  ~Handle() { release(); }
  Handle(const Handle &) = delete;
  Handle &operator=(const Handle &) = delete;

  // Frees the memory now, or together with the last array that shows it.
  void close(const char *name) {
    if (!usage.is_closed) {
      const Writing writing(usage, name);
      usage.is_closed = true;
    }
    release();
  }

  // Returns a Python object that keeps the memory alive, for use as the owner of arrays without a copy.
  nb::object share() {
    if (!owner) {
      owner = std::make_shared<Owner>();
      owner->handle = handle;
    }
    return keeper_of(owner);
  }

  // Returns whether anything other than this object uses the memory. In that case the memory must not be written.
  bool is_shared() const { return owner.use_count() > 1; }

  // Takes the memory of another handle. The memory of this handle is left to the arrays that show it.
  void take(Handle &other) {
    release();
    handle = std::exchange(other.handle, nullptr);
    owner = std::move(other.owner);
  }

  C *handle = nullptr;
  Usage usage;

 private:
  struct Owner {
    ~Owner() { destroy(&handle); }
    C *handle = nullptr;
  };

  void release() {
    if (owner)
      handle = nullptr;
    else
      destroy(&handle);
    owner.reset();
  }

  std::shared_ptr<Owner> owner;  // the owner of the handle, once arrays share it
};

// Refuses pickle and copy for a class. The message says what to store instead.
template <class Type>
void refuse_pickle(nb::class_<Type> &type, const char *instead) {
  type.def(
      "__reduce__",
      [instead](const Type &) { refuse_type(Type::python_name, "is neither pickled nor copied; ", instead); },
      nb::sig("def __reduce__(self) -> typing.NoReturn"));
}

// Adds close(), closed and the context-manager methods to a class.
template <class Type>
void add_closing(nb::class_<Type> &type) {
  type.def(
          "close", [](Type &self) { self.close(Type::python_name); },
          "Frees the memory now, or together with the last array that shows it. Any later use of the object raises an "
          "error.")
      .def_prop_ro(
          "closed", [](const Type &self) { return self.usage.is_closed; }, "True after close().")
      .def(
          "__enter__", [](nb::handle self) { return nb::borrow(self); }, nb::sig("def __enter__(self) -> typing.Self"))
      .def(
          "__exit__", [](Type &self, nb::handle, nb::handle, nb::handle) { self.close(Type::python_name); },
          nb::arg("type").none(), nb::arg("value").none(), nb::arg("traceback").none(),
          nb::sig("def __exit__(self, type: object, value: object, traceback: object) -> None"));
}

}  // namespace riis_python
