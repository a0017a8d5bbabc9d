#include "tools/calibrate/bearing_log.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/bus/log_reader.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "tools/calibrate/sighting_log.h"

namespace ols::calibration {
namespace {

using Message = ols_msg::bearing_t;

bool is_possible(const Message& m) {
  constexpr double kMost_rad2 = 1.0, kMostClock_s = 100.0, kLeastRadius_m = 6e6, kMost_m = 7e6;
  const double radius_m = Eigen::Vector3d::Map(m.camera_ecef_m).norm();
  for (const double variance : {m.covariance_white_rad2[0], m.covariance_white_rad2[2]}) {
    if (!(variance > 0.0 && variance < kMost_rad2)) return false;
  }
  for (const double variance :
       {m.covariance_systematic_rad2[0], m.covariance_systematic_rad2[2], m.camera_position_sd_m[0],
        m.camera_position_sd_m[1], m.camera_position_sd_m[2]}) {
    if (!(variance >= 0.0 && std::isfinite(variance))) return false;
  }
  return m.utime > 0 && radius_m > kLeastRadius_m && radius_m < kMost_m &&
         std::isfinite(m.azimuth_rad) && std::abs(m.elevation_rad) < 1.6 &&
         m.clock_error_s >= 0.0 && m.clock_error_s < kMostClock_s;
}

class Reader {
 public:
  // False if the message is damaged or of another version.
  bool take(const BusMessage& received) {
    if (!received.channel.starts_with(kBearingChannel)) return true;
    Message message{};
    if (!decode_of_schema(received, message) ||
        received.channel != station_channel(kBearingChannel, message.station) ||
        !is_possible(message)) {
      ++log.unusable;
      return false;
    }
    if (message.clock_state != Message::CLOCK_SYNCHRONISED) {
      ++log.unsynchronised;
    } else if (!(message.belief >= SightingLogOptions{}.least_belief)) {
      ++log.disbelieved;
    } else if (is_new(message)) {
      add(message);
    }
    return true;
  }

  // Makes means of the sums of squares.
  void end() {
    for (std::size_t i = 0; i < log.errors.size(); ++i) {
      LastingErrors& sums = log.errors[i];
      const auto count =
          static_cast<double>(std::ranges::count(log.bearings, i, &TimedBearing::station));
      for (double* sum :
           {&sums.clock_sd_s, &sums.heading_sd_rad, &sums.tilt_sd_rad, &sums.position_sd_m})
        *sum = std::sqrt(*sum / count);
    }
  }

  BearingLog log;

 private:
  std::size_t index_of(const std::string& station) {
    const auto found = std::ranges::find(log.stations, station);
    if (found != log.stations.end()) return static_cast<std::size_t>(found - log.stations.begin());
    log.stations.push_back(station);
    log.errors.emplace_back();
    log.by_arrival.push_back(0);
    return log.stations.size() - 1;
  }

  // False if an overlapping recording has contained it.
  bool is_new(const Message& m) {
    return known_.emplace(m.station, m.utime, m.boot_id, m.track_id).second;
  }

  void add(const Message& m) {
    const Eigen::Vector3d camera = Eigen::Vector3d::Map(m.camera_ecef_m);
    if (!frame_) {
      frame_.emplace(geodetic_from_ecef(camera));
      origin_us_ = m.utime / 1'000'000 * 1'000'000;
    }
    TimedBearing one;
    one.station = index_of(m.station);
    one.boot_id = m.boot_id;
    one.track_id = m.track_id;
    one.time_s = 1e-6 * static_cast<double>(m.utime - origin_us_);
    one.camera_m = frame_->to_enu(camera);
    one.direction = frame_->R_ecef_enu().transpose() * R_ecef_enu(camera) *
                    enu_from_azimuth_elevation({m.azimuth_rad, m.elevation_rad});
    one.sd_rad = std::sqrt(std::max(m.covariance_white_rad2[0], m.covariance_white_rad2[2]));
    LastingErrors& sums = log.errors[one.station];
    sums.clock_sd_s += m.clock_error_s * m.clock_error_s;
    // Across the line of sight, an error of the heading is shorter by the cosine of the elevation.
    const double level = std::max(std::cos(m.elevation_rad), 0.1);
    sums.heading_sd_rad += m.covariance_systematic_rad2[0] / (level * level);
    sums.tilt_sd_rad += m.covariance_systematic_rad2[2];
    const double position_m = *std::ranges::max_element(m.camera_position_sd_m);
    sums.position_sd_m += position_m * position_m;
    log.by_arrival[one.station] += m.stamp_source == Message::STAMP_ARRIVAL ? 1 : 0;
    log.bearings.push_back(one);
  }

  std::set<std::tuple<std::string, std::int64_t, std::int64_t, std::int64_t>> known_;
  std::optional<LocalFrame> frame_;
  std::int64_t origin_us_ = 0;
};

}  // namespace

BearingLog read_bearings(const std::vector<std::string>& recordings) {
  Reader reader;
  for (const std::string& path : recordings) {
    LogReader log(path, LogTimes::kAsRecorded);
    while (const auto message = log.next()) {
      if (!reader.take(*message)) log.reject(*message);
    }
    if (!log.damage().empty()) reader.log.damage.push_back(path + ": " + log.damage());
  }
  reader.end();
  return std::move(reader.log);
}

}  // namespace ols::calibration
