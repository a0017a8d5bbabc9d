#include "tools/calibrate/station_link.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "base/bus/boot_id.h"
#include "base/bus/channel_names.h"
#include "base/bus/message_stamp.h"
#include "base/process/clocks.h"
#include "geometry/angles.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/frame_request_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "tools/calibrate/motion_leave.h"
#include "wire/orders.h"
#include "wire/refusal_words.h"
#include "wire/station_status.h"

namespace ols::calibration {
namespace {

constexpr double kCommandLease_s = 2.0, kFrameLease_s = 4.0, kRateLease_s = 0.3;
constexpr double kTolerance_rad = 2e-4;  // some counts of a unit
constexpr double kNear_rad = 2e-3;       // a quarter of the run-up before an approach
constexpr double kStill_s = 0.1;         // no ringing of the tripod afterwards
constexpr int kPoll_ms = 20;

}  // namespace

std::shared_ptr<trust::BusTrust> StationLink::open_trust(const trust::TrustConfig& config) {
  trust::Self self;
  self.name = "operator";
  self.boot_id = draw_boot_id();
  self.commands = self.tells_list = true;
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

StationLink::StationLink(LcmBus& bus, std::string station)
    : station_(std::move(station)),
      bus_(bus),
      boot_id_(draw_boot_id()),
      awaited_(boot_id_, {}, clock_monotonic_s()) {
  bus_.subscribe(station_channel(kStatusChannel, station_),
                 [this](const BusMessage& message) { hear_status(message); });
  bus_.subscribe(station_channel(kReplyChannel, station_), [this](const BusMessage& message) {
    const auto reply = wire::decode_reply(message);
    if (reply && reply->order.boot_id == boot_id_) hear(*reply);
  });
  constexpr QueueLimits kFrames{.messages = 400, .bytes = 20'000'000};
  bus_.subscribe(
      station_channel(kFrameChannel, station_),
      [this](const BusMessage& message) { hear_part(message); }, kFrames);
  bus_.subscribe(station_channel(kProcedureAnswerChannel, station_),
                 [this](const BusMessage& message) { hear_answer(message); });
}

template <class Message>
void StationLink::address(Message& message, double lease_s) {
  stamp_message(message, clock_utime_us(), boot_id_, ++sequence_);
  message.station = station_;
  message.lease_s = lease_s;
}

void StationLink::hear_status(const BusMessage& message) {
  auto status = wire::decode_status(message);
  if (!status) return;
  status_ = std::move(*status);
  heard_s_ = clock_monotonic_s();
  arrived_utime_us_ = message.received_utime_us;
  awaited_.hear_angles({status_->pan_rad, status_->tilt_rad}, heard_s_);
  hold_.hear(status_->state);
}

std::optional<ols_msg::station_status_t> StationLink::status(double within_s) {
  const double end_s = clock_monotonic_s() + within_s;
  const auto before = status_ ? status_->sequence : std::int64_t{-1};
  while (clock_monotonic_s() < end_s && (!status_ || status_->sequence == before)) {
    bus_.handle(kPoll_ms);
  }
  return status_;
}

void StationLink::check_not_stopped() const {
  using M = ols_msg::station_status_t;
  if (!status_) return;
  if (status_->state == M::STATE_EMERGENCY) throw StationStopped("emergency stop at the station");
  if (status_->state == M::STATE_STOPPED) throw StationStopped("the station was stopped");
  if (status_->state == M::STATE_TRACKING || status_->state == M::STATE_COASTING) {
    throw StationStopped("somebody has given the station another task: it follows a target");
  }
  if (hold_.is_lost()) {
    throw StationStopped("somebody has stopped or released the station, or it has restarted");
  }
}

void StationLink::hear(const wire::Reply& reply) {
  if (reply.order.sequence == released_sequence_) released_ = reply.is_accepted;
  if (reply.order.sequence != pointed_sequence_) return;
  if (reply.is_accepted) hold_.accept();
  refusal_ = reply.is_accepted ? "" : wire::refusal_in_words(reply).text;
  unit_may_come_back_ = reply.reason == "no_unit";
}

std::int64_t StationLink::command(std::int8_t what, const PanTilt& angles) {
  ols_msg::ptu_command_t message;
  address(message, kCommandLease_s);
  message.command = what;
  message.pan_rad = angles.pan_rad;
  message.tilt_rad = angles.tilt_rad;
  bus_.publish(station_channel(kPtuChannel, station_), message);
  return message.sequence;
}

// By its time of arrival: it may have waited in the queue while something was computed.
double StationLink::status_age_s() const {
  return 1e-6 * static_cast<double>(clock_utime_us() - arrived_utime_us_);
}

bool StationLink::may_point() const {
  return status_ && ols::calibration::may_point(*status_, status_age_s());
}

std::optional<PanTilt> StationLink::angles() const {
  if (!status_ || !std::isfinite(status_->pan_rad) || !std::isfinite(status_->tilt_rad)) {
    return std::nullopt;
  }
  return PanTilt{status_->pan_rad, status_->tilt_rad};
}

double StationLink::status_gap_s() {
  constexpr int kPairs = 3;  // one may be lost
  constexpr double kPatience_s = 5.0;
  double least_s = std::numeric_limits<double>::infinity();
  for (int pair = 0; pair < kPairs && least_s >= kReliedOn_s; ++pair) {
    const auto first = status(kPatience_s);
    const std::int64_t first_utime_us = arrived_utime_us_;
    const auto second = status(kPatience_s);
    if (!first || !second || second->sequence == first->sequence) break;
    least_s = std::min(least_s, 1e-6 * static_cast<double>(arrived_utime_us_ - first_utime_us));
  }
  return least_s;
}

void StationLink::set_out(const PanTilt& angles) {
  awaited_ = {boot_id_, angles, clock_monotonic_s()};
  frame_.reset();
  refusal_.clear();
}

void StationLink::point() {
  hold_.point();
  pointed_sequence_ = command(ols_msg::ptu_command_t::COMMAND_POINT, awaited_.at());
}

void StationLink::turn_at(const PanTilt& rate_rad_s) {
  ols_msg::ptu_command_t message;
  address(message, kRateLease_s);
  message.command = ols_msg::ptu_command_t::COMMAND_RATE;
  message.pan_rate_rad_s = rate_rad_s.pan_rad;
  message.tilt_rate_rad_s = rate_rad_s.tilt_rad;
  bus_.publish(station_channel(kPtuChannel, station_), message);
}

bool StationLink::release() {
  if (!hold_.has_pointed()) return false;
  status(kReliedOn_s);
  const bool may = status_ && !hold_.is_lost() && may_release(*status_, status_age_s());
  hold_ = {};
  if (!may) return false;
  released_.reset();
  released_sequence_ = command(ols_msg::ptu_command_t::COMMAND_RELEASE, {});
  const double end_s = clock_monotonic_s() + kCommandLease_s;
  while (!released_ && clock_monotonic_s() < end_s) bus_.handle(kPoll_ms);
  return released_.value_or(false);
}

void StationLink::ask_frame(Arrival arrival, bool lossless) {
  ols_msg::frame_request_t message;
  address(message, kFrameLease_s);
  const bool stands = arrival == Arrival::kStands;
  message.at_angles = stands || arrival == Arrival::kPasses ? 1 : 0;
  message.pan_rad = awaited_.at().pan_rad;
  message.tilt_rad = awaited_.at().tilt_rad;
  message.tolerance_rad = stands ? kTolerance_rad : kNear_rad;
  message.still_s = stands || arrival == Arrival::kRests ? kStill_s : 0.0;
  message.encoding =
      lossless ? ols_msg::frame_request_t::ENCODING_PNG : ols_msg::frame_request_t::ENCODING_JPEG;
  awaited_.asked(message.sequence);
  bus_.publish(station_channel(kFrameRequestChannel, station_), message);
}

void StationLink::hear_part(const BusMessage& message) {
  ols_msg::frame_part_t part;
  if (!decode_of_schema(message, part)) return;
  auto file = awaited_.hear_part(part, clock_monotonic_s());
  if (file) complete(std::move(*file), part);
}

void StationLink::complete(std::vector<std::uint8_t> file, const ols_msg::frame_part_t& any) {
  FrameFile frame;
  frame.file = std::move(file);
  frame.lossless = any.encoding == ols_msg::frame_request_t::ENCODING_PNG;
  frame.taken.gray = cv::imdecode(frame.file, cv::IMREAD_GRAYSCALE);
  if (frame.taken.gray.empty()) return;  // it will be asked for again
  frame.taken.utime_us = any.utime;
  frame.taken.reading.pan = {any.pan_counts, any.pan_counts_s, any.approach_pan};
  frame.taken.reading.tilt = {any.tilt_counts, any.tilt_counts_s, any.approach_tilt};
  count_ = PanTilt{any.pan_count_rad, any.tilt_count_rad};
  frame.taken.angles = {any.pan_counts * any.pan_count_rad, any.tilt_counts * any.tilt_count_rad};
  frame_ = std::move(frame);
}

std::optional<FrameFile> StationLink::take_frame() { return std::exchange(frame_, std::nullopt); }

void StationLink::publish(ols_msg::procedure_t message) {
  answers_.ask(message.state == ols_msg::procedure_t::STATE_ASKING ? message.question : 0);
  stamp_message(message, clock_utime_us(), boot_id_, ++procedure_sequence_);
  message.station = station_;
  message.choices = static_cast<std::int16_t>(message.choice.size());
  message.jpeg_bytes = static_cast<std::int32_t>(message.jpeg.size());
  bus_.publish(station_channel(kProcedureChannel, station_), message);
}

void StationLink::hear_answer(const BusMessage& message) {
  ols_msg::procedure_answer_t answer;
  if (!decode_of_schema(message, answer) || answer.station != station_) return;
  answers_.hear(answer, clock_utime_us());
}

StationFacts facts_of(const ols_msg::station_status_t& status) {
  using M = ols_msg::station_status_t;
  StationFacts facts;
  facts.camera_works = std::string(wire::device_state(status, "camera")) == "ok";
  facts.unit_works = std::string(wire::device_state(status, "ptu")) == "ok";
  facts.moves = status.kind != M::KIND_FIXED;
  facts.limits_known = std::isfinite(status.pan_limits_rad[0]) && std::isfinite(status.pan_rad);
  facts.stopped = status.state == M::STATE_STOPPED;
  facts.held_by_hand = status.state == M::STATE_MANUAL;
  facts.emergency = status.state == M::STATE_EMERGENCY;
  facts.follows_target = status.state == M::STATE_TRACKING || status.state == M::STATE_COASTING;
  facts.has_position = status.position_source != M::POSE_NONE;
  facts.has_tilt = status.tilt_source != M::POSE_NONE;
  facts.position_sd_m = std::max(status.position_sd_m[0], status.position_sd_m[1]);
  facts.tilt_sd_deg = degrees(status.tilt_sd_rad);
  facts.heading_sd_deg = degrees(status.heading_sd_rad);
  facts.clock_synchronised = status.clock_state == ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  facts.clock_error_s = status.clock_error_s;
  facts.image_width_px = status.image_width_px;
  facts.image_height_px = status.image_height_px;
  facts.alarms = alarms_of(status);
  return facts;
}

}  // namespace ols::calibration
