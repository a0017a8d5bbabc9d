#include "edge/messages/messages.h"

#include <cmath>
#include <limits>
#include <map>

#include "base/bus/message_code.h"
#include "base/bus/message_stamp.h"
#include "conditions/alarm.h"
#include "edge/messages/messages_borders.h"
#include "edge/messages/messages_lens.h"
#include "edge/messages/messages_sighting.h"
#include "geometry/angles.h"

namespace ols::station {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Message>
void stamp(Message& message, const Sender& sender, std::int64_t utime_us, std::int64_t sequence) {
  stamp_message(message, utime_us, sender.boot_id, sequence);
  message.station = sender.station;
}

void symmetric(const Eigen::Matrix2d& matrix, double (&out)[3]) {
  out[0] = matrix(0, 0);
  out[1] = matrix(0, 1);
  out[2] = matrix(1, 1);
}

using Status = ols_msg::station_status_t;
static_assert(code(clock::ClockState::kUnsynchronised) == ols_msg::bearing_t::CLOCK_UNSYNCHRONISED);
static_assert(code(sensors::PoseSource::kSensor) == Status::POSE_SENSOR);
static_assert(code(StationState::kEmergency) == Status::STATE_EMERGENCY);
static_assert(code(CalibrationState::kDoubted) == Status::CALIBRATION_DOUBTED);
static_assert(code(device::DeviceState::kFault) == Status::DEVICE_FAULT);

// The id of the configured calibration, or a new one for each pose that the sensors gave in this
// boot. (Steps of splitmix64.)
std::int64_t calibration_id(std::int64_t configured, std::int64_t boot_id, std::int64_t revision) {
  if (revision == 0) return configured;
  auto bits = static_cast<std::uint64_t>(configured);
  for (const std::int64_t part : {boot_id, revision}) {
    bits = (bits ^ static_cast<std::uint64_t>(part)) + 0x9E3779B97F4A7C15U;
    bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
    bits ^= bits >> 31U;
  }
  return static_cast<std::int64_t>(bits >> 1U);
}

void fill_pose(const StationSnapshot& snapshot, const StationGeometry& geometry,
               ols_msg::station_status_t& message) {
  const sensors::StationPose& pose = snapshot.pose;
  const bool known = pose.position_source != sensors::PoseSource::kNone;
  message.latitude_deg = known ? degrees(pose.position.latitude_rad) : kNaN;
  message.longitude_deg = known ? degrees(pose.position.longitude_rad) : kNaN;
  message.height_m = known ? pose.position.height_m : kNaN;
  for (int i = 0; i < 3; ++i) {
    message.position_sd_m[i] = known ? pose.position_sd_enu_m[i] : kNaN;
    message.camera_ecef_m[i] = known ? snapshot.camera_ecef[i] : kNaN;
  }
  message.heading_rad = geometry.chain.heading_rad;
  message.tilt_x_rad = pose.tilt_x_rad;
  message.tilt_y_rad = pose.tilt_y_rad;
  message.pan_sign = static_cast<std::int8_t>(geometry.chain.pan_sign);
  message.tilt_sign = static_cast<std::int8_t>(geometry.chain.tilt_sign);
  message.heading_sd_rad = geometry.sd.heading_rad;
  message.tilt_sd_rad = pose.tilt_sd_rad;
  message.position_source = code(pose.position_source);
  message.tilt_source = code(pose.tilt_source);
  const Eigen::Vector2d field = field_of_view(snapshot.camera.value_or(geometry.camera));
  message.field_of_view_rad[0] = field.x();
  message.field_of_view_rad[1] = field.y();
  message.image_width_px = geometry.camera.width_px;
  message.image_height_px = geometry.camera.height_px;
}

void fill_pointing(const StationReport& report, ols_msg::station_status_t& message) {
  const StationSnapshot& snapshot = report.snapshot;
  const mount::Limits& limits = report.limits;
  const bool limits_known = report.limits_known;
  message.pan_rad = snapshot.angles ? snapshot.angles->angles.pan_rad : kNaN;
  message.tilt_rad = snapshot.angles ? snapshot.angles->angles.tilt_rad : kNaN;
  message.pan_limits_rad[0] = limits_known ? limits.pan_min_rad : kNaN;
  message.pan_limits_rad[1] = limits_known ? limits.pan_max_rad : kNaN;
  message.tilt_limits_rad[0] = limits_known ? limits.tilt_min_rad : kNaN;
  message.tilt_limits_rad[1] = limits_known ? limits.tilt_max_rad : kNaN;
  message.azimuth_rad = snapshot.optical_axis ? snapshot.optical_axis->azimuth_rad : kNaN;
  message.elevation_rad = snapshot.optical_axis ? snapshot.optical_axis->elevation_rad : kNaN;
  message.target_offset_px[0] = snapshot.target_offset_px ? snapshot.target_offset_px->x() : kNaN;
  message.target_offset_px[1] = snapshot.target_offset_px ? snapshot.target_offset_px->y() : kNaN;
}

void fill_calibration(const CalibrationStatus& calibration, ols_msg::station_status_t& message) {
  message.calibration_state = code(calibration.state);
  message.calibration_id = calibration.id;
  message.calibration_utime = calibration.observed_utime_us;
  message.calibration_sd_rad = calibration.rms_rad > 0.0 ? calibration.rms_rad : kNaN;
}

void fill_devices(const StationReport& report, double now_s, ols_msg::station_status_t& message) {
  for (const device::DeviceReport& device : report.devices) {
    message.device_name.push_back(device.name);
    message.device_state.push_back(code(device.state));
    message.device_text.push_back(device.text);
    message.device_age_s.push_back(device.last_good_s ? now_s - *device.last_good_s : kNaN);
  }
  message.devices = static_cast<std::int16_t>(message.device_name.size());
  set_alarms(all_alarms(report), message);
}

void fill_numbers(const StationReport& report, ols_msg::station_status_t& message) {
  std::map<std::string, double> readings = report.readings;
  std::map<std::string, double> counters = report.counters;
  counters.insert(report.snapshot.counters.begin(), report.snapshot.counters.end());
  for (const device::DeviceReport& device : report.devices) {
    readings.insert(device.readings.begin(), device.readings.end());
    for (const auto& [name, value] : device.counters) {
      counters.emplace(name, static_cast<double>(value));
    }
  }
  for (const auto& [name, value] : readings) {
    message.reading_name.push_back(name);
    message.reading_value.push_back(value);
  }
  message.readings = static_cast<std::int16_t>(message.reading_name.size());
  for (const auto& [name, value] : counters) {
    message.counter_name.push_back(name);
    message.counter_value.push_back(value);
  }
  message.counters = static_cast<std::int16_t>(message.counter_name.size());
}

}  // namespace

std::int64_t Sender::utime_us(double monotonic_s) const {
  return std::llround(monotonic_s * 1e6) + utc_minus_monotonic_us;
}

double Sender::monotonic_s(std::int64_t utime_us) const {
  // Invalid stamps from outside must not overflow.
  return (static_cast<double>(utime_us) - static_cast<double>(utc_minus_monotonic_us)) * 1e-6;
}

namespace {

void fill_detected(const DetectedObject& object, ols_msg::bearing_t& message) {
  message.detected = object.is_tracklet ? 1 : 0;
  message.image_bearings = static_cast<std::int16_t>(object.image_bearings);
  for (int i = 0; i < 2; ++i) message.rate_rad_s[i] = object.rate_rad_s[i];
  symmetric(object.rate_covariance, message.rate_covariance_rad2_s2);
  message.size_rad = object.size_rad;
  message.size_sd_rad = object.size_sd_rad;
  message.across_rad = object.across_rad;
  message.size_noise_rad = object.size_noise_rad;
  message.signal = object.signal;
}

}  // namespace

ols_msg::bearing_t to_message(const Bearing& bearing, const Sender& sender,
                              const StationSettings& settings, std::int64_t sequence) {
  ols_msg::bearing_t message{};
  stamp(message, sender, sender.utime_us(bearing.mid_exposure_s), sequence);
  message.track_id = bearing.track_id;
  message.acquired = bearing.acquired ? 1 : 0;
  message.belief = bearing.belief;
  for (int i = 0; i < 3; ++i) {
    message.camera_ecef_m[i] = bearing.sight.origin_ecef[i];
    message.camera_position_sd_m[i] = bearing.sight.origin_sd_enu_m[i];
  }
  message.azimuth_rad = bearing.sight.direction.azimuth_rad;
  message.elevation_rad = bearing.sight.direction.elevation_rad;
  symmetric(bearing.sight.covariance_white, message.covariance_white_rad2);
  symmetric(bearing.sight.covariance_systematic, message.covariance_systematic_rad2);
  message.aim_sd_rad = bearing.sight.aim_sd_rad;
  message.calibration_id =
      calibration_id(settings.calibration_id, sender.boot_id, bearing.pose_revision);
  message.clock_state = code(sender.clock.state);
  message.stamp_source = bearing.stamp_source == camera::StampSource::kCamera
                             ? ols_msg::bearing_t::STAMP_CAMERA
                             : ols_msg::bearing_t::STAMP_ARRIVAL;
  // The error of the frame's stamp stays for many frames, as that of the clock does.
  message.clock_error_s = std::hypot(sender.clock.error_s, bearing.stamp_sd_s);
  if (bearing.detected) fill_detected(*bearing.detected, message);
  return message;
}

ols_msg::sighting_t to_message(const Sighting& sighting, const Sender& sender,
                               std::int64_t sequence) {
  ols_msg::sighting_t message;
  stamp(message, sender, sighting.utime_us, sequence);
  fill_sighting(sighting, message);
  message.clock_state = code(sender.clock.state);
  message.clock_error_s = sender.clock.error_s;
  return message;
}

ols_msg::skyline_t to_message(const skyline::SkylinePart& part, const Sender& sender, double now_s,
                              std::int64_t sequence) {
  ols_msg::skyline_t message{};
  stamp(message, sender, sender.utime_us(now_s), sequence);
  message.begun_utime = part.begun_us;
  for (int i = 0; i < 3; ++i) message.camera_ecef_m[i] = part.camera_ecef(i);
  message.heading_disagrees = part.heading_disagrees ? 1 : 0;
  message.sector = static_cast<std::int16_t>(part.sector);
  message.columns = static_cast<std::int16_t>(part.columns.size());
  for (const auto& [column, crest] : part.columns) {
    message.column.push_back(static_cast<std::int16_t>(column));
    message.elevation_rad.push_back(static_cast<float>(crest.elevation_rad));
    message.sd_rad.push_back(static_cast<float>(crest.sd_rad));
    message.hides_from_m.push_back(static_cast<float>(crest.hides_from_m));
    message.disagrees.push_back(crest.disagrees ? 1 : 0);
  }
  return message;
}

ols_msg::station_status_t to_message(const StationReport& report, const Sender& sender,
                                     const StationSettings& settings, double now_s,
                                     std::int64_t sequence) {
  const StationSnapshot& snapshot = report.snapshot;
  ols_msg::station_status_t message{};
  stamp(message, sender, sender.utime_us(now_s), sequence);
  message.state = code(snapshot.state);
  message.track_id = snapshot.track_id;
  message.belief = snapshot.belief;
  if (snapshot.hidden_since_s)
    message.hidden_since_utime = sender.utime_us(*snapshot.hidden_since_s);
  if (snapshot.hidden_until_s)
    message.hidden_until_utime = sender.utime_us(*snapshot.hidden_until_s);
  fill_pose(snapshot, settings.station.geometry, message);
  fill_lens(snapshot, message);
  fill_pointing(report, message);
  fill_borders(settings.station.geometry.chain, report, message);
  fill_calibration(report.calibration, message);
  fill_devices(report, now_s, message);
  message.clock_state = code(sender.clock.state);
  message.clock_error_s = sender.clock.error_s;
  message.frame_latency_s = snapshot.frame_latency_s;
  fill_numbers(report, message);
  message.last_error = report.last_error;
  message.last_error_utime = report.last_error_utime_us;
  return message;
}

ols_msg::preview_t to_message(const video::PreviewPicture& picture, const camera::Frame& frame,
                              const std::optional<cv::Rect2d>& box, const Sender& sender,
                              std::int64_t sequence) {
  ols_msg::preview_t message;
  stamp(message, sender, sender.utime_us(frame.mid_exposure_s), sequence);
  message.full_width_px = frame.gray.cols;
  message.full_height_px = frame.gray.rows;
  message.has_box = box.has_value();
  const cv::Rect2d shown = box.value_or(cv::Rect2d());
  message.box_px[0] = shown.x;
  message.box_px[1] = shown.y;
  message.box_px[2] = shown.width;
  message.box_px[3] = shown.height;
  message.scale = picture.scale;
  message.jpeg = picture.jpeg;
  message.jpeg_bytes = static_cast<std::int32_t>(picture.jpeg.size());
  return message;
}

ols_msg::frame_part_t to_message(const FramePart& part, const Sender& sender,
                                 std::int64_t sequence) {
  const RequestedFrame& of = part.frame->frame;
  ols_msg::frame_part_t message;
  stamp(message, sender, part.utime_us, sequence);
  message.request_boot_id = of.request.boot_id;
  message.request_sequence = of.request.sequence;
  message.utime_sd_s = of.frame.stamp_sd_s;
  message.clock_state = code(sender.clock.state);
  message.clock_error_s = sender.clock.error_s;
  message.pan_counts = of.counts.pan;
  message.tilt_counts = of.counts.tilt;
  message.pan_counts_s = of.counts.pan_s;
  message.tilt_counts_s = of.counts.tilt_s;
  message.approach_pan = static_cast<std::int8_t>(of.counts.approach.pan);
  message.approach_tilt = static_cast<std::int8_t>(of.counts.approach.tilt);
  message.pan_count_rad = of.counts.count.pan_rad;
  message.tilt_count_rad = of.counts.count.tilt_rad;
  message.width_px = of.frame.gray.cols;
  message.height_px = of.frame.gray.rows;
  message.encoding = of.request.lossless ? ols_msg::frame_request_t::ENCODING_PNG
                                         : ols_msg::frame_request_t::ENCODING_JPEG;
  message.part = static_cast<std::int16_t>(part.part);
  message.parts = static_cast<std::int16_t>(part.parts);
  const auto first = part.frame->file.begin() + static_cast<std::ptrdiff_t>(part.first_byte);
  message.data.assign(first, first + static_cast<std::ptrdiff_t>(part.bytes));
  message.bytes = static_cast<std::int32_t>(part.bytes);
  return message;
}

ols_msg::command_reply_t to_message(const Answer& answer, const Sender& sender, double now_s,
                                    std::int64_t sequence) {
  ols_msg::command_reply_t message;
  stamp(message, sender, sender.utime_us(now_s), sequence);
  message.order_boot_id = answer.command.boot_id;
  message.order_sequence = answer.command.sequence;
  message.accepted = answer.reason.empty() ? 1 : 0;
  message.reason = answer.reason;
  message.detail = answer.detail;
  message.state = code(answer.state);
  return message;
}

FrameRequest from_message(const ols_msg::frame_request_t& message, double now_s) {
  FrameRequest request;
  request.boot_id = message.boot_id;
  request.sequence = message.sequence;
  if (message.at_angles) request.at = PanTilt{message.pan_rad, message.tilt_rad};
  request.tolerance_rad = message.tolerance_rad;
  request.still_s = message.still_s;
  request.lossless = message.encoding != ols_msg::frame_request_t::ENCODING_JPEG;
  request.expires_s = now_s + message.lease_s;
  return request;
}

DesignateCommand from_message(const ols_msg::designate_t& message, const Sender& sender) {
  DesignateCommand command;
  command.box = {message.x_px, message.y_px, message.width_px, message.height_px};
  if (message.frame_utime != 0) command.frame_time_s = sender.monotonic_s(message.frame_utime);
  return command;
}

SlewCommand from_message(const ols_msg::slew_t& message, const Sender& sender, double now_s) {
  SlewCommand command;
  command.effect_s = sender.monotonic_s(message.effect_utime);
  command.received_s = now_s;
  command.lease_s = message.lease_s;
  command.sender = message.boot_id;
  command.target_id = message.target_id;
  command.direction = {message.azimuth_rad, message.elevation_rad};
  command.azimuth_rate_rad_s = message.azimuth_rate_rad_s;
  command.elevation_rate_rad_s = message.elevation_rate_rad_s;
  command.direction_sd_rad = message.direction_sd_rad;
  command.line = Eigen::Vector2d(message.line);
  command.let_go_track_id = message.let_go_track_id;
  return command;
}

OcclusionCommand from_message(const ols_msg::occlusion_t& message, const Sender& sender,
                              double now_s) {
  OcclusionCommand command;
  command.made_s = sender.monotonic_s(message.utime);
  command.received_s = now_s;
  command.holds_s = message.holds_s;
  command.sender = message.boot_id;
  command.target_id = message.target_id;
  if (message.exit_utime == 0) return command;
  const double* covariance = message.exit_covariance_rad2;
  command.exit = {sender.monotonic_s(message.exit_utime),
                  message.exit_sd_s,
                  {message.azimuth_rad, message.elevation_rad},
                  std::sqrt(0.5 * (covariance[0] + covariance[2]))};
  return command;
}

PointCommand from_message(const ols_msg::ptu_command_t& message) {
  return {{message.pan_rad, message.tilt_rad}};
}

CentreCommand centre_from_message(const ols_msg::ptu_command_t& message, const Sender& sender) {
  CentreCommand command;
  if (message.frame_utime != 0) command.frame_time_s = sender.monotonic_s(message.frame_utime);
  command.pixel = {message.x_px, message.y_px};
  return command;
}

RateCommand rate_from_message(const ols_msg::ptu_command_t& message, double now_s) {
  return {{message.pan_rate_rad_s, message.tilt_rate_rad_s},
          now_s,
          message.lease_s,
          message.boot_id,
          message.sequence};
}

std::optional<recorder::RecordCommand> from_message(const ols_msg::record_t& message,
                                                    const Sender& sender, double now_s) {
  constexpr double kMost_s = 3600.0;
  recorder::RecordCommand command;
  command.event_s = message.event_utime == 0 ? now_s : sender.monotonic_s(message.event_utime);
  command.before_s = message.before_s;
  command.after_s = message.after_s;
  command.label = message.label;
  const auto is_span = [](double s) { return s >= 0.0 && s <= kMost_s; };  // false for NaN
  if (!is_span(command.before_s) || !is_span(command.after_s)) return std::nullopt;
  if (!(std::abs(command.event_s - now_s) <= kMost_s)) return std::nullopt;
  return command;
}

}  // namespace ols::station
