// Reads a device's password from a file that only the station can read.
#pragma once

#include <functional>
#include <string>

namespace ols::device {

// Returns the file's first line; empty if the file's name is empty. Throws std::system_error.
std::string read_password(const std::string& file);

// Call after a device has refused the password `refused`. Waits until the file contains another
// password, but at most for kLoginPause_s. Without this pause, devices would lock the account: they
// do so for half an hour after five to ten refusals. `wait`: a function that waits for a number of
// seconds, and returns false if the device is no longer wanted; wait_for_other_password() then
// returns.
void wait_for_other_password(const std::string& file, const std::string& refused,
                             const std::function<bool(double)>& wait);
inline constexpr double kLoginPause_s = 900.0;

}  // namespace ols::device
