// Bearings set aside one after the other: when they say that the target has done what no model
// allows. Pure.
#pragma once

#include <string>

namespace ols::fusion {

class ConsecutiveRejections {
 public:
  // A bearing was used: the row ends.
  void clear();
  // One more of this station was set aside. True: they are so many, of two stations or more, that
  // the target needs covariance inflation; a new row begins.
  bool add(const std::string& station);

  static constexpr int kMany = 6;

 private:
  int in_a_row_ = 0;
  std::string first_station_;
  bool of_two_stations_ = false;
};

}  // namespace ols::fusion
