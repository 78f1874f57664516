// SPDX-License-Identifier: Apache-2.0
// One HTML file that holds everything: pictures as base64, styles inline, no scripts, nothing to load.
// In: figures, their pictures and texts (HTML). Out: the file.
#pragma once

#include <string>
#include <vector>

#include "figures/picture.hpp"

namespace riis::figures {

struct Panel {
  Png picture;
  std::string caption;
};

// A colour and what it stands for.
struct KeyEntry {
  Colour colour;
  std::string text;
};

struct Figure {
  std::string title;
  std::vector<Panel> panels;
  int columns;
  std::vector<KeyEntry> key;
  std::string caption;
  std::string paper;  // what of the paper it shows
  std::string table;  // below the pictures; may be empty
};

// A table of texts, the first row being its head.
std::string html_table(const std::vector<std::vector<std::string>> &rows);

// Makes the file, empty: a path that cannot be written is refused before anything is drawn. Both functions throw
// std::runtime_error that names the path.
void begin_page(const std::string &path);

// left_out: which figures the page lacks and how to get them, a text (HTML) each. appendix: HTML after the last figure.
void write_page(const std::string &path, const std::vector<Figure> &figures, const std::vector<std::string> &left_out,
                const std::string &appendix);

}  // namespace riis::figures
