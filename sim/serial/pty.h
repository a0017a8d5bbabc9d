// A pseudo terminal in place of a serial device: a product process opens its slave, or a link to
// it. The line outlives clients: one may close the device and another open it again. For one thread
// at a time.
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

  // The slave, for example /dev/pts/3; empty while unplugged.
  const std::string& device() const;

  // Simulates unplugging a USB adapter and plugging it in again. The link disappears, and a client
  // with the open device gets a hang-up; then there is a new device under the same link. Repeating
  // either has no effect.
  void unplug();
  void plug();
  bool plugged() const;

  // Waits until a client has written something, at most timeout_s.
  void wait(double timeout_s) const;

  // The bytes written by clients so far; does not wait. Empty while unplugged.
  std::string read();

  // The rate that the current or last client has set on its port; 0 while unplugged, or for an
  // unusual rate.
  int client_baud() const;

  // Sends to a client with the open device. Without a reader, bytes are lost once the terminal's
  // buffer is full. While unplugged, they are lost at once.
  void write(std::string_view bytes);

 private:
  struct Terminal;
  std::string link_;
  std::unique_ptr<Terminal> terminal_;  // null while unplugged
};

}  // namespace ols::sim
