// SPDX-License-Identifier: Apache-2.0
// Declares the parts of riis-figures' output. Long lists of numbers stand in a separate file, as doubles. The JSON refers to such
// a list by the position of its first number and by its length: {"at", "n"}.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace riis::figures {

class Numbers {
 public:
  template <class List>
  nlohmann::json put(const List &list) {
    const nlohmann::json place = {{"at", all_.size()}, {"n", list.size()}};
    all_.insert(all_.end(), list.begin(), list.end());
    return place;
  }
  const std::vector<double> &all() const { return all_; }

 private:
  std::vector<double> all_;
};

// The parameters of each kind of valve, and its patches at three openings.
nlohmann::json valves();
// The stages that turn a curve into a polyline.
nlohmann::json polylines();
// Patches, quads and triangles of a valve, or of one image of a patch. The settings are {NAME: VALUE, ...}.
nlohmann::json model(const std::string &kind, double tolerance, const nlohmann::json &settings,
                     std::optional<int> patch_id, Numbers &numbers);
// The errors of the paper's three methods for a distance: painted on leaflets, and at points whose distance is known.
nlohmann::json errors(Numbers &numbers);

}  // namespace riis::figures
