// GPIO lines as this product needs them: a few inputs that are watched, a few outputs. Behind it
// stand libgpiod (gpio_lines_libgpiod.cpp, the one file that knows its version) and a Unix socket
// (gpio_lines_socket.cpp): lines that another process serves, for a remote I/O box, for a machine
// without a gpiochip, and for tests.
//
// The socket's protocol is text, a message a line. The server names the level of each input on
// connect, at every change, and when asked:
//   server: in 17 1     input line 17 is high
//   client: read 17     answered by "in 17 LEVEL" at once
//   client: out 22 0    output line 22 shall be low
// A line that is none of these ends the connection.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ols {

enum class LineBias { kPullUp, kPullDown };

struct LineInput {
  int line = 0;
  LineBias bias = LineBias::kPullUp;
};

struct LineUse {
  std::vector<LineInput> inputs;
  std::vector<int> outputs;  // low at first
};

struct LineLevel {
  int line = 0;
  bool high = false;
  double time_s = 0.0;  // CLOCK_MONOTONIC of the edge, or of the reading
};

// One thread uses it. Everything throws std::system_error, naming chip and line, when the lines
// have vanished or cannot be read.
class GpioLines {
 public:
  virtual ~GpioLines() = default;
  GpioLines() = default;
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  // To be polled for reading; empty when there is nothing to wait for.
  virtual std::vector<int> fds() const = 0;
  // Levels of the inputs that have come in, of each the oldest first. Never waits.
  virtual std::vector<LineLevel> receive() = 0;
  // Asks for the level of each input anew, which receive() then brings: finds lost edges and dead
  // lines.
  virtual void refresh() = 0;
  virtual void write(int line, bool high) = 0;
};

// `chip` as in GpioConfig. Throws std::system_error.
std::unique_ptr<GpioLines> open_gpio_lines(const std::string& chip, const LineUse& use);

// The two kinds.
std::unique_ptr<GpioLines> open_chip_lines(const std::string& chip, const LineUse& use);
std::unique_ptr<GpioLines> open_socket_lines(const std::string& path, const LineUse& use);

}  // namespace ols
