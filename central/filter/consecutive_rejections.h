// Counts consecutive rejected bearings. Many of them indicate a manoeuvre that no motion model
// allows. Pure.
#pragma once

#include <string>

namespace ols::fusion {

class ConsecutiveRejections {
 public:
  // Restarts the count. To be called for each used bearing.
  void clear();
  // Counts a rejected bearing of this station. Returns true if at least the last kMany bearings
  // were all rejected, and these bearings came from two or more stations. The caller must then
  // inflate the covariance and call clear().
  bool add(const std::string& station);

  static constexpr int kMany = 6;

 private:
  int in_a_row_ = 0;
  std::string first_station_;
  bool of_two_stations_ = false;
};

}  // namespace ols::fusion
