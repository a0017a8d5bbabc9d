#include "edge/device/password_file.h"

#include <cstddef>
#include <exception>

#include "base/files/small_file.h"

namespace ols::device {
namespace {

constexpr std::size_t kLongestPassword = 4096;
constexpr double kLook_s = 1.0;

}  // namespace

std::string read_password(const std::string& file) {
  if (file.empty()) return {};
  const std::string text = read_small_file(file, kLongestPassword);
  return text.substr(0, text.find_first_of("\r\n"));
}

void wait_for_other_password(const std::string& file, const std::string& refused,
                             const std::function<bool(double)>& wait) {
  for (double waited_s = 0.0; waited_s < kLoginPause_s; waited_s += kLook_s) {
    if (!wait(kLook_s)) return;
    try {
      if (read_password(file) != refused) return;
    } catch (const std::exception&) {  // it is being replaced
    }
  }
}

}  // namespace ols::device
