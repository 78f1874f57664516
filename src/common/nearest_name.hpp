// SPDX-License-Identifier: Apache-2.0
// Finds the existing name that is nearest to a wrong name, which is probably the name that the user meant. All the code is in
// this header, because the library and the program both include it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace riis {

// Returns the number of changes that turn one name into the other. A change replaces, adds or removes a letter, or swaps two
// neighbouring letters. Capitals count as small letters. Only the first 80 letters of a name are compared.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t longest = 80;
  a = a.substr(0, longest);
  b = b.substr(0, longest);
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  // rows[i % 3][j] is the distance between the first i letters of a and the first j letters of b. Row i follows from the rows i -
  // 1 and i - 2, so three rows are kept.
  std::array<std::array<std::size_t, longest + 1>, 3> rows{};
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    auto &row = rows[i % 3];
    const auto &above = rows[(i + 2) % 3], &two_above = rows[(i + 1) % 3];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = small(a[i - 1]) == small(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && small(a[i - 1]) == small(b[j - 2]) && small(a[i - 2]) == small(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return rows[a.size() % 3][b.size()];
}

// Compares candidates, and keeps the nearest. If several candidates are equally near, keeps the first of them. The class ignores
// very different names.
class NearestName {
 public:
  explicit NearestName(std::string_view name)
      : name_(name), least_(std::clamp<std::size_t>(name.size() / 3, 1, 3) + 1) {}

  void consider(std::string_view candidate) {
    const std::size_t distance = edit_distance(name_, candidate);
    if (distance >= least_ || distance >= name_.size()) return;
    least_ = distance;
    nearest_ = candidate;
  }
  // Returns a view of the nearest candidate, or "" if no candidate is near.
  std::string_view nearest() const { return nearest_; }

 private:
  std::string_view name_, nearest_ = "";
  std::size_t least_;
};

}  // namespace riis
