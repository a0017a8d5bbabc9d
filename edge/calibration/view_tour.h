// Plans the rounds over a station's reference views: fixed directions of which pictures were stored
// after the calibration. While the station is free, the unit goes from view to view, and stops at
// each until a picture is taken. It approaches each view from the same side in every round. Pure.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "edge/mount/goal.h"
#include "edge/mount/limits.h"

namespace ols::station {

class ViewTour {
 public:
  struct Config {
    // Time for which the station must be free between two checks; if infinite, checks are made only
    // on request.
    double interval_s = std::numeric_limits<double>::infinity();
    double settle_s = 1.0;  // time at rest before mid-exposure
    double leg_s = 40.0;    // if a view is not reached within this time, the round ends
    // Whether the sun is now too near to the direction of these reported angles. A round leaves out
    // such a view, and another round follows when the view is possible again. If the function is
    // empty, all views are possible.
    std::function<bool(const PanTilt&)> forbidden;
  };
  struct Situation {
    double now_s = 0.0;
    // The station is free: there is no target, operator, slew or stop, and the reference is
    // trusted. When it is no longer free, the round ends at once. A new round begins when the
    // station has been free again for 20 seconds.
    bool free = false;
    std::optional<PanTilt> at;  // reported angles
  };

  explicit ViewTour(const Config& config) : config_(config) {}

  // Plans four views, a quarter turn apart, or closer together if the travel limits require it.
  // Views that the unit cannot reach are left out. With fewer than three views, there are no
  // rounds. `count`: the size of the unit's counts [rad].
  void plan(const mount::Limits& limits, const PanTilt& count);
  const std::vector<PanTilt>& views() const { return views_; }  // reported angles
  // Requests a round, which begins when the station has been free for 20 seconds. Call it after
  // homing, on command, or to confirm a finding.
  void request() { requested_ = true; }
  // True once after a round in which all views were seen, except those that were left out.
  bool take_finished();
  // Indices of the views that the last finished round left out.
  const std::vector<std::size_t>& left_out() const { return left_out_; }
  // Number of consecutive rounds that ended because the unit did not reach a view in time.
  int late() const { return late_; }
  bool under_way() const { return view_.has_value(); }

  // Call in every cycle of the control loop. Returns the unit's goal; nullopt if no round is under
  // way.
  std::optional<mount::Goal> step(const Situation& situation);
  // Index of the view that a frame with this mid-exposure shows; the unit then goes to the next
  // view. nullopt if the frame shows no view, or the unit has not been at rest for settle_s.
  std::optional<std::size_t> see(double mid_exposure_s);

 private:
  bool is_due(double now_s) const;
  bool comes_back(double now_s);
  void begin(double now_s);
  void go_on(double now_s);
  void note_arrival(const Situation& situation);
  void give_up(double now_s);
  PanTilt target() const;

  Config config_;
  std::vector<PanTilt> views_;
  PanTilt count_;
  bool requested_ = false, finished_ = false;
  std::optional<double> free_since_s_;
  std::optional<double> ended_s_;    // end of the last round
  std::optional<std::size_t> view_;  // the current view
  bool from_start_ = false;  // the unit has reached the point from which the view is approached
  std::optional<double> stands_since_s_;
  double leg_since_s_ = 0.0;
  int late_ = 0;
  // The views left out in the last finished round; those left out in the current round.
  std::vector<std::size_t> left_out_, leaving_out_;
  double looks_again_s_ = 0.0;
};

}  // namespace ols::station
