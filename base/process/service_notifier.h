// Tells the service manager (systemd) that the process is ready, what its status line is, and that
// its control loop is alive. Without a service manager, every call does nothing.
#pragma once

#include <string>

namespace ols {

class ServiceNotifier {
 public:
  // Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID as systemd sets them.
  ServiceNotifier();

  // The process is ready. `status`: the line that `systemctl status` shows.
  void ready(const std::string& status);
  // Replaces the status line, for example with the active alarms.
  void status(const std::string& text);
  // Call at each turn of the control loop, and nowhere else: if the loop hangs, the watchdog must
  // receive nothing more. Sends at most four times per watchdog interval. `now_s`: CLOCK_MONOTONIC.
  void alive(double now_s);
  void stopping();

 private:
  double interval_s_ = 0.0;  // 0: no watchdog
  double due_s_ = 0.0;
  std::string status_;
};

}  // namespace ols
