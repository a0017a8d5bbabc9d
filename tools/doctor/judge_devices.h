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
// What `ols-calibrate mount` has found: whether a mount that other programs can also turn really
// moves, and what its positions are worth. `record`: the text that it kept; empty if there is none.
Finding judge_measured_mount(const std::string& record, const std::string& station);
// A camera that turns by ONVIF sends its own pictures; nullopt: both are at one host.
std::optional<Finding> judge_hosts(const std::string& of_pictures, const std::string& of_mount);
Findings judge(const CameraAnswers& camera);
Findings judge(const LinkFacts& link, double rate_bytes_s);

}  // namespace ols::doctor
