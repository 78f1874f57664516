// SPDX-License-Identifier: Apache-2.0
// Decimal points while this object lives: under a caller's setlocale(LC_ALL, "de_DE.UTF-8") VTK's readers would take "1.5" for 1.
// Only this thread's locale changes. VTK's legacy reader also sets the process's locale to "C" and leaves it there, so the
// caller's locale is put back.
#pragma once

#include <locale.h>

#include <new>
#include <string>

namespace riis::vtk {

class NumericLocale {
 public:
  NumericLocale() : callers_(setlocale(LC_ALL, nullptr)), points_(newlocale(LC_NUMERIC_MASK, "C", nullptr)) {
    if (!points_) throw std::bad_alloc();
    threads_ = uselocale(points_);
  }
  ~NumericLocale() {
    uselocale(threads_);
    freelocale(points_);
    if (callers_ != setlocale(LC_ALL, nullptr)) setlocale(LC_ALL, callers_.c_str());
  }
  NumericLocale(const NumericLocale &) = delete;
  NumericLocale &operator=(const NumericLocale &) = delete;

 private:
  std::string callers_;  // the process's locale
  locale_t points_;
  locale_t threads_;
};

}  // namespace riis::vtk
