// What a command to record may ask for.
#pragma once

#include <string>

#include "edge/recorder/recorder.h"

namespace ols {

inline constexpr double kLateFrame_s = 1.0;  // a frame comes at most so much after its exposure

// Why a recorder of this configuration cannot do it, whatever it remembers; empty: it may.
std::string wrong_with(const RecordCommand& command, const RecorderConfig& config, double now_s);

}  // namespace ols
