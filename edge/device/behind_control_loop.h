// The priority of threads whose work may wait for the control loop's: encoders, disks.
#pragma once

#include <string>

namespace ols::device {

// Lowers the calling thread's priority below the control loop's. Empty, or why that failed: where a
// system call filter forbids it, only the priority is lost.
std::string go_behind_control_loop();

}  // namespace ols::device
