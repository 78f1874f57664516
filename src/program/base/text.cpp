// SPDX-License-Identifier: Apache-2.0
#include "program/base/text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "common/byte_order_mark.hpp"
#include "common/nearest_name.hpp"
#include "common/number_from_chars.hpp"
#include "program/base/refusal.hpp"

namespace riis::program {

namespace {

template <class Number>
std::optional<Number> whole_number_in(const std::string &text) {
  // A plus sign is skipped, because std::from_chars does not accept it.
  const char *first = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char *last = text.data() + text.size();
  Number number{};
  const auto [end, error] = number_from_chars(first, last, number);
  return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

template <class Number>
Number parse(const std::string &text, const std::string &subject, const char *kind) {
  const auto number = whole_number_in<Number>(text);
  if (!number) refuse_usage(subject + ": '" + text + "' is not " + kind);
  return *number;
}

}  // namespace

std::optional<double> number_in(const std::string &text) { return whole_number_in<double>(text); }

double parse_number(const std::string &text, const std::string &subject) {
  return parse<double>(text, subject, "a number that fits a double");
}

std::int32_t parse_integer(const std::string &text, const std::string &subject) {
  return parse<std::int32_t>(text, subject, "a whole number of 32 bits");
}

std::vector<double> parse_list(const std::string &text, const std::string &subject) {
  std::vector<double> numbers;
  for (const std::string &part : split(text, ",")) numbers.push_back(parse_number(part, subject));
  return numbers;
}

std::vector<double> parse_list(const std::string &text, const std::string &subject, std::size_t n,
                               const std::string &form) {
  std::vector<double> numbers = parse_list(text, subject);
  if (numbers.size() != n) {
    refuse_usage(subject + ": '" + text + "' has " + std::to_string(numbers.size()) + " numbers; it takes " + form);
  }
  return numbers;
}

std::string shortest(double number) {
  char text[32];
  const char *end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, static_cast<std::size_t>(end - text)};
}

int decimal_exponent(double number) {
  char text[32];
  const char *end = std::to_chars(text, text + sizeof text, number, std::chars_format::scientific).ptr;
  const char *const exponent = std::find(static_cast<const char *>(text), end, 'e') + 1;
  int value = 0;
  std::from_chars(exponent + (*exponent == '+' ? 1 : 0), end, value);
  return value;
}

double power_of_ten(int exponent) {
  const std::string text = "1e" + std::to_string(exponent);
  double value = 0;
  number_from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string printed(const char *format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

std::vector<std::string> split(const std::string &text, const char *marks) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(marks, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string joined_by(const std::vector<std::string> &parts, const char *between) {
  std::string text;
  for (const std::string &part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

std::string numbers_text(const double *numbers, std::size_t n, const char *between, std::string (*as_text)(double)) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < n; ++i) parts.push_back(as_text(numbers[i]));
  return joined_by(parts, between);
}

std::string one_of(const std::vector<std::string> &names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

std::string did_you_mean(const std::string &word, const std::vector<std::string> &names, const char *before,
                         const char *after) {
  NearestName nearest(word);
  for (const std::string &name : names) nearest.consider(name);
  const std::string found(nearest.nearest());
  return found.empty() ? "" : ", did you mean " + (before + found + after) + "?";
}

std::string shell_word(const std::string &word) {
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c >= 128 ||
           std::string("_-./+,:@%=").find(static_cast<char>(c)) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_text(const std::vector<std::string> &words) {
  std::vector<std::string> typed;
  for (const std::string &word : words) typed.push_back(shell_word(word));
  return joined_by(typed, " ");
}

std::string system_text(int error) { return std::generic_category().message(error); }

// ---- Text file ----

std::string ending_of(const std::string &path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char &c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

bool has_ending(const std::string &path, const std::string &ending) { return ending_of(path) == ending; }

void refuse_file(const std::string &path, const std::string &reason) {
  constexpr std::size_t longest = 300;
  refuse_data(path + ": " + (reason.size() > longest ? reason.substr(0, longest) + " ..." : reason));
}

std::string text_of_file(const std::string &path) {
  errno = 0;
  std::ifstream file(path);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  // On Linux, a folder can be opened as a file, but reading it fails. This failure is noticed here.
  if (!file.is_open() || errno != 0) refuse_file(path, "cannot be read: " + system_text(errno));
  const std::string content = text.str();
  if (content.empty()) refuse_file(path, "is empty");
  if (content.rfind("version https://git-lfs.github.com/spec/", 0) == 0)
    refuse_file(path, "is a pointer of Git LFS, not the file itself: git lfs pull fetches the file");
  return std::string(without_byte_order_mark(content));
}

// ---- Times ----

namespace {

// The largest time that the library accepts.
constexpr double largest_time = 1e30;

[[noreturn]] void refuse_count(const std::string &subject, double n) {
  refuse_usage(subject + ": " + shortest(n) + " times are too many; a series has at most " +
               std::to_string(most_times));
}

double parse_time(const std::string &text, const std::string &subject) {
  const double time = parse_number(text, subject);
  if (!(std::abs(time) <= largest_time))
    refuse_usage(subject + ": " + text + " is not finite and at most 1e30 in magnitude");
  return time;
}

// Removes the rounding error of a sum of steps. For example, 0.07000000000000001 becomes 0.07.
double tidied(double time, double step) {
  char text[32];
  double tidy = time;
  const char *end = std::to_chars(text, text + sizeof text, time, std::chars_format::general, 12).ptr;
  number_from_chars(text, end, tidy);
  return std::abs(tidy - time) <= 1e-9 * step ? tidy : time;
}

std::vector<double> stepped(double start, double stop, double step, const std::string &subject) {
  if (!(step > 0)) refuse_usage(subject + ": the step " + shortest(step) + " is not above 0");
  if (stop < start) refuse_usage(subject + ": the stop " + shortest(stop) + " is before the start " + shortest(start));
  // If the step divides the span, rounding could lose the last step. The small additions prevent this loss.
  const double n = std::floor((stop - start) / step * (1 + 1e-12) + 1e-9) + 1;
  if (n > static_cast<double>(most_times)) refuse_count(subject, n);
  if (n < 2) refuse_usage(subject + ": the step " + shortest(step) + " is beyond the stop " + shortest(stop));
  std::vector<double> times;
  for (double i = 0; i < n; ++i) times.push_back(std::min(tidied(start + i * step, step), stop));
  return times;
}

}  // namespace

std::vector<double> parse_times(const std::string &text, const std::string &subject) {
  std::vector<double> times;
  const std::vector<std::string> range = split(text, ":");
  if (range.size() == 3) {
    times =
        stepped(parse_time(range[0], subject), parse_time(range[1], subject), parse_time(range[2], subject), subject);
  } else if (range.size() == 1) {
    for (const std::string &piece : split(text, ",")) times.push_back(parse_time(piece, subject));
  } else {
    refuse_usage(subject + ": '" + text + "' is neither START:STOP:STEP nor a list of times");
  }
  check_times(times, subject);
  return times;
}

void check_times(const std::vector<double> &times, const std::string &subject) {
  if (times.size() > most_times) refuse_count(subject, static_cast<double>(times.size()));
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (!(times[i] > times[i - 1]))
      refuse_usage(subject + ": the time " + shortest(times[i]) + " is not above the time before it, " +
                   shortest(times[i - 1]));
  }
  if (times.empty()) refuse_usage(subject + ": a series has one time or more");
}

// ---- CSV ----

std::string trimmed(const std::string &text) {
  const auto is_blank = [](unsigned char c) { return c <= ' '; };
  const auto first = std::find_if_not(text.begin(), text.end(), is_blank);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), is_blank).base();
  return {first, last};
}

std::vector<std::string> csv_cells(const std::string &line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (c == '"' && (is_quoted || trimmed(cells.back()).empty()))
      is_quoted = !is_quoted;
    else if (!is_quoted && (c == ',' || c == ';'))
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (std::string &cell : cells) cell = trimmed(cell);
  return cells;
}

double number_in_file(const std::string &path, const std::string &text, const std::string &subject) {
  try {
    return parse_number(text, subject);
  } catch (const Refusal &refusal) {
    refuse_file(path, refusal.text);
  }
}

std::vector<CsvLine> csv_lines(const std::string &text) {
  std::vector<CsvLine> lines;
  std::size_t number = 0;
  // Some programs end lines with a carriage return alone.
  for (const std::string &whole : split(text, text.find('\n') == std::string::npos ? "\r" : "\n")) {
    std::string line = trimmed(whole);
    const std::string where = "line " + std::to_string(++number);
    if (line.empty()) continue;
    // A spreadsheet may quote every cell.
    if (line.rfind("\"#", 0) == 0) line = csv_cells(line).front();
    if (line[0] != '#') {
      lines.push_back({where, line, {}});
    } else if (const std::size_t equals = line.find('='); equals != std::string::npos) {
      // A spreadsheet may add empty cells to a line.
      const std::string value = line.substr(equals + 1, line.find_last_not_of(",; ") - equals);
      lines.push_back({where, "", {{trimmed(line.substr(1, equals - 1)), trimmed(value)}}});
    }
  }
  return lines;
}

CsvFile csv_of_text(const std::string &path, const std::string &text, const std::vector<std::string> &names,
                    const std::string &form, std::size_t n_cells) {
  CsvFile file;
  for (const CsvLine &line : csv_lines(text)) {
    if (line.fact) {
      const std::string &name = line.fact->first;
      if (std::find(names.begin(), names.end(), name) == names.end())
        refuse_file(path,
                    line.where + ": " + quoted(name) + " is unknown; a line # NAME = VALUE states " + one_of(names));
      if (!file.stated.insert(*line.fact).second) refuse_file(path, line.where + ": the " + name + " is given twice");
      continue;
    }
    file.rows.push_back({line.where, csv_cells(line.row)});
    std::vector<std::string> &cells = file.rows.back().cells;
    while (cells.size() > n_cells && cells.back().empty()) cells.pop_back();
    if (cells.size() != n_cells) refuse_file(path, line.where + " must be " + form + ", not " + quoted(line.row));
  }
  return file;
}

}  // namespace riis::program
