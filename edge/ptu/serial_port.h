// A serial device, 8N1 or 8E1 and raw, without handshake. Plain termios: libserialport refuses what
// is not in sysfs, pseudo terminals among it.
#pragma once

#include <string>
#include <string_view>

namespace ols {

enum class Parity { kNone, kEven };

class SerialPort {
 public:
  // Opens and locks the device; what stood in its buffers is dropped. Throws std::system_error with
  // the device's name: not there, no right to it, not a terminal, in use, unknown rate.
  SerialPort(const std::string& device, int baud, Parity parity = Parity::kNone);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // What is there, after waiting for it at most `timeout_s`. Throws when the device has vanished.
  std::string read(double timeout_s);

  // All of it. Throws when the device has vanished or takes nothing for 0.2 s.
  void write(std::string_view bytes);

  // Waits until everything written is on the line; false when it is not after `timeout_s`.
  bool drain(double timeout_s);

 private:
  void configure(int baud, Parity parity);
  [[noreturn]] void fail(int error, const char* what) const;

  std::string device_;
  int fd_ = -1;
};

}  // namespace ols
