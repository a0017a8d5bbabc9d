#include "edge/ptu/budget.h"

namespace ols::ptu {

namespace {

constexpr double kUnit_s = 0.002;  // for the unit to process a request
constexpr double kRequestMoving_bytes = 49.0, kAfterMoving_bytes = 20.0;
// At rest the replies follow the first query without a pause.
constexpr double kFirstQuery_bytes = 4.0, kRepliesResting_bytes = 40.0;

}  // namespace

double byte_time_s(int baud) { return baud > 0 ? 10.0 / baud : 0.0; }

double longest_cycle_s(int baud) {
  return (kRequestMoving_bytes + kAfterMoving_bytes) * byte_time_s(baud) + kUnit_s;
}

double resting_cycle_s(int baud) {
  return (kFirstQuery_bytes + kRepliesResting_bytes) * byte_time_s(baud) + kUnit_s;
}

}  // namespace ols::ptu
