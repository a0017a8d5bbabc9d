// The stations that the fusion knows: who belongs to the site, and who gives way to another one
// where there are too many. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/message_time.h"
#include "central/admission/recent_exposures.h"
#include "central/measurement/activity.h"

namespace ols::fusion {

// What is known of a station that can be slewed.
struct StationTraits {
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d camera_sd_enu_m = Eigen::Vector3d::Zero();
  double latency_s = 0.05;          // mid-exposure to bearing
  double field_of_view_rad = 0.05;  // the narrower one
  bool commandable = true;          // no operator has it, and it is not stopped
};

struct KnownStation {
  StationTraits traits;
  RecentExposures exposures;
  std::int64_t bearings = 0;  // taken
  bool delivered = false;     // a bearing, if only one that was refused
  std::int64_t heard = 0;     // number of its last message among all
  std::int64_t calibration_id = 0;
  std::int64_t boot_id = 0;
  std::int64_t target_id = 0;  // the target that it saw last
  Activity saw_target;

  void set_position(const LineOfSight& sight) {
    traits.camera_ecef = sight.origin_ecef;
    traits.camera_sd_enu_m = sight.origin_sd_enu_m;
  }
  // A target that it follows, or did a moment ago; 0: none.
  std::int64_t follows(std::int64_t now_us) const {
    return saw_target.age_s(now_us) < Activity::kFollowsS ? target_id : 0;
  }
};

class StationRegistry {
 public:
  // names: nobody else belongs to the site; empty: anybody does. most: one more takes the place of
  // the one that is silent longest; never of one that has delivered and still does.
  StationRegistry(const std::vector<std::string>& names, int most) : names_(names), most_(most) {}

  bool belongs(const std::string& station) const;
  struct Place {
    KnownStation* station = nullptr;       // none: there are too many
    std::optional<std::string> evicted{};  // who gave way to it
  };
  // For a station that sends a bearing.
  Place for_bearing(const std::string& station, const MessageTime& time);
  // For one of which only a status is known.
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
