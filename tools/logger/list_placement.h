// Where in a log the site's trust list belongs: before the messages that were judged by it. Pure.
#pragma once

#include <cstdint>

namespace ols::logger {

// Whether the list in force is to be written before a message that was judged by the list of number
// `judged_by`. `written`: the number of the last one in this file; 0: none, and a file begins with
// a list. What was judged by an older list and waited in the queue meanwhile stays before the
// newer.
inline bool list_goes_before(std::int64_t judged_by, std::int64_t in_force, std::int64_t written) {
  if (in_force <= written) return false;
  return written == 0 || judged_by >= in_force;
}

}  // namespace ols::logger
