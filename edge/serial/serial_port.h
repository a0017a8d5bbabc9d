// A serial device in raw mode, with 8N1 or 8E1 and without handshake. It uses termios directly,
// because libserialport refuses devices that are not in sysfs, such as pseudo terminals.
#pragma once

#include <string>
#include <string_view>

#include "base/process/wakeup.h"

namespace ols::serial {

enum class Parity { kNone, kEven };

class SerialPort {
 public:
  // Opens and locks the device, and clears its buffers. `wakeup` ends waiting in read() and
  // write(); it may be null. Throws std::system_error with the device's name if the device is
  // missing, in use or not a serial device, or if the permission or the baud rate is wrong.
  SerialPort(const std::string& device, int baud, Parity parity = Parity::kNone,
             const Wakeup* wakeup = nullptr);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // Waits until bytes arrive, a wakeup comes, or `timeout_s` has passed. Returns the bytes, which
  // may be none. Throws std::system_error if the device has vanished.
  std::string read(double timeout_s);

  // Writes all bytes. If a wakeup comes while the device accepts no bytes, the remaining bytes are
  // dropped. Throws std::system_error if the device has vanished or accepts nothing for 0.2 s.
  void write(std::string_view bytes);

  // Drops earlier bytes that have not been sent yet, and writes `bytes`. Does not wait. Returns
  // false if the device does not accept all of `bytes` at once.
  bool write_first(std::string_view bytes);

  // Waits until all written bytes are sent, but at most 0.3 s; then changes the baud rate. Throws
  // std::system_error.
  void set_baud(int baud);

  // Waits until all written bytes are sent; returns false on timeout.
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
