// Tells the service manager (systemd) that this process is up, what it does, and that its control
// loop turns. Where there is no service manager every call does nothing.
#pragma once

#include <string>

namespace ols {

class ServiceNotifier {
 public:
  // Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID as systemd sets them.
  ServiceNotifier();

  // The process serves from now on. `status` is the line that `systemctl status` shows.
  void ready(const std::string& status);
  // Another line, for example the alarms that hold.
  void status(const std::string& text);
  // Call at each turn of the control loop, and from nowhere else: a loop that hangs must starve the
  // watchdog. Sends four times in the watchdog's interval at most. `now_s`: CLOCK_MONOTONIC.
  void alive(double now_s);
  void stopping();

 private:
  double interval_s_ = 0.0;  // 0: no watchdog
  double due_s_ = 0.0;
  std::string status_;
};

}  // namespace ols
