// The whole site in simulated time, in one process and without sockets: the product's stations and
// fusion, stepped in a fixed order. The same scenario and seed give the same result to the last
// bit.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "central/fusion/fusion.h"
#include "conditions/alarm.h"
#include "sim/lockstep/lockstep_station.h"
#include "sim/network/network.h"
#include "sim/world/world.h"

namespace ols::sim {

// One published position, and its error from the scenario's first target, in the site's east,
// north, up.
struct Fix {
  std::int64_t utime_us = 0;
  std::int64_t target_id = 0;
  double time_s = 0.0;       // of the epoch, since the scenario's start
  double published_s = 0.0;  // of the publication, likewise
  Geodetic position;
  Eigen::Vector3d error_enu_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_enu_m2 = Eigen::Matrix3d::Zero();
  std::vector<std::size_t> used;  // stations
};

struct ToldSighting {
  std::size_t station = 0;
  station::Sighting sighting;
};

struct LockstepResult {
  std::vector<Fix> joint, paper;
  std::vector<fusion::Slew> slews;  // as the fusion made them
  std::vector<fusion::OcclusionNotice> occlusions;
  std::vector<ToldSighting> sightings;
  std::vector<StationRecord> stations;
  std::map<std::string, double> counters;  // of the fusion at the end
  std::vector<Alarm> alarms;               // of the fusion at the end
  // When the last station got its designation; < 0: some station got none.
  double designated_s = -1.0;
};

class Lockstep {
 public:
  // `world` must outlive this object. `calibrations`: by station; empty: all stations use the
  // geometry of their configuration.
  Lockstep(const World& world, const Fidelity& fidelity,
           const std::vector<std::optional<StationCalibration>>& calibrations = {});

  void run(double duration_s);
  // The station of this name, which must exist.
  LockstepStation& station(const std::string& id) { return *stations_.at(index_of(id)); }
  // Passes a cue from outside to the fusion. allow_cue(): the operator allows the cue.
  void hear(const fusion::Cue& cue, double time_s);
  bool allow_cue(const std::string& id) { return fusion_.allow_cue(id, true); }
  const fusion::Fusion& fusion() const { return fusion_; }
  // Called with every target that the fusion publishes. `time_s`: of the scenario.
  using Listener = std::function<void(const fusion::FusedTarget&, double time_s)>;
  void listen(Listener listener) { listener_ = std::move(listener); }
  LockstepResult result() const;

  // UTC of the scenario's start.
  static constexpr std::int64_t kStartUtime_us = 1'700'000'000'000'000;

 private:
  struct AddressedSlew {
    std::size_t station = 0;
    fusion::Slew slew;
  };
  void advance(double time_s);
  void know_station(std::size_t index);
  void send(std::size_t station, const station::Bearing& bearing, double time_s);
  void fuse(const fusion::BearingMeasurement& measurement, double time_s);
  void send(const std::vector<fusion::Slew>& slews, double time_s);
  void record(const fusion::FusedTarget& target, double time_s, std::vector<Fix>& fixes) const;
  void deliver(const AddressedSlew& addressed, double time_s);
  void deliver(const fusion::OcclusionNotice& notice, double time_s);
  std::size_t index_of(const std::string& station) const;

  const World& world_;
  std::vector<std::unique_ptr<LockstepStation>> stations_;
  Network<fusion::BearingMeasurement> bearings_;
  Network<AddressedSlew> slews_;
  Network<fusion::OcclusionNotice> occlusions_;
  std::vector<std::int64_t> newest_slew_us_;
  fusion::Fusion fusion_;
  LockstepResult result_;
  Listener listener_;
  std::int64_t tick_ = 0;
};

}  // namespace ols::sim
