// SPDX-License-Identifier: Apache-2.0
// Reads and writes text: numbers, the times of a series, whole files, and text within XML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace riis::program {

// The inputs are words of the command line. The results are numbers, which are the same in every locale. If other characters
// follow the number, the word is refused as wrong usage. `subject` names the value in the refusal.

// If the whole text is one number, returns this number. Otherwise returns nothing.
std::optional<double> number_in(const std::string &text);
double parse_number(const std::string &text, const std::string &subject);
std::int32_t parse_integer(const std::string &text, const std::string &subject);
// Reads numbers separated by commas.
std::vector<double> parse_list(const std::string &text, const std::string &subject);
// Reads exactly n numbers separated by commas. In a refusal, `form` shows the expected form, such as "X,Y,Z".
std::vector<double> parse_list(const std::string &text, const std::string &subject, std::size_t n,
                               const std::string &form);

// Returns the text of a number in a format of printf, such as "%.3g".
std::string printed(const char *format, double number);
// Returns the shortest text from which the same number can be read, in any locale.
std::string shortest(double number);
// Returns the power of ten of a number's first digit. For example, the power is 2 for 123. The number must be finite and not 0.
int decimal_exponent(double number);
// Returns 10 to the given power as the nearest double, or 0 if a double cannot hold it.
double power_of_ten(int exponent);

// Returns the texts of several numbers, with the given text between them.
std::string numbers_text(const double *numbers, std::size_t n, const char *between,
                         std::string (*as_text)(double) = shortest);

inline std::string quoted(const std::string &text) { return "\"" + text + "\""; }

// Splits a text at each of the given characters.
std::vector<std::string> split(const std::string &text, const char *marks);
// joined_by puts a text between the parts. one_of returns a list for a sentence, such as "m, cm or mm".
std::string joined_by(const std::vector<std::string> &parts, const char *between);
std::string one_of(const std::vector<std::string> &names);
// Returns ", did you mean NAME?" with the name nearest to a word, or "" if no name is near. `before` and `after` enclose the
// name.
std::string did_you_mean(const std::string &word, const std::vector<std::string> &names, const char *before = "",
                         const char *after = "");

// Puts a word in quotes if a shell would not read it as one word.
std::string shell_word(const std::string &word);
// Returns the words of a command as a user would type them.
std::string shell_text(const std::vector<std::string> &words);

inline bool is_control(unsigned char c) { return c < ' ' || c == 127; }
// Returns the system's message for a value of errno.
std::string system_text(int error);

// The input is a path. The result is the ending of the path, or the text of the file. Refusals name the file.

// Returns the ending of a path in small letters. The ending begins with the path's last dot.
std::string ending_of(const std::string &path);
// Returns whether the path has this ending, in small letters or in capitals.
bool has_ending(const std::string &path, const std::string &ending);

// Refuses the file. The reason may quote parts of the file, and these parts may have any length.
[[noreturn]] void refuse_file(const std::string &path, const std::string &reason);

// Refuses a file that cannot be read or is empty.
std::string text_of_file(const std::string &path);

// The input is the text of a CSV. The results are the rows, and the facts from lines of the form # NAME = VALUE. Lines that begin
// with # and have another form are comments.

std::string trimmed(const std::string &text);
// Returns the cells of a line. Commas or semicolons separate cells, except within quotation marks. Within a quoted cell, two
// quotation marks stand for one quotation mark.
std::vector<std::string> csv_cells(const std::string &line);
// Reads a number. The refusal of a bad number names the file.
double number_in_file(const std::string &path, const std::string &text, const std::string &subject);

struct CsvLine {
  std::string where;                                        // such as "line 3"
  std::string row;                                          // "" if the line states a fact
  std::optional<std::pair<std::string, std::string>> fact;  // a name and its value
};
// Returns the rows and the facts. Empty lines and other comments are left out.
std::vector<CsvLine> csv_lines(const std::string &text);

struct CsvFile {
  struct Row {
    std::string where;  // such as "line 3"
    std::vector<std::string> cells;
  };
  std::map<std::string, std::string> stated;
  std::vector<Row> rows;
};
// Refuses facts with unknown names, facts stated twice, and rows that do not have the given form, such as "X,Y,Z".
CsvFile csv_of_text(const std::string &path, const std::string &text, const std::vector<std::string> &names,
                    const std::string &form, std::size_t n_cells);

// The input is the times of a series as the user writes them. The result is the times in ascending order.

// The largest number of times in a series.
inline constexpr std::size_t most_times = 100000;

// Reads START:STOP:STEP, which includes STOP, or a list of times separated by commas. Refusals begin with `subject`, such as
// "--times".
std::vector<double> parse_times(const std::string &text, const std::string &subject);

// Refuses an empty list, times that do not ascend, and more times than most_times.
void check_times(const std::vector<double> &times, const std::string &subject);

}  // namespace riis::program
