// Compares results with their limits. Prints each result, and counts those outside of their limits.
#pragma once

#include <limits>
#include <string>

namespace ols::bench {

class Limits {
 public:
  void at_most(const std::string& what, double value, double greatest) {
    within(what, value, -kNone, greatest);
  }
  void at_least(const std::string& what, double value, double least) {
    within(what, value, least, kNone);
  }
  void within(const std::string& what, double value, double least, double greatest);
  int missed() const { return missed_; }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  int missed_ = 0;
};

}  // namespace ols::bench
