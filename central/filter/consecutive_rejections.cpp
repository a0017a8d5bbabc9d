#include "central/filter/consecutive_rejections.h"

namespace ols::fusion {

void ConsecutiveRejections::clear() {
  in_a_row_ = 0;
  of_two_stations_ = false;
}

bool ConsecutiveRejections::add(const std::string& station) {
  if (in_a_row_ == 0) first_station_ = station;
  of_two_stations_ = of_two_stations_ || first_station_ != station;
  return ++in_a_row_ >= kMany && of_two_stations_;
}

}  // namespace ols::fusion
