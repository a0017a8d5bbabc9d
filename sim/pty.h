// A pseudo terminal that stands in for a serial device: what a product process opens is its slave,
// or a link to it. The line outlives clients: one may close the device and another open it again.
// For one thread at a time.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace ols::sim {

class Pty {
 public:
  // `link`: a symbolic link to the device is made there (an old link is replaced) and removed at
  // the end; empty: none. Throws std::system_error.
  explicit Pty(const std::string& link = "");
  ~Pty();
  Pty(Pty&&) noexcept;

  // The slave, for example /dev/pts/3; empty while unplugged.
  const std::string& device() const;

  // As when a USB adapter is pulled and put in again: the link goes, who has the device open finds
  // it hung up; then there is a new device under the same link. Doing either twice does nothing.
  void unplug();
  void plug();
  bool plugged() const;

  // Until a client has written something, but no longer than this.
  void wait(double timeout_s) const;

  // What clients have written by now; does not wait. Empty while unplugged.
  std::string read();

  // The rate that the client has set on its port, or who had it open last; 0 while unplugged or
  // when it is none that serial ports usually have.
  int client_baud() const;

  // For whoever has the device open. A line that nobody reads loses its bytes, here once the
  // terminal's buffer is full; so does one that is unplugged.
  void write(std::string_view bytes);

 private:
  struct Terminal;
  std::string link_;
  std::unique_ptr<Terminal> terminal_;  // nothing while unplugged
};

}  // namespace ols::sim
