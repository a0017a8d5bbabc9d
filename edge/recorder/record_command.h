// Checks commands to record.
#pragma once

#include <string>

#include "edge/recorder/recorder.h"

namespace ols::recorder {

inline constexpr double kLateFrame_s = 1.0;  // largest delay of a frame after its exposure

// Why the command cannot be carried out with this configuration; empty if it can. Whether the
// frames are in memory is not checked here.
std::string wrong_with(const RecordCommand& command, const RecorderConfig& config, double now_s);

// Limits the rate of recording commands: eight at once, then one every 10 s.
class RecordRate {
 public:
  bool admit(double now_s);

 private:
  static constexpr double kMostAtOnce = 8.0, kAnother_s = 10.0;
  double left_ = kMostAtOnce;
  double at_s_ = 0.0;
};

}  // namespace ols::recorder
