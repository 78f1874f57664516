// SPDX-License-Identifier: Apache-2.0
// Arguments that are not arrays. If a function refuses an argument, its message names the argument.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "errors.hpp"

namespace riis_python {

// Refuses a masked array, such as numpy.ma's, because its buffer contains values for hidden entries.
void refuse_mask(nb::handle value, const char *name);

// Returns whether a value has entries. An array without dimensions has no entries, because it counts as a number.
bool has_entries(nb::handle value);

// Returns a number. bool and text are refused.
double number(nb::handle value, const char *name);

// Returns a number, or the default for None.
double number_or(nb::handle value, const char *name, double none);

// Returns a number, or RIIS_AUTO for None. Refuses the number that stands for RIIS_AUTO in C.
double number_or_auto(nb::handle value, const char *name);

// Returns a whole number.
std::int64_t integer(nb::handle value, const char *name);

// Returns a whole number of 32 bits.
std::int32_t integer32(nb::handle value, const char *name);

// Returns a bool.
bool flag(nb::handle value, const char *name);

// Returns a string.
std::string text(nb::handle value, const char *name);

// A word, such as "neighbor", and its value.
struct Word {
  const char *word;
  std::int32_t value;
};
std::int32_t choice(nb::handle value, const char *name, std::initializer_list<Word> words);

// Copies three numbers, from a sequence or an array.
void three_numbers(nb::handle value, const char *name, double (&numbers)[3]);

// Returns a number of threads, 0 for the default. A child of fork() has one thread: 0 means 1 there, and more threads are
// refused.
std::int32_t thread_count(nb::handle value, const char *name = "n_threads");

// Returns the object of a type of this module.
template <class Type>
Type &object(nb::handle value, const char *name) {
  Type *found = nullptr;
  if (value.is_none() || !nb::try_cast<Type *>(value, found, false) || !found)
    refuse_type(name, "must be a riis.", Type::python_name, ", not ", name_of_type(value));
  return *found;
}

}  // namespace riis_python
