// Counts consecutive rejected bearings. Many of them show a manoeuvre that no motion model allows.
// Pure.
#pragma once

#include <string>

namespace ols::fusion {

class ConsecutiveRejections {
 public:
  // A bearing was used: restarts the count.
  void clear();
  // One more bearing of this station was rejected. Returns true, and restarts the count, when kMany
  // are reached from two or more stations: the covariance must then be inflated.
  bool add(const std::string& station);

  static constexpr int kMany = 6;

 private:
  int in_a_row_ = 0;
  std::string first_station_;
  bool of_two_stations_ = false;
};

}  // namespace ols::fusion
