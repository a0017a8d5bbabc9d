// A serial device, 8N1 or 8E1 and raw, without handshake. Plain termios: libserialport refuses what
// is not in sysfs, pseudo terminals among it.
#pragma once

#include <string>
#include <string_view>

#include "base/wakeup.h"

namespace ols {

enum class Parity { kNone, kEven };

class SerialPort {
 public:
  // Opens and locks the device; what stood in its buffers is dropped. `wakeup` may be null. Throws
  // std::system_error with the device's name: not there, no right to it, not a terminal, in use,
  // unknown rate.
  SerialPort(const std::string& device, int baud, Parity parity = Parity::kNone,
             const Wakeup* wakeup = nullptr);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // What is there, after waiting for it at most `timeout_s` or until woken up. Throws when the
  // device has vanished.
  std::string read(double timeout_s);

  // All of it, unless woken up before: then the rest is dropped. Throws when the device has
  // vanished or takes nothing for 0.2 s.
  void write(std::string_view bytes);

  // The same ahead of everything that was written and is not on the line yet, which is dropped.
  // Does not wait: false when the device does not take it now.
  bool write_first(std::string_view bytes);

  // Another rate, once everything written is on the line. Throws.
  void set_baud(int baud);

  // Waits until everything written is on the line; false when it is not after `timeout_s`.
  bool drain(double timeout_s);

 private:
  void configure(int baud, Parity parity);
  void set_rate(int baud);
  bool wait_for(short events, double timeout_s) const;
  [[noreturn]] void fail(int error, const char* what) const;

  std::string device_;
  const Wakeup* wakeup_;
  int fd_ = -1;
};

}  // namespace ols
