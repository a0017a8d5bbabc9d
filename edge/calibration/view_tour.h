// Plans the rounds over a station's reference views. While the station is free, the unit goes from
// view to view, always from the same side, and stops while a picture is taken. Pure.
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
    // Idle time from one check to the next; if infinite, checks are made only on request.
    double interval_s = std::numeric_limits<double>::infinity();
    double settle_s = 1.0;  // time at rest before mid-exposure
    double leg_s = 40.0;    // a view not reached in this time ends the round
    // Whether the sun is too near to this direction now (reported angles). The round leaves out
    // such a view, and another round follows when the view is possible again. If empty, all views
    // are possible.
    std::function<bool(const PanTilt&)> forbidden;
  };
  struct Situation {
    double now_s = 0.0;
    // The station is free: there is no target, operator, slew or stop, and the reference is
    // trusted. If it is not free, the round ends at once. A new one begins when the station has
    // been free for a while.
    bool free = false;
    std::optional<PanTilt> at;  // reported angles
  };

  explicit ViewTour(const Config& config) : config_(config) {}

  // Plans the views that these travel limits allow: four views a quarter turn apart, or closer. If
  // fewer than three views are possible, there are no rounds. `count`: the size of the unit's
  // counts [rad].
  void plan(const mount::Limits& limits, const PanTilt& count);
  const std::vector<PanTilt>& views() const { return views_; }  // reported angles
  // Requests a check soon: after homing, on command, or to confirm a finding.
  void request() { requested_ = true; }
  // True once when all views have been seen, except those that were left out.
  bool take_finished();
  // The views that the last finished round left out.
  const std::vector<std::size_t>& left_out() const { return left_out_; }
  // Number of consecutive rounds that were given up because the unit did not reach a view in time.
  int late() const { return late_; }
  bool under_way() const { return view_.has_value(); }

  // Call in every turn. Returns the unit's goal; nullopt if no round is under way.
  std::optional<mount::Goal> step(const Situation& situation);
  // The view that a frame with this mid-exposure shows; nullopt if it shows none, or is not needed.
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
  // The views left out in the last round; in the current one.
  std::vector<std::size_t> left_out_, leaving_out_;
  double looks_again_s_ = 0.0;
};

}  // namespace ols::station
