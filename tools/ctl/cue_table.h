// The cues from outside, for a person. Pure.
#pragma once

#include <string>

#include "command/messages.h"

namespace ols::ctl {

std::string cue_table(const command::FusionCues& said);

}  // namespace ols::ctl
