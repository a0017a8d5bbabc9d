// Simulated GPIO lines on a Unix socket, with the protocol of edge/gpio/gpio_lines.h. The
// station's inputs are emergency stop and re-arm button; its outputs are status LED and camera
// trigger.
// Thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace ols::sim {

struct GpioServerConfig {
  std::string path;  // of the socket; an old socket at this path is replaced
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

  void set_pressed(bool pressed);
  void hold_rearm(bool held);
  // Connections stay open but get no answer, as if the process hung.
  void set_silent(bool silent);

  bool led() const;
  std::uint64_t led_changes() const;
  std::uint64_t triggers() const;  // rising edges of trigger_line
  int clients() const;

 private:
  void run(const std::stop_token& ended);
  void greet();
  void tell(int fd, int line) const;
  void serve(int fd);
  bool obey(int fd, const std::string& text);

  const GpioServerConfig config_;
  const int listener_, bell_;

  mutable std::mutex mutex_;            // for everything below
  std::map<int, std::string> clients_;  // by file descriptor: the incomplete line received so far
  bool pressed_ = false, rearm_held_ = false, silent_ = false;
  bool led_ = false, trigger_ = false;
  std::uint64_t led_changes_ = 0, triggers_ = 0;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::sim
