#include "base/process/shutdown.h"

#include <atomic>
#include <csignal>

namespace ols {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may touch it

}  // namespace

void install_shutdown_handler() {
  struct sigaction action {};
  action.sa_handler = [](int) { requested = true; };
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
}

bool shutdown_requested() { return requested; }

}  // namespace ols
