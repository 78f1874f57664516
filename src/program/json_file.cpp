// SPDX-License-Identifier: Apache-2.0
#include "program/json_file.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "common/nearest_name.hpp"

namespace riis::program {
namespace {

// Refuses what the parser would let pass.
class Guard {
 public:
  Guard(const std::string &path, const std::string &content) : path_(path), content_(content) {}

  void operator()(int depth, Json::parse_event_t event, const Json &parsed) {
    // Files need up to five levels below the root. Recursive code must not meet a value without a bottom.
    constexpr int deepest = 8;
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
    // The library takes names up to a 0 byte.
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
    if (std::any_of(key.begin(), key.end(), is_control)) refuse_file(path_, "a name holds a control character: " + key);
    // The parser keeps the last of several equal keys. They are refused here, because the user cannot have meant both.
    if (!keys_.back().insert(key).second) refuse_file(path_, key + " is given twice");
  }

  const std::string &path_, &content_;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parse_json_file(const std::string &path, const std::string &content) {
  Guard guard(path, content);
  const auto observe = [&](int depth, Json::parse_event_t event, Json &parsed) {
    guard(depth, event, parsed);
    return true;
  };
  try {
    return Json::parse(text_of_file(path), observe);
  } catch (const Json::exception &error) {
    const std::string text = error.what();
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::size_t end = text.find("] ");
    refuse_file(path, "is not JSON: " + (end == std::string::npos ? text : text.substr(end + 2)));
  }
}

void check_keys(const std::string &path, const std::string &subject, const Json &value,
                const std::vector<std::string> &keys) {
  std::string known;
  for (const std::string &key : keys) known += (known.empty() ? "" : ", ") + key;
  if (!value.is_object())
    refuse_file(path, subject + " must be an object with " + known + ", not of type " + value.type_name());
  for (const auto &item : value.items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
    NearestName nearest(item.key());
    for (const std::string &key : keys) nearest.consider(key);
    const std::string meant(nearest.nearest());
    refuse_file(path, subject + ": \"" + item.key() + "\" is unknown" +
                          (meant.empty() ? "" : ", did you mean \"" + meant + "\"?") + "; there are: " + known);
  }
}

}  // namespace riis::program
