// ols-bench-onvif: which motions in the picture raise an alarm, and which do not.
#pragma once

namespace ols::bench {

// Prints a table of false alarms, and one of how soon the camera stands after a motion that the
// station did not order.
void say_alarms(int seeds);

}  // namespace ols::bench
