// The cues from outside, as a table for a person. Pure.
#pragma once

#include <string>

#include "ols_msg/fusion_status_t.hpp"

namespace ols::ctl {

std::string cue_table(const ols_msg::fusion_status_t& status);

}  // namespace ols::ctl
