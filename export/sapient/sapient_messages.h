// What we say in SAPIENT: BSI Flex 335 v2.0, framed. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/records.h"
#include "export/sapient/sapient_node.h"

namespace ols::exports {

std::string sapient_status(const SapientSettings& settings, const std::vector<Station>& stations,
                           std::int64_t utime_us);

// The last one of a node that goes.
std::string sapient_goodbye(const SapientSettings& settings, std::int64_t utime_us);

// `stamp_us`: of the report; the target is told where it is then.
std::string sapient_detection(const SapientSettings& settings, const Target& target,
                              std::int64_t stamp_us);

// Refuses a task: nobody but the fusion leads stations.
std::string sapient_task_refusal(const SapientSettings& settings, const std::string& task_id,
                                 const std::string& to, std::int64_t utime_us);

// Information of a detection whose type begins with this is of ols-export: nobody else's target.
inline constexpr const char* kSapientOwn = "ols.";

}  // namespace ols::exports
