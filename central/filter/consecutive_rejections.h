// Bearings that were rejected one after the other: when they show a manoeuvre that no motion model
// allows. Pure.
#pragma once

#include <string>

namespace ols::fusion {

class ConsecutiveRejections {
 public:
  // A bearing was used: the count restarts.
  void clear();
  // One more of this station was rejected. Returns true when there are so many, of two stations or
  // more, that the covariance must be inflated; the count then restarts.
  bool add(const std::string& station);

  static constexpr int kMany = 6;

 private:
  int in_a_row_ = 0;
  std::string first_station_;
  bool of_two_stations_ = false;
};

}  // namespace ols::fusion
