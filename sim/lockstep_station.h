// One station in simulated time: the product's Station and PTU driver, joined to a simulated unit
// by bytes and to a simulated camera by frames.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "edge/ptu/driver.h"
#include "edge/station.h"
#include "edge/tracker/tracker_config.h"
#include "sim/ptu_unit.h"
#include "sim/renderer.h"
#include "sim/view_tracker.h"
#include "sim/world.h"

namespace ols::sim {

// What the operator marks at one station in place of the first target.
struct Misdesignation {
  std::string station;
  std::size_t target = 0;                            // of the scenario; its box,
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();  // beside it by this,
  double scale = 1.0;                                // and so many times as large
};

struct Fidelity {
  bool pictures = true;  // false: the pixel is the truth with noise of this deviation
  double pixel_sd_px = 0.3;
  std::vector<std::string> not_designated = {};  // stations that the operator leaves alone
  std::vector<Misdesignation> misdesignated = {};
};

// One frame after the designation, or of a station that is left alone: what the station made of it,
// beside the truth.
struct FrameNote {
  double mid_s = 0.0;  // true time since the scenario's start
  StationState state = StationState::kIdle;
  double belief = 0.0;
  ViewTruth view;
  bool inside_third = false;                // the target is inside the central third, both ways
  std::optional<Eigen::Vector2d> error_px;  // of the pixel measured, while tracking
  std::optional<cv::Rect2d> box;            // [px] as the tracker has it
  std::vector<std::string> alarms;          // of the station's own decisions
};

struct StationRecord {
  std::vector<FrameNote> frames;
  int frames_lost = 0;
  std::map<std::string, double> counters;  // of the station and its PTU driver at the end
};

class LockstepStation {
 public:
  // `renderer` is null without pictures; `world` must outlive the station.
  LockstepStation(const World& world, std::size_t index, const Fidelity& fidelity,
                  std::unique_ptr<Renderer> renderer);

  // Goes on to this instant of true time (by a millisecond or so); returns the bearings made.
  std::vector<Bearing> advance(double time_s);

  Refusal slew(SlewCommand command, double time_s);
  // The station's monotonic clock at an instant of true time.
  static double monotonic_s(double time_s);

  const Station& station() const { return station_; }
  StationRecord record() const;
  const PtuCounters& ptu_counters() const { return driver_.counters(); }
  bool designated() const { return designated_; }
  bool left_alone() const { return left_alone_; }

 private:
  struct Seen {  // by the operator
    double stamp_s = 0.0;
    ExposureTruth exposure;
    ViewTruth view;
  };
  void exchange_bytes(double time_s);
  void expose(double time_s);
  void take_note(double mid_s, const ViewTruth& view);
  void operate(double time_s);
  void point_roughly(double time_s);
  void designate_seen(double time_s);
  std::optional<cv::Rect2d> marked(const Seen& seen) const;
  bool stands_since(double from_s, double time_s) const;

  const World& world_;
  std::size_t index_;
  Fidelity fidelity_;
  std::unique_ptr<Renderer> renderer_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
  PtuUnit unit_;
  PtuDriver driver_;
  ViewMemory views_;
  StationConfig config_;
  Station station_;
  StationRecord record_;
  double phase_s_;  // of the exposures
  std::int64_t next_frame_ = 0;

  // The operator.
  std::deque<Seen> seen_;
  PanTilt aiming_error_;
  double ready_s_ = -1.0, pointed_s_ = -1.0;
  bool designated_ = false;
  bool left_alone_ = false;
};

}  // namespace ols::sim
