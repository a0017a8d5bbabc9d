// A station on the bus: takes commands in, sends bearings, status and previews out. Decodes, checks
// who is meant and whether the command is fresh, and counts whatever it refuses.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "base/lcm_bus.h"
#include "edge/config.h"
#include "edge/messages.h"

namespace ols {

class StationBus {
 public:
  // Throws BusError. The references must outlive the bus.
  StationBus(const StationSettings& settings, std::int64_t boot_id, Station& station);

  // The clocks of this moment, for everything until the next call.
  void set_time(double monotonic_s, std::int64_t utime_us);

  // Hands the waiting commands to the station.
  void receive();

  // The last refused command in words, and how many there were.
  const std::string& last_refusal() const { return last_refusal_; }
  std::uint64_t refusals() const { return refusals_; }

  void send(const Bearing& bearing);
  void send_status(StationSnapshot snapshot, const PtuLimits& limits,
                   const std::vector<DeviceReport>& devices, const std::string& last_error);
  void send_preview(const Frame& frame, const std::optional<cv::Rect2d>& box);

 private:
  // Messages that `passes` is true for need not be fresh.
  template <class Message>
  void on_command(const std::string& kind, const std::function<Refusal(const Message&)>& execute,
                  const std::function<bool(const Message&)>& passes);
  Refusal command_ptu(const ols_msg::ptu_command_t& message);
  void refuse(const std::string& kind, const std::string& why);
  void trouble(const std::string& what);

  const StationSettings& settings_;
  Station& station_;
  Sender sender_;
  double now_s_ = 0.0;
  LcmBus bus_;
  std::map<std::string, CommandGate> gates_;
  std::map<std::string, double> counters_;  // refusals before the station
  std::map<std::string, std::int64_t> sequences_;
  std::string last_refusal_;
  std::uint64_t refusals_ = 0;
  std::string last_error_;
  std::int64_t last_error_utime_ = 0;
};

}  // namespace ols
