// SPDX-License-Identifier: Apache-2.0
#include "figures/state_tables.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace riis::figures {
namespace {

std::vector<std::string> cells_of(const std::string &line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

double number_of(const std::string &cell) {
  std::size_t n_read = 0;
  const double value = std::stod(cell, &n_read);
  if (n_read != cell.size() || !std::isfinite(value)) throw std::invalid_argument(cell);
  return value;
}

bool ends_in(const std::string &text, const std::string &ending) {
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

// Adds a column to the table. A column of shares follows the column of its measure. Returns false if the name is unknown.
bool add(const std::string &column, const std::vector<double> &values, StateTable &table) {
  if (column == "orifice_area") {
    table.orifice.values = values;
    return true;
  }
  if (column == "orifice_perimeter" || column == "effective_area") return true;  // not drawn
  for (const auto &[name, measures] : {std::pair("_edge", &table.edges), std::pair("_area", &table.areas)}) {
    if (ends_in(column, name)) {
      measures->push_back({values, {}});
      return true;
    }
    if (ends_in(column, std::string(name) + "_ratio") && !measures->empty()) {
      measures->back().shares = values;
      return true;
    }
  }
  return false;
}

}  // namespace

StateTable read_state_table(const std::string &path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(path + ": cannot be read");
  const std::vector<std::string> head = cells_of(line);
  std::vector<std::vector<double>> columns(head.size());
  for (std::size_t row = 2; std::getline(in, line); ++row) {
    const std::vector<std::string> cells = cells_of(line);
    const std::string place = path + ": line " + std::to_string(row) + ": ";
    if (cells.size() != head.size())
      throw std::runtime_error(place + std::to_string(cells.size()) + " cells under " + std::to_string(head.size()) +
                               " names");
    for (std::size_t i = 0; i < cells.size(); ++i) try {
        columns[i].push_back(number_of(cells[i]));
      } catch (const std::logic_error &) {
        throw std::runtime_error(place + "'" + cells[i] + "' is no number");
      }
  }
  StateTable table{std::filesystem::path(path).stem().string(), columns[0], {}, {}, {}};
  if (head[0] != "opening" || table.openings.empty()) throw std::runtime_error(path + ": no table of openings");
  for (std::size_t i = 1; i < head.size(); ++i)
    if (!add(head[i], columns[i], table))
      throw std::runtime_error(path + ": '" + head[i] + "' is no measure of a state");
  return table;
}

}  // namespace riis::figures
