// SPDX-License-Identifier: Apache-2.0
// Measures the times of several contenders in turns, so that other work on the machine slows all of them equally. A bar is the
// required ratio of the times of two contenders. The output is JSON, and tables in markdown.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bench {

class Contest {
 public:
  using Work = std::function<void()>;

  // before() prepares a turn and is not timed. At least 5 turns are needed, because a ratio is the median of five parts of the
  // run.
  void add(
      const std::string &name, int n_turns, Work work, Work before = [] {});
  // Records a contender that cannot take part on this machine. The contender's bars are left out, and the reason is printed.
  void leave_out(const std::string &name, const std::string &why) { left_out_[name] = why; }
  // Runs all contenders that were added since the last run. Before its first turn, each contender works once without timing.
  void run();

  double least(const std::string &name) const;
  // Divides the run into five parts. In every part, takes the ratio of the two contenders' shortest times. Returns the median of
  // these five ratios.
  double ratio(const std::string &above, const std::string &below) const;
  // Returns the reason why a contender was left out, or "" if it took part.
  std::string why_left_out(const std::string &name) const;
  // Returns, by name, the reasons why contenders were left out.
  const std::map<std::string, std::string> &left_out() const { return left_out_; }

  void print() const;
  nlohmann::json json() const;

 private:
  struct Contender {
    std::string name;
    int n_turns;
    Work work, before;
  };
  std::vector<Contender> contenders_;
  std::map<std::string, std::vector<double>> times_;  // milliseconds
  std::map<std::string, std::string> left_out_;
};

enum class Wanted { at_least, at_most };

// A bar is the required ratio of two contenders' times.
struct RatioBar {
  const char *name, *above, *below;
  Wanted wanted;
  double bar;
};

class Bars {
 public:
  void add(const std::string &name, double value, Wanted wanted, double bar);
  void add(const Contest &contest, const RatioBar &ratio);

  void print() const;
  nlohmann::json json() const;
  const std::vector<std::string> &left_out() const { return left_out_; }

 private:
  struct Bar {
    std::string name;
    double value;
    Wanted wanted;
    double bar;
    bool is_met() const { return wanted == Wanted::at_most ? value <= bar : value >= bar; }
  };
  std::vector<Bar> bars_;
  std::vector<std::string> left_out_;
};

}  // namespace bench
