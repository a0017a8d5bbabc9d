// Translation between the station's types and the LCM messages; nothing is decided here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/aravis_camera.h"
#include "edge/config.h"
#include "edge/device_report.h"
#include "edge/ptu/ptu_thread.h"
#include "edge/station.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols {

// Who sends, and how its monotonic clock is turned into UTC at the moment.
struct Sender {
  std::string station;
  std::int64_t boot_id = 0;
  std::int64_t utc_minus_monotonic_us = 0;

  std::int64_t utime_us(double monotonic_s) const;
  double monotonic_s(std::int64_t utime_us) const;
};

DeviceState device_state(CameraState state);
DeviceState device_state(const PtuStatus& status);

ols_msg::bearing_t to_message(const Bearing& bearing, const Sender& sender,
                              const StationSettings& settings, std::int64_t sequence);

ols_msg::station_status_t to_message(const StationSnapshot& snapshot, const Sender& sender,
                                     const StationSettings& settings, const PtuLimits& limits,
                                     const std::vector<DeviceReport>& devices, double now_s,
                                     std::int64_t sequence);

// A JPEG that fits into one datagram; nothing when even the smallest picture does not.
std::optional<ols_msg::preview_t> to_preview(const Frame& frame,
                                             const std::optional<cv::Rect2d>& box,
                                             const Sender& sender, std::int64_t sequence);

DesignateCommand from_message(const ols_msg::designate_t& message, const Sender& sender);
SlewCommand from_message(const ols_msg::slew_t& message, const Sender& sender, double now_s);
PointCommand from_message(const ols_msg::ptu_command_t& message);

template <class Message>
CommandStamp stamp_of(const Message& message) {
  return {message.utime, message.boot_id, message.sequence, message.lease_s};
}

}  // namespace ols
