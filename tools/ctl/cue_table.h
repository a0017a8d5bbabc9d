// The cues from outside, as a table for a person. Pure.
#pragma once

#include <string>

#include "command/messages.h"

namespace ols::ctl {

std::string cue_table(const command::FusionCues& said);

}  // namespace ols::ctl
