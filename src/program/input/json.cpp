// SPDX-License-Identifier: Apache-2.0
#include "program/input/json.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace riis::program {

namespace {

// Refuses faults of a JSON file that the parser itself would accept.
class Guard {
 public:
  Guard(const std::string &path, const std::string &content) : path_(path), content_(content) {}

  void operator()(int depth, Json::parse_event_t event, const Json &parsed) {
    // The program's files have at most five levels below the root, and files of 3D Slicer have more. The limit protects recursive
    // code from files with deeper nesting.
    constexpr int deepest = 64;
    if (depth > deepest) refuse_file(path_, "is nested deeper than " + content_ + " can be");
    if (event == Json::parse_event_t::object_start) {
      keys_.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      keys_.pop_back();
    } else if (event == Json::parse_event_t::key) {
      check_key(parsed.get_ref<const std::string &>());
    }
  }

 private:
  void check_key(const std::string &key) {
    // Control characters are refused, because the library would end a name at a 0 byte.
    if (std::any_of(key.begin(), key.end(), is_control)) refuse_file(path_, "a name holds a control character: " + key);
    // Repeated keys are refused. The parser would keep only the last of several equal keys.
    if (!keys_.back().insert(key).second) refuse_file(path_, key + " is given twice");
  }

  const std::string &path_, &content_;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parse_json_file(const std::string &path, const std::string &content) {
  return parse_json(path, text_of_file(path), content);
}

Json parse_json(const std::string &path, const std::string &text, const std::string &content) {
  Guard guard(path, content);
  const auto observe = [&](int depth, Json::parse_event_t event, Json &parsed) {
    guard(depth, event, parsed);
    return true;
  };
  try {
    return Json::parse(text, observe);
  } catch (const Json::exception &error) {
    const std::string said = error.what();
    // The parser's text begins with "[json.exception.parse_error.101]", and then states the line and the column.
    const std::size_t end = said.find("] ");
    refuse_file(path, "is not JSON: " + (end == std::string::npos ? said : said.substr(end + 2)));
  }
}

void check_keys(const std::string &path, const std::string &subject, const Json &value,
                const std::vector<std::string> &keys) {
  const std::string known = joined_by(keys, ", ");
  if (!value.is_object())
    refuse_file(path, subject + " must be an object with " + known + ", not of type " + value.type_name());
  for (const auto &item : value.items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
    refuse_file(path, subject + ": \"" + item.key() + "\" is unknown" + did_you_mean(item.key(), keys, "\"", "\"") +
                          "; there are: " + known);
  }
}

std::optional<std::array<double, 3>> point_in(const Json &value) {
  const auto is_number = [](const Json &x) { return x.is_number(); };
  if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), is_number))
    return std::nullopt;
  return value.get<std::array<double, 3>>();
}

// ---- Case values ----

CaseValues::CaseValues(const std::string &path, const std::string &object, const Json &value,
                       const std::vector<std::string> &keys, const std::string &root)
    : path_(path), object_(object), value_(value) {
  check_keys(path, object.empty() ? root : object, value, keys);
}

void CaseValues::refuse(const std::string &key, const std::string &reason) const {
  refuse_file(subject(), key + ": " + reason);
}

const Json &CaseValues::needed(const char *key) const {
  const auto found = value_.find(key);
  if (found == value_.end()) refuse(key, "it is missing");
  return *found;
}

std::string CaseValues::text(const char *key) const {
  if (!has(key)) return "";
  const Json &value = needed(key);
  if (!value.is_string() || value.get_ref<const std::string &>().empty())
    refuse(key, value.dump() + " is not a text, or is empty");
  const std::string text = value.get<std::string>();
  if (std::any_of(text.begin(), text.end(), is_control)) refuse(key, value.dump() + " holds a control character");
  return text;
}

std::optional<double> CaseValues::number(const char *key) const {
  if (!has(key)) return std::nullopt;
  const Json &value = needed(key);
  if (!value.is_number()) refuse(key, value.dump() + " is not a number");
  return value.get<double>();
}

std::optional<double> CaseValues::above_zero(const char *key) const {
  const auto found = number(key);
  if (found && !(*found > 0)) refuse(key, needed(key).dump() + " is not above 0");
  return found;
}

std::optional<double> CaseValues::at_least_zero(const char *key) const {
  const auto found = number(key);
  if (found && !(*found >= 0)) refuse(key, needed(key).dump() + " is below 0");
  return found;
}

std::vector<double> CaseValues::numbers(const char *key) const {
  const Json &value = needed(key);
  std::vector<double> numbers;
  if (!value.is_array()) refuse(key, value.dump() + " is not an array of numbers");
  for (const Json &item : value) {
    if (!item.is_number()) refuse(key, item.dump() + " is not a number");
    numbers.push_back(item.get<double>());
  }
  return numbers;
}

std::vector<double> CaseValues::numbers(const char *key, std::size_t n) const {
  const std::vector<double> found = numbers(key);
  if (found.size() != n)
    refuse(key,
           needed(key).dump() + " has " + std::to_string(found.size()) + " numbers; it takes " + std::to_string(n));
  return found;
}

bool CaseValues::flag(const char *key) const {
  if (!has(key)) return false;
  const Json &value = needed(key);
  if (!value.is_boolean()) refuse(key, value.dump() + " is neither true nor false");
  return value.get<bool>();
}

std::optional<Unit> CaseValues::unit(const char *key) const {
  if (!has(key)) return std::nullopt;
  return unit_of(unit_names()[choice(key, unit_names())]);
}

std::size_t CaseValues::choice(const char *key, const std::vector<std::string> &names) const {
  if (!has(key)) return 0;
  const auto found = std::find(names.begin(), names.end(), text(key));
  if (found == names.end()) refuse(key, "\"" + text(key) + "\" is none of " + joined_by(names, ", "));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace riis::program
