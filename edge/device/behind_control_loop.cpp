#include "edge/device/behind_control_loop.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace ols::device {
namespace {

constexpr int kNice = 10;  // the unit's own: -5

}  // namespace

std::string go_behind_control_loop() {
  const auto thread_id = static_cast<id_t>(::gettid());
  if (::getpriority(PRIO_PROCESS, thread_id) >= kNice) return {};
  if (::setpriority(PRIO_PROCESS, thread_id, kNice) == 0) return {};
  return std::string("runs at the control loop's priority (") + std::strerror(errno) + ")";
}

}  // namespace ols::device
