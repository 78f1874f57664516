// SPDX-License-Identifier: Apache-2.0
#include "figures/page.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace riis::figures {
namespace {

constexpr const char *head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>riis in figures</title>
<style>
body { font: 16px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; color: #222; background: #fff;
       max-width: 1240px; margin: 0 auto; padding: 1.5em; }
h1 { font-size: 1.7em; margin: 0 0 .3em; }
h2 { font-size: 1.2em; margin: 0 0 .5em; }
nav ol { columns: 2; padding-left: 1.4em; }
a { color: #0060a0; }
section { border-top: 1px solid #ccc; margin-top: 2.5em; padding-top: 1.2em; }
.panels { display: grid; gap: 14px; }
figure { margin: 0; }
figure img { width: 100%; height: auto; display: block; border: 1px solid #e4e4e4; }
figcaption { font-size: .88em; padding: .3em .2em 0; }
.key { font-size: .9em; margin: .8em 0 0; }
.key span { white-space: nowrap; margin-right: 1.4em; }
.key i { display: inline-block; width: .85em; height: .85em; border-radius: 2px; margin-right: .4em; vertical-align: -.08em; }
.caption { max-width: 62em; margin: .8em 0 0; }
.paper { color: #555; font-size: .9em; max-width: 68em; margin: .5em 0 0; }
table { border-collapse: collapse; font-size: .9em; margin: 1em 0 0; }
th, td { border-bottom: 1px solid #ddd; padding: .2em .9em .2em 0; text-align: left; vertical-align: top; }
th { border-bottom: 1px solid #888; }
code { font-size: .92em; }
@media (max-width: 640px) { .panels { grid-template-columns: 1fr !important; } nav ol { columns: 1; } }
@media print { section { break-inside: avoid; } body { max-width: none; padding: 0; } }
</style>
</head>
<body>
)";

std::string base64(const std::vector<unsigned char> &bytes) {
  constexpr const char *digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string css(Colour colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text;
}

void put(std::ostream &out, const Figure &figure, std::size_t number) {
  out << "<section id=\"figure-" << number << "\">\n<h2>Figure " << number << ". " << figure.title << "</h2>\n"
      << "<div class=\"panels\" style=\"grid-template-columns: repeat(" << figure.columns << ", 1fr)\">\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel &panel = figure.panels[i];
    const std::string letter(1, static_cast<char>('a' + static_cast<char>(i)));
    // The attributes give the picture's own size. The style sheet lets the panel decide the displayed size.
    out << "<figure><img width=\"" << panel.picture.width << "\" height=\"" << panel.picture.height
        << "\" alt=\"Figure " << number << letter << "\" src=\"data:image/png;base64," << base64(panel.picture.bytes)
        << "\">\n"
        << "<figcaption><b>(" << letter << ")</b> " << panel.caption << "</figcaption></figure>\n";
  }
  out << "</div>\n";
  if (!figure.key.empty()) {
    out << "<p class=\"key\">";
    for (const KeyEntry &entry : figure.key)
      out << "<span><i style=\"background:" << css(entry.colour) << "\"></i>" << entry.text << "</span> ";
    out << "</p>\n";
  }
  out << "<p class=\"caption\"><b>Figure " << number << ".</b> " << figure.caption << "</p>\n"
      << figure.table << "<p class=\"paper\"><b>In the paper:</b> " << figure.paper << "</p>\n</section>\n";
}

void put_left_out(std::ostream &out, const std::vector<std::string> &texts) {
  if (texts.empty()) return;
  out << "<section id=\"left-out\">\n<h2>Not on this page</h2>\n<ul>\n";
  for (const std::string &text : texts) out << "<li>" << text << "</li>\n";
  out << "</ul>\n</section>\n";
}

}  // namespace

std::string html_table(const std::vector<std::vector<std::string>> &rows) {
  std::string html = "<table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string tag = i == 0 ? "th" : "td";
    html += "<tr>";
    for (const std::string &cell : rows[i]) html += "<" + tag + ">" + cell + "</" + tag + ">";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

void begin_page(const std::string &path) {
  if (!std::ofstream(path, std::ios::binary)) throw std::runtime_error(path + ": cannot be written");
}

void write_page(const std::string &path, const std::vector<Figure> &figures, const std::vector<std::string> &left_out,
                const std::string &appendix) {
  std::ofstream out(path, std::ios::binary);
  out << head << "<h1>riis in figures</h1>\n"
      << "<p>Every picture and every number on this page is computed by riis " << riis_version_string()
      << " itself: by the code that marks nodes, with the parameters of B. van der Vuurst, J. Kosinka and C. "
         "Bertoglio, "
         "<i>Fast generation of 3D flow obstacles from parametric surface models: application to cardiac valves</i> "
         "(2025), “the paper”. Only the paper's own times come from there. The trileaflet, the coapting and the "
         "bileaflet valve are not the paper's and have parameters of their own. Lengths are centimetres. The "
         "<i>tolerance</i> is the "
         "share of the half thickness, 0.1 cm, by which distances to the triangles may differ from distances to the "
         "smooth surface: 5 % stands for 0.005 cm. "
         "<a href=\"../../docs/view.md\">riis view</a> shows a valve in your own mesh, and moves it with your hands."
         "</p>\n<nav><ol>\n";
  for (std::size_t i = 0; i < figures.size(); ++i)
    out << "<li><a href=\"#figure-" << i + 1 << "\">" << figures[i].title << "</a></li>\n";
  out << "</ol></nav>\n";
  for (std::size_t i = 0; i < figures.size(); ++i) put(out, figures[i], i + 1);
  put_left_out(out, left_out);
  out << appendix << "</body>\n</html>\n";
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace riis::figures
