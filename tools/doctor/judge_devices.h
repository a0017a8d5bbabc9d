// Judges a station's devices and advises what to do. Pure.
#pragma once

#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace ols::doctor {

// A device as the station or its own driver reports it.
Finding judge(const device::DeviceReport& device);
// Judges a serial line; nullopt: it can be used.
std::optional<Finding> judge_line(const std::string& name, const SerialFacts& serial);
Findings judge(const PtuAnswers& ptu);
Findings judge(const CameraAnswers& camera);
Findings judge(const LinkFacts& link, double rate_bytes_s);

}  // namespace ols::doctor
