// SPDX-License-Identifier: Apache-2.0
#include "figures/given_figures.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace riis::figures {
namespace {

constexpr int max_columns = 4;

std::vector<unsigned char> bytes_of(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(path + ": cannot be read");
  return bytes;
}

// A PNG begins with its signature, then its width and height.
Png read_png(const std::string &path) {
  constexpr unsigned char start[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  std::vector<unsigned char> bytes = bytes_of(path);
  if (bytes.size() < std::size(start) + 8 || !std::equal(std::begin(start), std::end(start), bytes.begin()))
    throw std::runtime_error(path + ": no PNG");
  const auto four_bytes = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
    return static_cast<int>(value & 0x7fffffff);
  };
  const int width = four_bytes(std::size(start)), height = four_bytes(std::size(start) + 4);
  return {width, height, std::move(bytes)};
}

}  // namespace

GivenFigures read_figures(const std::string &path) {
  const std::vector<unsigned char> text = bytes_of(path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  GivenFigures read;
  try {
    const nlohmann::json all = nlohmann::json::parse(text);
    for (const nlohmann::json &given : all.at("figures")) {
      Figure figure{given.at("title"), {}, given.at("columns"), {}, given.at("caption"), given.at("paper"), {}};
      if (figure.columns < 1 || figure.columns > max_columns)
        throw std::runtime_error(path + ": columns = " + std::to_string(figure.columns) + " is not 1 to " +
                                 std::to_string(max_columns));
      for (const nlohmann::json &panel : given.at("panels"))
        figure.panels.push_back({read_png(folder / panel.at("png").get<std::string>()), panel.at("caption")});
      read.figures.push_back(std::move(figure));
    }
    if (all.contains("left_out")) read.left_out = all["left_out"].get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception &error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return read;
}

}  // namespace riis::figures
