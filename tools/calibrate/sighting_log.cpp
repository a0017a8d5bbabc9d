#include "tools/calibrate/sighting_log.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/bus/log_reader.h"
#include "edge/calibration/unit_count.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/sighting_t.hpp"
#include "tools/calibrate/input_bytes.h"

namespace ols::calibration {
namespace {

using Message = ols_msg::sighting_t;

bool is_approach(int sign) { return sign >= -1 && sign <= 1; }

bool is_possible(const Message& message) {
  constexpr double kMostCounts = 1e7, kMost_px = 1e5, kMostClock_s = 10.0;
  for (const double counts :
       {message.pan_counts, message.tilt_counts, message.pan_counts_s, message.tilt_counts_s}) {
    if (!(std::abs(counts) < kMostCounts)) return false;
  }
  for (const double px : {message.x_px, message.y_px}) {
    if (!(std::abs(px) < kMost_px)) return false;
  }
  for (const double variance : {message.covariance_px2[0], message.covariance_px2[2]}) {
    if (!(variance > 0.0 && variance < kMost_px)) return false;
  }
  return message.utime > 0 && message.designation_sd_px >= 0.0 &&
         message.designation_sd_px < kMost_px && message.clock_error_s >= 0.0 &&
         message.clock_error_s < kMostClock_s && is_approach(message.approach_pan) &&
         is_approach(message.approach_tilt);
}

void check_count(const Message& message, const StationModel& model) {
  if (station::is_count_of(model.pan, message.pan_count_rad) &&
      station::is_count_of(model.tilt, message.tilt_count_rad)) {
    return;
  }
  throw std::runtime_error("station '" + message.station +
                           "': its unit counts otherwise than its instrument says: state the "
                           "counts of a turn in the instrument ([unit])");
}

FollowedSighting sighting_of(const Message& message, std::size_t station) {
  FollowedSighting one;
  one.station = station;
  one.boot_id = message.boot_id;
  one.track_id = message.track_id;
  one.utime_us = message.utime;
  one.reading.pan = {message.pan_counts, message.pan_counts_s, message.approach_pan};
  one.reading.tilt = {message.tilt_counts, message.tilt_counts_s, message.approach_tilt};
  one.pixel = {message.x_px, message.y_px};
  const double white_px = std::sqrt(std::max(message.covariance_px2[0], message.covariance_px2[2]));
  one.sd_px = std::hypot(white_px, message.designation_sd_px);
  one.clock_sd_s = message.clock_error_s;
  return one;
}

class Reader {
 public:
  Reader(double least_belief, const std::vector<std::string>& names,
         const std::vector<StationPrior>& stations)
      : least_belief_(least_belief), names_(names), stations_(stations) {}

  // False if the message is damaged or of another version.
  bool take(const BusMessage& received) {
    if (!received.channel.starts_with(kSightingChannel)) return true;
    Message message{};
    if (!decode_of_schema(received, message) ||
        received.channel != station_channel(kSightingChannel, message.station) ||
        !is_possible(message)) {
      ++log.unusable;
      return false;
    }
    const auto found = std::ranges::find(names_, message.station);
    if (found == names_.end()) {
      ++log.of_others;
      return true;
    }
    const auto station = static_cast<std::size_t>(found - names_.begin());
    check_count(message, stations_[station].model);
    if (message.clock_state != ols_msg::bearing_t::CLOCK_SYNCHRONISED) {
      ++log.unsynchronised;
    } else if (!(message.belief >= least_belief_)) {
      ++log.disbelieved;
    } else {
      log.sightings.push_back(sighting_of(message, station));
    }
    return true;
  }

  SightingLog log;

 private:
  double least_belief_;
  const std::vector<std::string>& names_;
  const std::vector<StationPrior>& stations_;
};

}  // namespace

SightingLog read_sightings(const SightingLogOptions& options, const std::vector<std::string>& names,
                           const std::vector<StationPrior>& stations, const TellSteps& tell) {
  Reader reader(options.least_belief, names, stations);
  const std::size_t all = input_bytes(options.recordings);
  std::size_t before = 0;  // in the recordings that are read
  for (const std::string& path : options.recordings) {
    try {
      LogReader log(path, LogTimes::kAsRecorded);
      while (const auto message = log.next()) {
        if (!reader.take(*message)) log.reject(*message);
        if (tell) tell(before + log.offset(), all);
      }
      before += log.size();
      if (!log.damage().empty()) reader.log.damage.push_back(path + ": " + log.damage());
    } catch (const std::exception& error) {
      const std::string text = error.what();
      throw std::runtime_error(text.find(path) == std::string::npos ? path + ": " + text : text);
    }
  }
  return std::move(reader.log);
}

}  // namespace ols::calibration
