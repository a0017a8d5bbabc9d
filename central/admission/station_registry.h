// The stations that the fusion knows. Decides which stations belong to the site, and which one is
// replaced when there are too many. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/calibration_monitor.h"
#include "central/admission/message_time.h"
#include "central/admission/recent_exposures.h"
#include "central/measurement/activity.h"

namespace ols::fusion {

// The properties of a station that the fusion needs to slew it.
struct StationTraits {
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d camera_sd_enu_m = Eigen::Vector3d::Zero();
  double latency_s = 0.05;                 // from mid-exposure to the bearing's arrival
  double field_of_view_rad = 0.05;         // the narrower of width and height
  std::optional<AzimuthElevation> axis{};  // of the optical axis, as last reported
  bool commandable = true;                 // not stopped, and not under operator control
  StatedCalibration calibration{};
  // Maker, model and serial number of its mount; empty if the mount states no usable serial number.
  std::string mount{};
  std::int64_t stated_us = 0;  // when the station stated this
};

struct KnownStation {
  StationTraits traits;
  RecentExposures exposures;
  std::int64_t bearings = 0;  // number of admitted bearings
  bool delivered = false;     // the station has sent a bearing, even if it was refused
  std::int64_t heard = 0;     // its last message's number, counted over all stations
  std::int64_t calibration_id = 0;
  std::int64_t boot_id = 0;
  int untimely = 0;  // number of consecutive bearings that were too old or from the future
  std::int64_t target_id = 0;  // the last target that the station saw
  Activity saw_target;

  void set_position(const LineOfSight& sight) {
    traits.camera_ecef = sight.origin_ecef;
    traits.camera_sd_enu_m = sight.origin_sd_enu_m;
  }
  // The target that the station has seen within the last kFollowsS; 0 if there is none.
  std::int64_t follows(std::int64_t now_us) const {
    return saw_target.age_s(now_us) < Activity::kFollowsS ? target_id : 0;
  }
};

class StationRegistry {
 public:
  // names: the stations of the site; if empty, all stations belong to it. most: the largest number
  // of stations. When it is reached, a new station replaces another one: if possible, a station
  // that has sent no bearing; otherwise, a station that has sent fewer than 10, or has been silent
  // for more than 10 s. Of several such stations, the one that has been silent longest is replaced.
  // If there is no such station, the new station is not admitted.
  StationRegistry(const std::vector<std::string>& names, int most) : names_(names), most_(most) {}

  bool belongs(const std::string& station) const;
  struct Place {
    KnownStation* station = nullptr;       // null if there are too many stations
    std::optional<std::string> evicted{};  // the station that was replaced
  };
  // Finds or adds a station that sends a bearing.
  Place for_bearing(const std::string& station, const MessageTime& time);
  // Finds or adds a station known only by its status.
  Place for_status(const std::string& station, const MessageTime& time);
  std::map<std::string, KnownStation>& all() { return stations_; }
  const std::map<std::string, KnownStation>& all() const { return stations_; }

 private:
  using Entry = std::map<std::string, KnownStation>::iterator;
  bool full(const std::string& station) const;
  Entry longest_silent(const MessageTime& time);
  Place take(const std::string& station, std::optional<Entry> evicted);

  std::vector<std::string> names_;
  int most_;
  std::map<std::string, KnownStation> stations_;
  std::int64_t messages_ = 0;
};

}  // namespace ols::fusion
