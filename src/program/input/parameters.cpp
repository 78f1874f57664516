// SPDX-License-Identifier: Apache-2.0
#include "program/input/parameters.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/json.hpp"

namespace riis::program {
namespace {

std::vector<double> numbers_of(const std::string &path, const std::string &name, const Json &value) {
  const auto number_of = [&](const Json &item) {
    if (item.is_number()) return item.get<double>();
    refuse_file(path, name + " must be a number or an array of numbers, not of type " + item.type_name());
  };
  if (!value.is_array()) return {number_of(value)};
  if (value.empty()) refuse_file(path, name + " must be a number or an array of numbers, not an empty array");
  std::vector<double> numbers;
  for (const Json &item : value) numbers.push_back(number_of(item));
  return numbers;
}

bool is_part(const riis_valve *valve, const std::string &name) {
  const std::vector<riis_parameter> all = all_parameters(valve);
  return std::any_of(all.begin(), all.end(), [&](const riis_parameter &parameter) {
    return std::string(parameter.name).rfind(name + ".", 0) == 0;
  });
}

// Returns the first name of a parameter that has two names. For example, "annulus" is the second name of "root_radius".
std::string own_name(const riis_valve *valve, const std::string &name) {
  const std::size_t dot = name.rfind('.'), start = dot == std::string::npos ? 0 : dot + 1;
  for (const riis_parameter &parameter : all_parameters(valve)) {
    const std::string own = parameter.name;
    if (name.substr(start) == parameter.other_name) return name.substr(0, start) + own.substr(own.rfind('.') + 1);
  }
  return name;
}

struct Setting {
  std::string name;  // as the file has it
  std::vector<double> values;
};
using Settings = std::map<std::string, Setting>;  // by the parameter's own name

void add(const std::string &path, const riis_valve *valve, const std::string &name, const Json &value,
         Settings &settings) {
  const auto [place, is_new] = settings.emplace(own_name(valve, name), Setting{name, numbers_of(path, name, value)});
  if (is_new) return;
  if (place->second.name == name) refuse_file(path, name + " is given twice");
  refuse_file(
      path, place->second.name + " and " + name + " are given, but both are names of one size; give only one of them");
}

Settings settings_of(const std::string &path, const riis_valve *valve, const Json &root) {
  if (!root.is_object()) refuse_file(path, "must hold a JSON object of parameters");
  Settings settings;
  for (const auto &[name, value] : root.items()) {
    if (!value.is_object()) {
      add(path, valve, name, value, settings);
      continue;
    }
    if (!is_part(valve, name)) refuse_file(path, name + " is not a part of the valve that has its own parameters");
    for (const auto &[inner, inner_value] : value.items()) add(path, valve, name + "." + inner, inner_value, settings);
  }
  return settings;
}

void set_parameter(riis_valve *valve, const std::string &name, const std::vector<double> &values,
                   const std::string &subject) {
  check(riis_valve_set(valve, name.c_str(), static_cast<int64_t>(values.size()), values.data()), subject);
}

bool belongs_to_part(const std::string &name) { return name.find('.') != std::string::npos; }

}  // namespace

void set_from_json_file(riis_valve *valve, const std::string &path) {
  set_from_json(valve, parse_json_file(path, "parameters"), path);
}

void set_from_json(riis_valve *valve, const Json &parameters, const std::string &path) {
  const Settings settings = settings_of(path, valve, parameters);
  for (const bool of_parts : {false, true}) {
    for (const auto &[own, setting] : settings) {
      if (belongs_to_part(own) == of_parts) set_parameter(valve, setting.name, setting.values, path);
    }
  }
}

void set_from_text(riis_valve *valve, const std::string &setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    refuse_usage("--set: '" + setting + "' is not NAME=VALUE");
  }
  const std::string name = setting.substr(0, equals);
  set_parameter(valve, name, parse_list(setting.substr(equals + 1), "--set " + name), "--set");
}

namespace {

std::string text_of(double number) { return printed("%g", number); }

// Returns the description of a parameter, followed by its rule and its second name.
std::string description_of(const riis_parameter &parameter) {
  std::string text = parameter.description;
  if (*parameter.rule) text += std::string("; unless set: ") + parameter.rule;
  if (!*parameter.other_name) return text;
  const std::string name = parameter.name;
  const std::string factor = parameter.other_factor == 1 ? "" : text_of(parameter.other_factor) + " ";
  return text + "; " + name.substr(0, name.rfind('.') + 1) + parameter.other_name + " = " + factor + name;
}

using Row = std::array<std::string, 5>;

Row row_of(const riis_valve *valve, const riis_parameter &parameter) {
  std::string value;
  for (const double number : values_of(valve, parameter)) value += (value.empty() ? "" : ",") + text_of(number);
  const std::string unit = parameter.unit;
  return {parameter.name, value,
          unit == "length" ? "cm"
          : unit == "1"    ? "-"
                           : unit,
          text_of(parameter.minimum) + " to " + text_of(parameter.maximum), description_of(parameter)};
}

// The rows of a numbered part of the valve, such as bump_0. A parameter outside of numbered parts has a Part of its own, with
// one row and an empty name.
struct Part {
  std::string name;  // "" without a number
  std::vector<Row> rows;
};

// Returns the numbered part of a name, such as "bump_0" for "bump_0.open". Returns "" for a name without a numbered part.
std::string numbered_part(const std::string &name) {
  const std::size_t dot = name.find('.');
  const bool has_number = dot != std::string::npos && dot > 0 && name[dot - 1] >= '0' && name[dot - 1] <= '9';
  return has_number ? name.substr(0, dot) : "";
}

// Returns the rows of the table. The rows of a part stand together.
std::vector<Part> parts_of(const riis_valve *valve) {
  std::vector<Part> parts = {{"", {{"name", "value", "unit", "range", "description"}}}};
  for (const riis_parameter &parameter : all_parameters(valve)) {
    const std::string name = numbered_part(parameter.name);
    auto place =
        std::find_if(parts.begin(), parts.end(), [&](const Part &part) { return !name.empty() && part.name == name; });
    if (place == parts.end()) place = parts.insert(parts.end(), {name, {}});
    place->rows.push_back(row_of(valve, parameter));
  }
  return parts;
}

// Returns whether two parts of the valve differ only in their numbers.
bool are_alike(const Part &a, const Part &b) {
  const auto without_number = [](const Part &part) {
    std::string text = part.name.substr(0, part.name.find_last_not_of("0123456789") + 1);
    for (const Row &row : part.rows)
      for (std::size_t k = 0; k < row.size(); ++k) text += "\n" + row[k].substr(k == 0 ? part.name.size() : 0);
    return text;
  };
  return !a.name.empty() && !b.name.empty() && without_number(a) == without_number(b);
}

// Returns whether a part of the valve is a bump without a place. A bump without a place does nothing.
bool is_idle_bump(const riis_valve *valve, const std::string &part) {
  const auto has_no = [&](const char *place) {
    double number = 0;
    check(riis_valve_get(valve, (part + place).c_str(), 1, &number));
    return number < 0;
  };
  return part.rfind("bump_", 0) == 0 && has_no(".leaflet") && has_no(".commissure");
}

}  // namespace

std::string parameter_table(const riis_valve *valve) {
  const std::vector<Part> parts = parts_of(valve);
  std::array<std::size_t, 5> widths{};
  for (const Part &part : parts)
    for (const Row &row : part.rows)
      for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string table;
  for (std::size_t i = 0; i < parts.size();) {
    for (const Row &row : parts[i].rows) {
      for (std::size_t k = 0; k + 1 < row.size(); ++k)
        table += row[k] + std::string(widths[k] + 2 - row[k].size(), ' ');
      table += row.back() + "\n";
    }
    std::size_t end = i + 1;
    while (end < parts.size() && are_alike(parts[i], parts[end])) ++end;
    const std::size_t n_alike = end - i - 1;
    if (n_alike == 1) table += parts[i + 1].name + " has the same parameters and values as " + parts[i].name + "\n";
    if (n_alike > 1)
      table += parts[i + 1].name + " to " + parts[end - 1].name + " have the same parameters and values as " +
               parts[i].name + "\n";
    i = end;
  }
  return table;
}

std::string json_template(const riis_valve *valve) {
  Json root = Json::object();
  for (const riis_parameter &parameter : all_parameters(valve)) {
    const std::vector<double> values = values_of(valve, parameter);
    const std::string name = parameter.name;
    const std::size_t dot = name.find('.');
    if (const std::string part = name.substr(0, dot); part != "bump_0" && is_idle_bump(valve, part)) continue;
    Json &place = dot == std::string::npos ? root[name] : root[name.substr(0, dot)][name.substr(dot + 1)];
    place = values.size() == 1 ? Json(values[0]) : Json(values);
  }
  return root.dump(2);
}

}  // namespace riis::program
