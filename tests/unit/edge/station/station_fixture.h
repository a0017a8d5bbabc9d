// A station with a scripted tracker and a PTU whose angles the test sets. The test advances the
// time.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "edge/station/station.h"
#include "geometry/angles.h"

namespace ols::station::test {

// A tracker that returns what the test has set in its script.
struct ScriptedTracker : tracker::TargetTracker {
  struct Script {
    double belief = 0.9;
    Eigen::Vector2d pixel{639.5, 479.5};
    double size_px = 20.0;  // width and height of the tracker's box
    bool accept = true, prediction_dropped = false;
    std::optional<double> prediction_error_px;
    std::optional<tracker::ImageMotion> image_motion;
    int initialised = 0, searches = 0, tracked = 0, set_aside = 0, taken_back = 0;
    Eigen::Vector2d searched_pixel = Eigen::Vector2d::Zero();
    std::optional<tracker::TrackerInput> last;
    cv::Rect2d first_box;
  };
  explicit ScriptedTracker(Script& script) : s(script) {}
  std::optional<tracker::TrackerError> initialise(const tracker::TrackerInput&,
                                                  const cv::Rect2d& box) override {
    if (!s.accept) return tracker::TrackerError::kBox;
    s.first_box = box;
    ++s.initialised;
    return std::nullopt;
  }
  tracker::TrackerResult track(const tracker::TrackerInput& input) override {
    ++s.tracked;
    s.last = input;
    tracker::TrackerOutput output;
    output.pixel = s.pixel;
    output.box = {s.pixel.x() - 0.5 * s.size_px, s.pixel.y() - 0.5 * s.size_px, s.size_px,
                  s.size_px};
    output.covariance_px2 = Eigen::Matrix2d::Identity() * 0.25;
    output.belief = s.belief;
    output.prediction_error_px = s.prediction_error_px;
    output.prediction_dropped = s.prediction_dropped;
    output.image_motion = s.image_motion;
    return {output, std::nullopt};
  }
  void search_near(const Eigen::Vector2d& pixel, double) override {
    ++s.searches;
    s.searched_pixel = pixel;
  }
  void set_aside() override { ++s.set_aside; }
  void take_back() override { ++s.taken_back; }
  Script& s;
};

constexpr double kFrame_s = 1.0 / 15.0;

class StationTest : public testing::Test {
 protected:
  StationTest() : station_(config(), std::make_unique<ScriptedTracker>(script_)) {
    station_.set_reference(mount::Reference::kTrusted);
  }

  static StationConfig config() {
    StationConfig config;
    config.geometry.position = {radians(49.2), radians(16.6), 250.0};
    config.geometry.chain.heading_rad = radians(30.0);
    config.geometry.sd.heading_rad = radians(0.02);
    config.limits = {-radians(159), radians(159), -radians(46), radians(31)};
    return config;
  }

  // Runs until `end_s`, with PTU samples every 20 ms and a frame every 1/15 s; collects the
  // bearings.
  void run_until(double end_s, bool frames = true, const cv::Mat& gray = {}) {
    while (now_ < end_s) {
      now_ += 0.005;
      if (now_ >= next_sample_) {
        station_.on_angles(sample());
        next_sample_ += 0.02;
      }
      if (frames && now_ >= next_frame_) {
        camera::Frame frame;
        frame.gray = gray;
        frame.mid_exposure_s = frame_s_ = now_ - 0.02;
        frame.row_readout_s = row_readout_s_;
        station_.on_frame(frame);
        next_frame_ = now_ + kFrame_s;
      }
      for (const auto& bearing : station_.step(now_).bearings) bearings_.push_back(bearing);
    }
  }

  mount::AngleSample sample() const {
    mount::AngleSample sample;
    sample.time_s = now_;
    sample.time_sd_s = 1e-4;
    sample.angles = angles_;
    return sample;
  }

  SlewCommand slew(double azimuth_deg, double elevation_deg = 0.0) const {
    SlewCommand command;
    command.effect_s = now_ + 0.05;
    command.received_s = now_;
    command.lease_s = 0.5;
    command.target_id = 1;
    command.direction = {radians(azimuth_deg), radians(elevation_deg)};
    command.direction_sd_rad = 1e-3;
    return command;
  }

  void designated() {
    run_until(now_ + 0.3);
    ASSERT_EQ(station_.designate({std::nullopt, {629, 469, 20, 20}}, now_), Refusal::kNone);
  }
  void designated_for(double duration_s) {
    designated();
    run_until(now_ + duration_s);
  }

  ScriptedTracker::Script script_;
  Station station_;
  PanTilt angles_;
  double now_ = 100.0, next_sample_ = 100.0, next_frame_ = 100.0;
  double frame_s_ = 0.0, row_readout_s_ = 0.0;
  std::vector<Bearing> bearings_;
};

}  // namespace ols::station::test
