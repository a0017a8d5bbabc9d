// Lowers the priority of threads whose work is less urgent than the control loop's: encoding
// pictures, writing to disks.
#pragma once

#include <string>

namespace ols::device {

// Sets the calling thread's priority below the control loop's. Returns an empty text, or the reason
// for a failure, for example a system call filter. After a failure, the thread runs on at its old
// priority.
std::string go_behind_control_loop();

}  // namespace ols::device
