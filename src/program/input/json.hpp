// SPDX-License-Identifier: Apache-2.0
// The input is a JSON file, and the result is its value. The reader refuses three faults that the parser would accept: deep
// nesting, repeated keys, and control characters in keys.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "program/base/text.hpp"
#include "program/base/units.hpp"

namespace riis::program {

using Json = nlohmann::ordered_json;

// If the file is nested too deeply, the refusal calls the file's content `content`, such as "parameters".
Json parse_json_file(const std::string &path, const std::string &content);
Json parse_json(const std::string &path, const std::string &text, const std::string &content);

// Refuses a value that is not an object, and an object with a key that is not in the list. The refusal of an unknown key suggests
// the nearest key of the list. `subject` names the value.
void check_keys(const std::string &path, const std::string &subject, const Json &value,
                const std::vector<std::string> &keys);

// Returns the point if the value is [x, y, z], or nothing.
std::optional<std::array<double, 3>> point_in(const Json &value);

// The input is an object of a case file. The results are the object's values by key, after checks. Refusals name the file, the
// object and the key.

class CaseValues {
 public:
  // `object`, such as "valve 0", names the object in refusals. If `object` is "", refusals call the file's root `root`. The new
  // object borrows the JSON value.
  CaseValues(const std::string &path, const std::string &object, const Json &value,
             const std::vector<std::string> &keys, const std::string &root = "the case");

  // Returns the names of the file and the object for refusals.
  std::string subject() const { return object_.empty() ? path_ : path_ + ": " + object_; }
  const std::string &path() const { return path_; }
  void set_subject(const std::string &object) { object_ = object; }

  bool has(const char *key) const { return value_.find(key) != value_.end(); }
  const Json &needed(const char *key) const;
  std::string text(const char *key) const;  // returns "" if the key is missing
  std::optional<double> number(const char *key) const;
  std::optional<double> above_zero(const char *key) const;
  std::optional<double> at_least_zero(const char *key) const;
  std::vector<double> numbers(const char *key) const;
  std::vector<double> numbers(const char *key, std::size_t n) const;
  bool flag(const char *key) const;  // returns false if the key is missing
  std::optional<Unit> unit(const char *key) const;
  // Looks for the key's text in the list, and returns its position. If the key is missing, returns 0.
  std::size_t choice(const char *key, const std::vector<std::string> &names) const;

  [[noreturn]] void refuse(const std::string &key, const std::string &reason) const;

 private:
  std::string path_, object_;
  const Json &value_;
};

}  // namespace riis::program
