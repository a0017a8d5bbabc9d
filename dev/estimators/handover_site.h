// A site that hands targets over, in simulated time and without pictures. A fixed overview station
// sees the whole sky; the other stations turn to where the fusion leads them. Their detectors
// report a target after it has been in view for a while. The same seed gives the same run.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "central/fusion/fusion.h"

namespace ols::bench {

struct FlyingTarget {
  Eigen::Vector3d p_enu = Eigen::Vector3d::Zero();  // [m] at the time when it appears
  Eigen::Vector3d v_enu = Eigen::Vector3d::Zero();
  double appears_s = 0.0;
};

struct HandoverSiteConfig {
  // Positions [m] of the stations that turn. At first, all point upwards to the north.
  std::vector<Eigen::Vector3d> stations_enu;
  std::optional<Eigen::Vector3d> overview_enu{};
  bool stations_turn = true;  // false: they, too, are fixed and see the whole sky
  // True: after acquisition, the tracker of a led station follows the target.
  bool stations_track = false;
  std::vector<FlyingTarget> targets;
  double view_rad = 0.08;  // field of view of the stations that turn
  double rate_hz = 15.0;
  double noise_rad = 3e-4;
  double confirm_s = 0.2;  // time in view until a led station acquires the target
  double delay_s = 0.1;    // delay from the exposure to the fusion
  double slew_s = 0.05;    // delay from the fusion to the servo
  fusion::HandoverConfig handover{};
};

class HandoverSite {
 public:
  HandoverSite(const HandoverSiteConfig& config, std::uint64_t seed);

  void run_until(double time_s);
  fusion::Fusion& fusion() { return fusion_; }
  // Restarts all stations: they still see the same targets, but number them from 1 again.
  void restart_stations();
  // The stations, without the overview station, whose detectors report the target now.
  std::vector<std::string> holders(std::size_t target) const;
  // The id of the confirmed or coasting track that the fusion now has at this simulated target; 0:
  // there is none.
  std::int64_t found(std::size_t target) const;
  // How long the station that points farthest away from the target takes to turn to it.
  double farthest_turn_s(std::size_t target) const;
  // When the overview station first reported this target.
  std::optional<double> first_seen_s(std::size_t target) const;

 private:
  struct Station {
    std::string name;
    Eigen::Vector3d p_ecef;
    bool sees_all = false;
    AzimuthElevation axis;
    double speed_rad_s = 0.0;
    std::optional<fusion::Slew> slew{};
    std::optional<std::size_t> follows{};       // the target that its tracker follows
    std::map<std::size_t, double> in_view_s{};  // by target: since when it has been in view
    // By target: its track_id, if the detector reports it.
    std::map<std::size_t, std::int64_t> track_ids{};
  };
  struct Sent {
    double at_s = 0.0;
    fusion::BearingMeasurement bearing;
  };
  Eigen::Vector3d place(std::size_t target, double time_s) const;
  bool is_there(std::size_t target, double time_s) const;
  void turn(Station& station);
  void acquire(Station& station);
  void look(Station& station);
  fusion::BearingMeasurement measured(const Station& station, std::size_t target,
                                      const AzimuthElevation& there);
  void deliver();
  std::int64_t utime_us(double time_s) const;

  HandoverSiteConfig config_;
  std::mt19937_64 random_;
  fusion::Fusion fusion_;
  std::vector<Station> stations_;
  std::vector<Sent> sent_;
  std::vector<std::pair<double, fusion::Slew>> slews_;
  std::map<std::size_t, double> first_seen_s_;
  std::int64_t next_track_id_ = 1, boots_ = 1;
  std::int64_t tick_ = 0;
};

}  // namespace ols::bench
