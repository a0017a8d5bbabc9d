// Notes where each station loses targets that it should see, and where it finds them again
// (central/ground/lost_places.h). Pure.
//
// A loss is judged when the station sees the same target again: that proves that the station was
// working and pointed at the target. In the meantime, other stations must have seen the target. A
// loss that known land explains is not counted, even if the land hides only a part of the way.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "central/ground/lost_places.h"
#include "central/tracking/track.h"

namespace ols::fusion {

class LossWatch {
 public:
  // The probability that no known land hides a position [m] with this covariance [m^2] from a
  // station; ECEF.
  using Visible =
      std::function<double(const std::string& station, const Eigen::Vector3d& camera_ecef,
                           const Eigen::Vector3d& p_ecef, const Eigen::Matrix3d& P)>;

  // Takes a bearing that a confirmed track has used.
  void note(const BearingMeasurement& measurement, const Track& track, const Visible& visible);
  // Null if nothing was lost from this camera position.
  const LostPlaces* of(const std::string& station, const Eigen::Vector3d& camera_ecef) const;
  // The probability that what nobody knows of hides a position from a station.
  double hidden(const std::string& station, const Eigen::Vector3d& camera_ecef,
                const Eigen::Vector3d& p_ecef) const;
  std::vector<std::pair<std::string, LostPlace>> places() const;  // of each station
  void keep_only(const std::vector<Track>& tracks);
  void forget(const std::string& station);
  void clear() { *this = {}; }

 private:
  struct Moment {
    std::int64_t utime_us = 0;
    Eigen::Vector3d p_ecef;
    Eigen::Matrix3d covariance_ecef;
  };
  struct Sight {  // of a target by a station
    std::int64_t utime_us = 0;
    LostPlaces::Cell cell;
    bool left_for_another = false;
  };
  struct Trail {
    std::deque<Moment> moments;  // of the last seconds
    std::map<std::string, Sight> by_station;
  };
  struct Station {
    Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
    LostPlaces places;
  };
  Station& station_of(const BearingMeasurement& measurement);
  static void judge_loss(const Trail& trail, const Sight& before, const Sight& after,
                         const std::string& name, Station& station, const Visible& visible);
  void note_attention(const BearingMeasurement& measurement, std::int64_t track_id);

  std::map<std::int64_t, Trail> trails_;  // by track
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
