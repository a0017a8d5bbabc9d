#include "edge/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"

namespace ols {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kDatagram_bytes = 60000;  // with room for the header, below 65 000

void symmetric(const Eigen::Matrix2d& matrix, double (&out)[3]) {
  out[0] = matrix(0, 0);
  out[1] = matrix(0, 1);
  out[2] = matrix(1, 1);
}

// The station's UTC is as good as the configuration says; its quality is not measured yet.
constexpr std::int8_t kClockState = ols_msg::bearing_t::CLOCK_UNKNOWN;

void fill_pose(const StationSettings& settings, ols_msg::station_status_t& message) {
  const StationGeometry& geometry = settings.station.geometry;
  message.latitude_deg = degrees(geometry.position.latitude_rad);
  message.longitude_deg = degrees(geometry.position.longitude_rad);
  message.height_m = geometry.position.height_m;
  for (double& sd : message.position_sd_m) sd = geometry.sd.position_m;
  message.heading_rad = geometry.chain.heading_rad;
  message.tilt_x_rad = geometry.chain.tilt_x_rad;
  message.tilt_y_rad = geometry.chain.tilt_y_rad;
  message.heading_sd_rad = geometry.sd.heading_rad;
  message.tilt_sd_rad = geometry.sd.tilt_rad;
  message.position_source = ols_msg::station_status_t::POSE_SURVEYED;
  message.tilt_source = ols_msg::station_status_t::POSE_SURVEYED;
  const Eigen::Vector2d field = field_of_view(geometry.camera);
  message.field_of_view_rad[0] = field.x();
  message.field_of_view_rad[1] = field.y();
  message.image_width_px = geometry.camera.width_px;
  message.image_height_px = geometry.camera.height_px;
}

void fill_pointing(const StationSnapshot& snapshot, const PtuLimits& limits, bool limits_known,
                   ols_msg::station_status_t& message) {
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

std::int8_t state_code(StationState state) {
  using M = ols_msg::station_status_t;
  switch (state) {
    case StationState::kIdle:
      return M::STATE_IDLE;
    case StationState::kManual:
      return M::STATE_MANUAL;
    case StationState::kTracking:
      return M::STATE_TRACKING;
    case StationState::kCoasting:
      return M::STATE_COASTING;
    case StationState::kLost:
      return M::STATE_LOST;
    case StationState::kSlewed:
      return M::STATE_SLEWED;
    case StationState::kStopped:
      return M::STATE_STOPPED;
    case StationState::kEmergency:
      return M::STATE_EMERGENCY;
  }
  return M::STATE_IDLE;
}

std::int8_t device_code(DeviceState state) {
  using M = ols_msg::station_status_t;
  switch (state) {
    case DeviceState::kAbsent:
      return M::DEVICE_ABSENT;
    case DeviceState::kStarting:
      return M::DEVICE_STARTING;
    case DeviceState::kOk:
      return M::DEVICE_OK;
    case DeviceState::kFault:
      return M::DEVICE_FAULT;
  }
  return M::DEVICE_FAULT;
}

void fill_devices(const std::vector<DeviceReport>& devices, double now_s,
                  ols_msg::station_status_t& message) {
  for (const DeviceReport& device : devices) {
    message.device_name.push_back(device.name);
    message.device_state.push_back(device_code(device.state));
    message.device_text.push_back(device.text);
    message.device_age_s.push_back(device.last_good_s ? now_s - *device.last_good_s : kNaN);
    message.alarm.insert(message.alarm.end(), device.alarms.begin(), device.alarms.end());
    for (const auto& [name, value] : device.readings) {
      message.reading_name.push_back(name);
      message.reading_value.push_back(value);
    }
  }
  message.devices = static_cast<std::int16_t>(message.device_name.size());
  message.alarms = static_cast<std::int16_t>(message.alarm.size());
  message.readings = static_cast<std::int16_t>(message.reading_name.size());
}

}  // namespace

DeviceState device_state(CameraState state) {
  switch (state) {
    case CameraState::kAbsent:
      return DeviceState::kAbsent;
    case CameraState::kStarting:
      return DeviceState::kStarting;
    case CameraState::kStreaming:
      return DeviceState::kOk;
    case CameraState::kFault:
      return DeviceState::kFault;
  }
  return DeviceState::kFault;
}

DeviceState device_state(const PtuStatus& status) {
  if (!status.port_open) return DeviceState::kAbsent;
  switch (status.state) {
    case PtuState::kStarting:
      return DeviceState::kStarting;
    case PtuState::kReady:
      return DeviceState::kOk;
    case PtuState::kFault:
      return DeviceState::kFault;
  }
  return DeviceState::kFault;
}

std::int64_t Sender::utime_us(double monotonic_s) const {
  return std::llround(monotonic_s * 1e6) + utc_minus_monotonic_us;
}

double Sender::monotonic_s(std::int64_t utime_us) const {
  // Absurd stamps from outside must not overflow.
  return (static_cast<double>(utime_us) - static_cast<double>(utc_minus_monotonic_us)) * 1e-6;
}

ols_msg::bearing_t to_message(const Bearing& bearing, const Sender& sender,
                              const StationSettings& settings, std::int64_t sequence) {
  ols_msg::bearing_t message;
  message.utime = sender.utime_us(bearing.mid_exposure_s);
  message.schema_version = ols_msg::bearing_t::SCHEMA_VERSION;
  message.station = sender.station;
  message.boot_id = sender.boot_id;
  message.sequence = sequence;
  message.track_id = bearing.track_id;
  message.belief = bearing.belief;
  for (int i = 0; i < 3; ++i) {
    message.camera_ecef_m[i] = bearing.sight.origin_ecef[i];
    message.camera_position_sd_m[i] = bearing.sight.origin_sd_enu_m[i];
  }
  message.azimuth_rad = bearing.sight.direction.azimuth_rad;
  message.elevation_rad = bearing.sight.direction.elevation_rad;
  symmetric(bearing.sight.covariance_white, message.covariance_white_rad2);
  symmetric(bearing.sight.covariance_systematic, message.covariance_systematic_rad2);
  message.calibration_id = settings.calibration_id;
  message.clock_state = kClockState;
  message.stamp_source = bearing.stamp_source == StampSource::kCamera
                             ? ols_msg::bearing_t::STAMP_CAMERA
                             : ols_msg::bearing_t::STAMP_ARRIVAL;
  message.clock_error_s = settings.clock_sd_s;
  return message;
}

ols_msg::station_status_t to_message(const StationSnapshot& snapshot, const Sender& sender,
                                     const StationSettings& settings, const PtuLimits& limits,
                                     const std::vector<DeviceReport>& devices, double now_s,
                                     std::int64_t sequence) {
  ols_msg::station_status_t message;
  message.utime = sender.utime_us(now_s);
  message.schema_version = ols_msg::station_status_t::SCHEMA_VERSION;
  message.station = sender.station;
  message.boot_id = sender.boot_id;
  message.sequence = sequence;
  message.state = state_code(snapshot.state);
  message.track_id = snapshot.track_id;
  message.belief = snapshot.belief;
  fill_pose(settings, message);
  const bool limits_known = std::any_of(devices.begin(), devices.end(), [](const auto& device) {
    return device.name == "ptu" && device.state == DeviceState::kOk;
  });
  fill_pointing(snapshot, limits, limits_known, message);
  fill_devices(devices, now_s, message);
  message.clock_state = kClockState;
  message.clock_error_s = settings.clock_sd_s;
  message.frame_latency_s = snapshot.frame_latency_s;
  for (const auto& [name, value] : snapshot.counters) {
    message.counter_name.push_back(name);
    message.counter_value.push_back(value);
  }
  message.counters = static_cast<std::int16_t>(message.counter_name.size());
  return message;
}

std::optional<ols_msg::preview_t> to_preview(const Frame& frame,
                                             const std::optional<cv::Rect2d>& box,
                                             const Sender& sender, std::int64_t sequence) {
  ols_msg::preview_t message;
  message.utime = sender.utime_us(frame.mid_exposure_s);
  message.schema_version = ols_msg::preview_t::SCHEMA_VERSION;
  message.station = sender.station;
  message.boot_id = sender.boot_id;
  message.sequence = sequence;
  message.full_width_px = frame.gray.cols;
  message.full_height_px = frame.gray.rows;
  message.has_box = box.has_value();
  const cv::Rect2d shown = box.value_or(cv::Rect2d());
  message.box_px[0] = shown.x;
  message.box_px[1] = shown.y;
  message.box_px[2] = shown.width;
  message.box_px[3] = shown.height;
  for (const double width_px : {480.0, 320.0, 160.0}) {
    message.scale = std::min(1.0, width_px / frame.gray.cols);
    cv::Mat small;
    cv::resize(frame.gray, small, {}, message.scale, message.scale, cv::INTER_AREA);
    cv::imencode(".jpg", small, message.jpeg, {cv::IMWRITE_JPEG_QUALITY, 70});
    message.jpeg_bytes = static_cast<std::int32_t>(message.jpeg.size());
    if (message.jpeg.size() < kDatagram_bytes) return message;
  }
  return std::nullopt;
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
  command.target_id = message.target_id;
  command.direction = {message.azimuth_rad, message.elevation_rad};
  command.azimuth_rate_rad_s = message.azimuth_rate_rad_s;
  command.elevation_rate_rad_s = message.elevation_rate_rad_s;
  command.direction_sd_rad = message.direction_sd_rad;
  return command;
}

PointCommand from_message(const ols_msg::ptu_command_t& message) {
  return {{message.pan_rad, message.tilt_rad}};
}

}  // namespace ols
