// SPDX-License-Identifier: Apache-2.0
#include "program/base/quantities.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <vector>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"

namespace riis::program {

namespace {

// A unit, as a product of powers of kilograms, metres and seconds, with a factor.
struct Product {
  double si = 1;
  int mass = 0, length = 0, time = 0;

  // Multiplies this product of units by a power of another product.
  void multiply(const Product &by, int power) {
    for (int i = 0; i < std::abs(power); ++i) power > 0 ? si *= by.si : si /= by.si;
    mass += power * by.mass;
    length += power * by.length;
    time += power * by.time;
  }
};

struct Symbol {
  const char *name;
  Product value;
};

constexpr std::array<Symbol, 17> symbols = {{{"kg", {1, 1, 0, 0}},
                                             {"g", {1e-3, 1, 0, 0}},
                                             {"mg", {1e-6, 1, 0, 0}},
                                             {"m", {1, 0, 1, 0}},
                                             {"cm", {1e-2, 0, 1, 0}},
                                             {"mm", {1e-3, 0, 1, 0}},
                                             {"s", {1, 0, 0, 1}},
                                             {"ms", {1e-3, 0, 0, 1}},
                                             {"N", {1, 1, 1, -2}},
                                             {"dyn", {1e-5, 1, 1, -2}},
                                             {"Pa", {1, 1, -1, -2}},
                                             {"kPa", {1e3, 1, -1, -2}},
                                             {"mPa", {1e-3, 1, -1, -2}},
                                             {"mmHg", {133.322387415, 1, -1, -2}},
                                             {"P", {0.1, 1, -1, -1}},
                                             {"cP", {1e-3, 1, -1, -1}},
                                             {"1", {1, 0, 0, 0}}}};

// Reads a unit. Its symbols may have exponents. Blanks, dots, * and / stand between symbols. Brackets may enclose the unit. A
// slash divides only by the factor that follows it.
class UnitReader {
 public:
  UnitReader(const std::string &text, const std::string &subject) : text_(text), subject_(subject) {}

  Product read() {
    const Product all = product();
    if (at_ < text_.size()) refuse();
    return all;
  }

 private:
  [[noreturn]] void refuse() const {
    std::vector<std::string> names;
    for (const Symbol &symbol : symbols) names.emplace_back(symbol.name);
    names.pop_back();
    refuse_usage(subject_ + ": '" + text_ + "' is not a unit such as g/(cm s); it may have " + joined_by(names, ", "));
  }

  bool takes(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  Product product() {
    Product all;
    all.multiply(factor(), 1);
    while (at_ < text_.size() && text_[at_] != ')') {
      bool divides = false;
      while (at_ < text_.size() && std::string(" .*/").find(text_[at_]) != std::string::npos)
        divides |= text_[at_++] == '/';
      all.multiply(factor(), divides ? -1 : 1);
    }
    return all;
  }

  Product factor() {
    Product base;
    if (takes('(')) {
      base = product();
      if (!takes(')')) refuse();
    } else {
      base = symbol();
    }
    Product power;
    power.multiply(base, exponent());
    return power;
  }

  Product symbol() {
    std::string name;
    if (takes('1')) name = "1";
    while (name != "1" && at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])))
      name += text_[at_++];
    for (const Symbol &symbol : symbols)
      if (name == symbol.name) return symbol.value;
    refuse();
  }

  int exponent() {
    const bool has_mark = takes('^');
    const int sign = takes('-') ? -1 : 1;
    if (at_ < text_.size() && text_[at_] >= '1' && text_[at_] <= '9') return sign * (text_[at_++] - '0');
    if (has_mark || sign < 0) refuse();
    return 1;
  }

  const std::string &text_, &subject_;
  std::size_t at_ = 0;
};

// Appends a symbol with its exponent, and counts the symbols.
void append(const std::string &symbol, int exponent, std::string &text, int &n) {
  if (exponent <= 0) return;
  text += (n++ > 0 ? " " : "") + symbol + (exponent > 1 ? std::to_string(exponent) : "");
}

}  // namespace

double parse_unit_of(const std::string &text, const std::string &subject, const Quantity &quantity) {
  const Product unit = UnitReader(text, subject).read();
  if (unit.mass == quantity.mass && unit.length == quantity.length && unit.time == quantity.time) return unit.si;
  // Some codes call R / eps the resistance. The unit of R / eps has one more length in the denominator.
  const bool is_over_length =
      unit.mass != 0 && unit.mass == quantity.mass && unit.length == quantity.length - 1 && unit.time == quantity.time;
  refuse_usage(subject + ": '" + text + "' is not a unit of " + quantity.words + ", such as " + quantity.si +
               (is_over_length ? "; it is a unit of R/eps: multiply the number by the half thickness" : ""));
}

Amount parse_amount(const std::string &text, const std::string &subject, const Quantity &quantity) {
  Amount amount;
  amount.text = text;
  amount.subject = subject;
  // The number ends before the first letter, except for an e before an exponent. A word such as inf cannot have a unit.
  std::size_t end = 0;
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]));
  };
  const auto is_exponent = [&](std::size_t at) {
    const bool has_sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+');
    return at < text.size() && (text[at] == 'e' || text[at] == 'E') && is_digit(at + (has_sign ? 2 : 1));
  };
  while (end < text.size() &&
         (is_digit(end) || std::string("+-.").find(text[end]) != std::string::npos || is_exponent(end)))
    ++end;
  const std::string unit = trimmed(text.substr(end));
  if (end == 0 || unit.empty()) {
    amount.number = parse_number(text, subject);
    return amount;
  }
  amount.number = parse_number(text.substr(0, end), subject) * parse_unit_of(unit, subject, quantity);
  amount.has_unit = true;
  return amount;
}

double factor_from_si(const Quantity &quantity, Unit unit) {
  Product grams, lengths, factor;
  grams.si = unit == Unit::metre ? 1 : 1000;
  lengths.si = factor_between(Unit::metre, unit);
  factor.multiply(grams, quantity.mass);
  factor.multiply(lengths, quantity.length);
  return factor.si;
}

double in_mesh_units(const Amount &amount, const Quantity &quantity, std::optional<Unit> unit) {
  if (unit) return amount.number * factor_from_si(quantity, *unit);
  if (!amount.has_unit) return amount.number;
  throw Refusal{amount.exit_code, amount.subject + ": '" + amount.text +
                                      "' has a unit, but the unit of the mesh is not known: write --unit m, cm or mm"};
}

std::string unit_text(const Quantity &quantity, Unit unit) {
  const std::string mass = unit == Unit::metre ? "kg" : "g", length = name_of(unit);
  std::string above, below;
  int n_above = 0, n_below = 0;
  append(mass, quantity.mass, above, n_above);
  append(length, quantity.length, above, n_above);
  append("s", quantity.time, above, n_above);
  append(mass, -quantity.mass, below, n_below);
  append(length, -quantity.length, below, n_below);
  append("s", -quantity.time, below, n_below);
  if (n_below > 1) below.insert(0, "(").append(")");
  return (n_above > 0 ? above : "1") + (n_below > 0 ? "/" + below : "");
}

}  // namespace riis::program
