#include "edge/command/rearm_signal.h"

#include <atomic>
#include <csignal>

namespace ols::station {
namespace {

std::atomic<bool> wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may touch it

}  // namespace

void install_rearm_handler() {
  struct sigaction action {};
  action.sa_handler = [](int) { wanted = true; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
}

bool take_rearm_signal() { return wanted.exchange(false); }

}  // namespace ols::station
