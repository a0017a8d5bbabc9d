// The interface of GPIO lines: a few monitored inputs and a few outputs. There are two
// implementations. One uses libgpiod (gpio_lines_libgpiod.cpp, the only file that depends on
// libgpiod's version). The other one uses a Unix socket to another process, which serves the lines
// (gpio_lines_socket.cpp). The socket is for a remote I/O box, for a computer without a gpiochip,
// and for tests.
//
// The socket's protocol is text, one message per line of text. The server sends the level of each
// input when the client connects, at every change, and on request:
//   server: in 17 1     input line 17 is high
//   client: read 17     answered by "in 17 LEVEL" at once
//   client: out 22 0    set output line 22 low
// Any other message ends the connection.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ols::gpio {

enum class LineBias { kPullUp, kPullDown };

struct LineInput {
  int line = 0;
  LineBias bias = LineBias::kPullUp;
};

struct LineUse {
  std::vector<LineInput> inputs;
  std::vector<int> outputs;  // initially low
};

struct LineLevel {
  int line = 0;
  bool high = false;
  double time_s = 0.0;  // CLOCK_MONOTONIC of the edge, or of the reading on request
};

// For use by one thread only. All functions throw std::system_error, with chip and line in its
// message, if the lines have vanished or cannot be read.
class GpioLines {
 public:
  virtual ~GpioLines() = default;
  GpioLines() = default;
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  // The file descriptors on which the owner waits (POLLIN); then it calls receive().
  virtual std::vector<int> fds() const = 0;
  // The new levels of the inputs; those of one input are in order of time. Never waits.
  virtual std::vector<LineLevel> receive() = 0;
  // Requests the level of each input, which receive() then returns. This detects lost edges and
  // dead lines.
  virtual void refresh() = 0;
  virtual void write(int line, bool high) = 0;
};

// `chip`: as in GpioConfig. Throws std::system_error.
std::unique_ptr<GpioLines> open_gpio_lines(const std::string& chip, const LineUse& use);

// The two implementations.
std::unique_ptr<GpioLines> open_chip_lines(const std::string& chip, const LineUse& use);
std::unique_ptr<GpioLines> open_socket_lines(const std::string& path, const LineUse& use);

}  // namespace ols::gpio
