// A simulated ONVIF camera in the hands of the product's driver, in simulated time, and its
// pictures with what the station measures in them.
#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "dev/bench/onvif_pictures.h"
#include "edge/frames/pointing_model.h"
#include "edge/mount/onvif/onvif_kind.h"
#include "edge/tracker/ego_motion.h"
#include "sim/onvif/onvif_in_hand.h"

namespace ols::bench {

inline constexpr double kTurn_s = 0.005;

class Loop {
 public:
  Loop(const sim::OnvifConfig& device, const mount::DriveConfig& drive, std::uint64_t seed)
      : history_(history_config(drive)),
        pointing_(station_config(drive)),
        in_hand_(device, drive, seed, kBegin_s) {}

  using GoalAt = std::function<std::optional<mount::Goal>(double)>;
  // `each`: after each turn of 5 ms.
  void run(double seconds, const GoalAt& goal_at, const std::function<void()>& each = {}) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s; now_s_ += kTurn_s) {
      if (station_lives) turn(goal_at);
      if (each) each();
    }
  }
  double now_s() const { return now_s_; }
  PanTilt truth(double time_s) const { return in_hand_.angles_at(time_s); }
  bool turns() const {
    const PanTilt then = truth(now_s_ - kTurn_s), now = truth(now_s_);
    return std::abs(now.pan_rad - then.pan_rad) + std::abs(now.tilt_rad - then.tilt_rad) > 0.0;
  }
  const mount::AngleHistory& history() const { return history_; }  // of the reports alone
  station::PointingModel& pointing() { return pointing_; }
  mount::Drive& drive() { return in_hand_.drive(); }
  sim::OnvifInHand::Wire& wire() { return in_hand_.wire; }
  void set_faults(const sim::PtzFaults& faults) { in_hand_.set_faults(faults, now_s_); }
  void order_by_another(const onvif::Request& request) {
    in_hand_.order_by_another(request, now_s_);
  }

  bool station_lives = true;

 private:
  static constexpr double kBegin_s = 1.0;

  static mount::AngleHistory::Config history_config(const mount::DriveConfig& drive) {
    onvif::OnvifKind kind;
    kind.onvif.drive = drive;
    return kind.traits().angles;
  }
  static station::StationConfig station_config(const mount::DriveConfig& drive) {
    station::StationConfig config;
    config.geometry = bench::ptz_geometry();
    config.angles = history_config(drive);
    return config;
  }
  void turn(const GoalAt& goal_at) {
    drive().set_goal(goal_at ? goal_at(now_s_) : std::nullopt);
    in_hand_.advance(now_s_);
    for (const auto& sample : drive().take_samples()) {
      history_.add(sample);
      pointing_.add(sample);
    }
  }

  mount::AngleHistory history_;
  station::PointingModel pointing_;
  sim::OnvifInHand in_hand_;
  double now_s_ = kBegin_s;
};

// What a picture shows beside the camera's own motion.
struct Disturbance {
  std::function<PanTilt(double)> sway = {};  // turn of the whole camera, or of the whole scene
  std::function<double(double)> light = {};  // factor of the brightness
  double late_s = 0.0;                       // pictures are stamped this long after their exposure
};

// The camera's pictures, and the motion that the station measures in them.
class Watcher {
 public:
  Watcher(Scene scene, std::uint64_t seed, Disturbance disturbance = {})
      : disturbance_(std::move(disturbance)),
        pictures_(scene, seed),
        ego_motion_(tracker::TrackerConfig{}, tracker::HomographyFit::kLeastSquares) {}

  // The picture that is stamped with this time.
  void look(Loop& loop, double stamp_s) {
    camera::Frame frame;
    frame.gray = draw(loop, stamp_s - disturbance_.late_s);
    frame.mid_exposure_s = stamp_s;
    const auto reduced = tracker::reduce_frame(frame.gray, frame.gray.cols);
    if (before_s_ == 0.0) {
      ego_motion_.start(reduced);
    } else {
      const auto predicted = loop.pointing().homography(before_s_, stamp_s);
      const auto seen = ego_motion_.step(reduced, {}, predicted).motion;
      const auto turn = seen ? loop.pointing().add(*seen, before_s_, frame) : std::nullopt;
      if (turn) loop.drive().see(*turn);
    }
    before_s_ = stamp_s;
  }

 private:
  cv::Mat draw(const Loop& loop, double exposed_s) {
    PanTilt angles = loop.truth(exposed_s);
    if (disturbance_.sway) {
      const PanTilt sway = disturbance_.sway(exposed_s);
      angles = {angles.pan_rad + sway.pan_rad, angles.tilt_rad + sway.tilt_rad};
    }
    cv::Mat gray = pictures_.draw(angles, exposed_s);
    if (disturbance_.light) gray.convertTo(gray, -1, disturbance_.light(exposed_s));
    return gray;
  }

  const Disturbance disturbance_;
  bench::OnvifPictures pictures_;
  tracker::EgoMotionEstimator ego_motion_;
  double before_s_ = 0.0;
};

}  // namespace ols::bench
