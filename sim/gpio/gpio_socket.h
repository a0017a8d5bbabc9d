// GPIO lines on a Unix socket, with the protocol of edge/gpio/gpio_lines.h: inputs for emergency
// stop and re-arm button, outputs for status LED and camera trigger. Thread-safe.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace ols::sim {

struct GpioServerConfig {
  std::string path;  // of the socket; an old one is replaced
  int stop_line = 17;
  bool stop_active_low = false;  // as in GpioConfig
  int rearm_line = 18;
  bool rearm_active_low = true;
  int led_line = 22;
  int trigger_line = 27;
};

class GpioServer {
 public:
  explicit GpioServer(const GpioServerConfig& config);  // throws std::system_error
  ~GpioServer();
  GpioServer(const GpioServer&) = delete;
  GpioServer& operator=(const GpioServer&) = delete;

  void set_pressed(bool pressed);
  void hold_rearm(bool held);
  // Connections stay open without an answer, as with a process that hangs.
  void set_silent(bool silent);

  bool led() const;
  std::uint64_t led_changes() const;
  std::uint64_t triggers() const;  // rising edges of trigger_line
  int clients() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
