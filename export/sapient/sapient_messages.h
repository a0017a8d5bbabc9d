// The SAPIENT messages that we send: BSI Flex 335 v2.0, framed. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/records.h"
#include "export/sapient/sapient_node.h"

namespace ols::exports {

std::string sapient_status(const SapientSettings& settings, const std::vector<Station>& stations,
                           std::int64_t utime_us);

// The last message of a node that stops.
std::string sapient_goodbye(const SapientSettings& settings, std::int64_t utime_us);

// `stamp_us`: time of the report; the target is extrapolated to it.
std::string sapient_detection(const SapientSettings& settings, const Target& target,
                              std::int64_t stamp_us);

// Refuses a task: only the fusion leads stations.
std::string sapient_task_refusal(const SapientSettings& settings, const std::string& task_id,
                                 const std::string& to, std::int64_t utime_us);

// Types of detection information that begin with this text are ours. A detection that contains one
// was sent by an ols-export, so ols-cue does not take it for a target of another system.
inline constexpr const char* kSapientOwn = "ols.";

}  // namespace ols::exports
