// Reads the password of a device on the network from a file that only the station can read.
#pragma once

#include <functional>
#include <string>

namespace ols::device {

// Returns the file's first line; empty if `file` is empty. Throws std::system_error.
std::string read_password(const std::string& file);

// Call after a refused login: waits until the file has another password, or for a quarter of an
// hour, because devices lock an account for half an hour after five to ten refusals. `wait`: waits
// for a number of seconds; returns false if the device is no longer wanted.
void wait_for_other_password(const std::string& file, const std::string& refused,
                             const std::function<bool(double)>& wait);
inline constexpr double kLoginPause_s = 900.0;

}  // namespace ols::device
