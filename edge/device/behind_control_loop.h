// Lowers the priority of threads whose work may wait for the control loop: encoders, disks.
#pragma once

#include <string>

namespace ols::device {

// Lowers the calling thread's priority below the control loop's. Returns empty, or why this failed.
// If a system call filter forbids it, only the priority is affected.
std::string go_behind_control_loop();

}  // namespace ols::device
