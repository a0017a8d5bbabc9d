// What a measure must reach. Says how each one stands, and counts those that miss.
#pragma once

#include <string>

namespace ols::bench {

class Limits {
 public:
  void at_most(const std::string& what, double value, double greatest);
  void at_least(const std::string& what, double value, double least);
  void within(const std::string& what, double value, double least, double greatest);
  int missed() const { return missed_; }

 private:
  int missed_ = 0;
};

}  // namespace ols::bench
