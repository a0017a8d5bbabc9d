// A raw serial device with 8N1 or 8E1 and without handshake. It uses plain termios, because
// libserialport refuses devices that are not in sysfs, such as pseudo terminals.
#pragma once

#include <string>
#include <string_view>

#include "base/process/wakeup.h"

namespace ols::serial {

enum class Parity { kNone, kEven };

class SerialPort {
 public:
  // Opens and locks the device, and clears its buffers. `wakeup` may be null. Throws
  // std::system_error with the device's name: missing, no permission, not a terminal, in use, or
  // unknown rate.
  SerialPort(const std::string& device, int baud, Parity parity = Parity::kNone,
             const Wakeup* wakeup = nullptr);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // Waits for bytes at most `timeout_s` or until woken up. Returns the bytes. Throws if the device
  // has vanished.
  std::string read(double timeout_s);

  // Writes all bytes; if woken up, drops the rest. Throws if the device has vanished or accepts
  // nothing for 0.2 s.
  void write(std::string_view bytes);

  // Drops the bytes that are not on the line yet, and writes `bytes`. It does not wait. Returns
  // false if the device does not accept them now.
  bool write_first(std::string_view bytes);

  // Changes the baud rate once all written bytes are on the line. Throws std::system_error.
  void set_baud(int baud);

  // Waits until all written bytes are on the line; returns false on timeout.
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

}  // namespace ols::serial
