// Writes the SAPIENT messages that we send, framed, according to BSI Flex 335 v2.0. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/records.h"
#include "export/sapient/sapient_node.h"

namespace ols::exports {

std::string sapient_status(const SapientSettings& settings, const std::vector<Station>& stations,
                           std::int64_t utime_us);

// A status that says goodbye: the last message of a node that stops.
std::string sapient_goodbye(const SapientSettings& settings, std::int64_t utime_us);

// `stamp_us`: time of the report, to which the target is extrapolated.
std::string sapient_detection(const SapientSettings& settings, const Target& target,
                              std::int64_t stamp_us);

// Refuses a task of the receiver, because only the fusion leads stations.
std::string sapient_task_refusal(const SapientSettings& settings, const std::string& task_id,
                                 const std::string& to, std::int64_t utime_us);

// The types of detection information that ols-export sends begin with this text. ols-cue checks for
// it, so that it does not take a detection from ols-export for a target of another system.
inline constexpr const char* kSapientOwn = "ols.";

}  // namespace ols::exports
