#include "base/process/service_notifier.h"

#include <systemd/sd-daemon.h>

#include <cstdint>

namespace ols {
namespace {

constexpr double kSendsPerInterval = 4.0;

// One assignment per line: a text must not contain a newline.
std::string status_line(std::string text) {
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return "STATUS=" + text;
}

}  // namespace

ServiceNotifier::ServiceNotifier() {
  std::uint64_t watchdog_us = 0;
  if (sd_watchdog_enabled(0, &watchdog_us) > 0) {
    interval_s_ = 1e-6 * static_cast<double>(watchdog_us) / kSendsPerInterval;
  }
}

void ServiceNotifier::ready(const std::string& status) {
  status_ = status;
  sd_notify(0, ("READY=1\n" + status_line(status)).c_str());
}

void ServiceNotifier::status(const std::string& text) {
  if (text == status_) return;
  status_ = text;
  sd_notify(0, status_line(text).c_str());
}

void ServiceNotifier::alive(double now_s) {
  if (interval_s_ <= 0.0 || now_s < due_s_) return;
  due_s_ = now_s + interval_s_;
  sd_notify(0, "WATCHDOG=1");
}

void ServiceNotifier::stopping() { sd_notify(0, "STOPPING=1"); }

}  // namespace ols
