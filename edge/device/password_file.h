// The password of a device on the network, in a file that only the station can read.
#pragma once

#include <functional>
#include <string>

namespace ols::device {

// The first line; empty without a file. Throws std::system_error.
std::string read_password(const std::string& file);

// After a refused login: until the file has another password, or for a quarter of an hour, because
// devices lock an account after five to ten refusals for half an hour. `wait`: waits for so many
// seconds; false: the device is no longer wanted.
void wait_for_other_password(const std::string& file, const std::string& refused,
                             const std::function<bool(double)>& wait);
inline constexpr double kLoginPause_s = 900.0;

}  // namespace ols::device
