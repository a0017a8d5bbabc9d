// A pseudo terminal in place of a serial device: a product process opens the terminal's slave, or a
// link to it. When a client closes the device, the line remains, and any client may open the device
// again. Only one thread at a time may use this object.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace ols::sim {

class Pty {
 public:
  // `link`: path of a symbolic link to the device; replaces an old link, and is removed at the end;
  // empty: none. Throws std::system_error.
  explicit Pty(const std::string& link = "");
  ~Pty();
  Pty(Pty&&) noexcept;

  // The path of the slave, for example /dev/pts/3; empty while unplugged.
  const std::string& device() const;

  // Simulate unplugging a USB adapter and plugging it in again. After unplug() the link is gone,
  // and a client that has opened the device gets a hang-up. After plug() there is a new device with
  // the same link. Calling either of them again has no effect.
  void unplug();
  void plug();
  bool plugged() const;

  // Waits until a client has written something, but at most `timeout_s`.
  void wait(double timeout_s) const;

  // The bytes written by clients so far; does not wait. Empty while unplugged.
  std::string read();

  // The baud rate that the current or last client has set; 0 while unplugged, or for an unusual
  // rate.
  int client_baud() const;

  // Sends to the client that has opened the device. If no client reads, bytes are lost once the
  // terminal's buffer is full. While unplugged, all bytes are lost.
  void write(std::string_view bytes);

 private:
  struct Terminal;
  std::string link_;
  std::unique_ptr<Terminal> terminal_;  // null while unplugged
};

}  // namespace ols::sim
