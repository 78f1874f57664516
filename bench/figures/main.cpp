// SPDX-License-Identifier: Apache-2.0
// riis-figures writes numbers that only the library has, for draw_page.py and parameters/draw.py.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "figures/numbers.hpp"

namespace {

using namespace riis::figures;
using nlohmann::json;

constexpr const char *usage =
    "usage: riis-figures --curves FILE.json         parameters and curves of all valves\n"
    "       riis-figures --polylines FILE.json      how a curve becomes a polyline\n"
    "       riis-figures --errors FILE.json         errors of distances\n"
    "       riis-figures --model FILE.json KIND TOLERANCE SETTINGS [PATCH]\n"
    "                                               patches, quads and triangles of a valve with settings in JSON\n"
    "FILE.json.numbers has the long lists, as doubles.\n";

void write(const std::string &path, const char *bytes, std::size_t n) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes, static_cast<std::streamsize>(n));
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written");
}

// Returns a null value if the words are not a valid command.
json made_by(const std::vector<std::string> &words, Numbers &numbers) {
  if (words.size() == 2 && words[0] == "--curves") return valves();
  if (words.size() == 2 && words[0] == "--polylines") return polylines();
  if (words.size() == 2 && words[0] == "--errors") return errors(numbers);
  if ((words.size() == 5 || words.size() == 6) && words[0] == "--model") {
    const std::optional<int> patch_id = words.size() == 6 ? std::optional(std::stoi(words[5])) : std::nullopt;
    return model(words[2], std::stod(words[3]), json::parse(words[4]), patch_id, numbers);
  }
  return nullptr;
}

}  // namespace

int main(int argc, char **argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    const riis::FloatEnvironment environment;
    Numbers numbers;
    const json made = made_by(words, numbers);
    if (made.is_null()) {
      std::fputs(usage, stderr);
      return 2;
    }
    const std::string text = made.dump(1) + "\n";
    write(words[1], text.data(), text.size());
    const std::vector<double> &all = numbers.all();
    if (!all.empty()) write(words[1] + ".numbers", reinterpret_cast<const char *>(all.data()), 8 * all.size());
    return 0;
  } catch (const riis::Error &error) {
    std::fprintf(stderr, "riis-figures: %s\n", error.message.text());
  } catch (const std::exception &exception) {
    std::fprintf(stderr, "riis-figures: %s\n", exception.what());
  }
  return 1;
}
