// Converts between the station's types and LCM messages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "edge/clock/clock_watch.h"
#include "edge/command/command_turn.h"
#include "edge/config/config.h"
#include "edge/frames/frame_desk.h"
#include "edge/skyline/skyline_part.h"
#include "edge/station/station.h"
#include "edge/station/station_report.h"
#include "edge/video/preview_picture.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/frame_part_t.hpp"
#include "ols_msg/frame_request_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "ols_msg/sighting_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::station {

// The sender of a station's messages, with its clocks: the present difference between UTC and
// monotonic time, and the quality of UTC.
struct Sender {
  std::string station;
  std::int64_t boot_id = 0;
  std::int64_t utc_minus_monotonic_us = 0;
  clock::ClockQuality clock;

  std::int64_t utime_us(double monotonic_s) const;
  double monotonic_s(std::int64_t utime_us) const;
};

ols_msg::bearing_t to_message(const Bearing& bearing, const Sender& sender,
                              const StationSettings& settings, std::int64_t sequence);

ols_msg::sighting_t to_message(const Sighting& sighting, const Sender& sender,
                               std::int64_t sequence);

ols_msg::skyline_t to_message(const skyline::SkylinePart& part, const Sender& sender, double now_s,
                              std::int64_t sequence);

ols_msg::station_status_t to_message(const StationReport& report, const Sender& sender,
                                     const StationSettings& settings, double now_s,
                                     std::int64_t sequence);

ols_msg::preview_t to_message(const video::PreviewPicture& picture, const camera::Frame& frame,
                              const std::optional<cv::Rect2d>& box, const Sender& sender,
                              std::int64_t sequence);

ols_msg::frame_part_t to_message(const FramePart& part, const Sender& sender,
                                 std::int64_t sequence);

// The answer to a command. `reason`: why the command is refused, as one word (such as
// "other_station"), which counters of refusals have in their names; empty if the command is carried
// out. `detail`: the reason in words; may be empty.
struct Answer {
  CommandId command;
  std::string reason{}, detail{};
  StationState state = StationState::kIdle;  // the state after the command
};
ols_msg::command_reply_t to_message(const Answer& answer, const Sender& sender, double now_s,
                                    std::int64_t sequence);

DesignateCommand from_message(const ols_msg::designate_t& message, const Sender& sender);
SlewCommand from_message(const ols_msg::slew_t& message, const Sender& sender, double now_s);
OcclusionCommand from_message(const ols_msg::occlusion_t& message, const Sender& sender,
                              double now_s);
PointCommand from_message(const ols_msg::ptu_command_t& message);
CentreCommand centre_from_message(const ols_msg::ptu_command_t& message, const Sender& sender);
RateCommand rate_from_message(const ols_msg::ptu_command_t& message, double now_s);
// nullopt if a time in the message is not finite, negative or too large.
std::optional<recorder::RecordCommand> from_message(const ols_msg::record_t& message,
                                                    const Sender& sender, double now_s);

FrameRequest from_message(const ols_msg::frame_request_t& message, double now_s);

template <class Message>
CommandStamp stamp_of(const Message& message) {
  return {message.utime, message.boot_id, message.sequence, message.lease_s};
}

}  // namespace ols::station
