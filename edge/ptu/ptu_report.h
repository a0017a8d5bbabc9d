// Makes the device report of a PTU from its state. Pure.
#pragma once

#include "edge/device/device_report.h"
#include "edge/ptu/ptu_status.h"

namespace ols::ptu {

device::DeviceReport ptu_report(const PtuConfig& config, const PtuStatus& status, double now_s);

}  // namespace ols::ptu
