// Formats the cues from outside as a table for a person. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "ols_msg/fusion_status_t.hpp"

namespace ols::ctl {

// The class of each target in words, by the target's number.
using TargetClasses = std::map<std::int64_t, std::string>;

std::string cue_table(const ols_msg::fusion_status_t& status, const TargetClasses& classes);

}  // namespace ols::ctl
