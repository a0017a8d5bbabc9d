// What a command to record may ask for.
#pragma once

#include <string>

#include "edge/recorder/recorder.h"

namespace ols::recorder {

inline constexpr double kLateFrame_s = 1.0;  // a frame comes at most so much after its exposure

// Why a recorder of this configuration cannot do it, whatever it remembers; empty: it may.
std::string wrong_with(const RecordCommand& command, const RecorderConfig& config, double now_s);

// Whoever asks again and again gets a few: eight at once, and then one more each 10 s.
class RecordRate {
 public:
  bool admit(double now_s);

 private:
  static constexpr double kMostAtOnce = 8.0, kAnother_s = 10.0;
  double left_ = kMostAtOnce;
  double at_s_ = 0.0;
};

}  // namespace ols::recorder
