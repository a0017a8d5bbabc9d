// The round over a station's reference views: when the station is free, the unit goes from one to
// the next, always from the same side, and stands while a picture is taken. Pure.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "edge/ptu/servo.h"

namespace ols::station {

class ViewTour {
 public:
  struct Config {
    // Of idleness, from one check to the next; infinite: only on request.
    double interval_s = std::numeric_limits<double>::infinity();
    double settle_s = 1.0;  // it stands so long before mid-exposure
    double leg_s = 40.0;    // a view that takes longer is out of reach: the round is given up
    // Whether the unit must not look there now (reported angles): the sun stands there. Such a view
    // is left out of the round; when it may be looked at again, a round is made. Empty: it may look
    // everywhere.
    std::function<bool(const PanTilt&)> forbidden;
  };
  struct Situation {
    double now_s = 0.0;
    // No target, no operator, no slew, no stop, and a trusted reference. Otherwise the round ends
    // at once, and begins anew when the station has been free for a while.
    bool free = false;
    std::optional<PanTilt> at;  // reported angles
  };

  explicit ViewTour(const Config& config) : config_(config) {}

  // The views that this travel allows: four a quarter turn apart, or closer, or fewer than three
  // (then no round is made). `count`: of the unit [rad].
  void plan(const ptu::PtuLimits& limits, const PanTilt& count);
  const std::vector<PanTilt>& views() const { return views_; }  // reported angles
  // A check soon: after homing, on request, to confirm a finding.
  void request() { requested_ = true; }
  // All views have been seen but those left out; asked once.
  bool take_finished();
  // Of the last round that was finished.
  const std::vector<std::size_t>& left_out() const { return left_out_; }
  // Rounds in a row that were given up because the unit did not come to a view in time.
  int late() const { return late_; }
  bool under_way() const { return view_.has_value(); }

  // In every turn. The unit's goal; empty: none of this round.
  std::optional<ptu::ServoGoal> step(const Situation& situation);
  // The view that a frame of this mid-exposure is of; empty: of none, or not needed.
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
  std::optional<double> ended_s_;    // the last round
  std::optional<std::size_t> view_;  // under way
  bool from_start_ = false;          // it has been where the view is approached from
  std::optional<double> stands_since_s_;
  double leg_since_s_ = 0.0;
  int late_ = 0;
  std::vector<std::size_t> left_out_, leaving_out_;  // of the last round; of the one under way
  double looks_again_s_ = 0.0;
};

}  // namespace ols::station
