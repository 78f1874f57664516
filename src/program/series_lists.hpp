// SPDX-License-Identifier: Apache-2.0
// The lists of a series, which follow its files within half a second, however long the next step takes. So a process that is
// killed leaves lists of nearly all that it wrote. Writing a long list takes longer than
// writing a file, so the lists are not written for each file.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace riis::program {

class SeriesLists {
 public:
  // write writes all lists. A thread of the object calls it, and end() calls it with true.
  explicit SeriesLists(std::function<void(bool is_last)> write);
  ~SeriesLists();
  SeriesLists(const SeriesLists &) = delete;
  SeriesLists &operator=(const SeriesLists &) = delete;

  // Calls note, which adds to the lists, while nobody writes them. Throws what write threw.
  void add(const std::function<void()> &note);
  // Ends the thread and writes the lists a last time.
  void end();

 private:
  void follow();
  void stop();

  const std::function<void(bool)> write_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_news_ = false, has_ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace riis::program
