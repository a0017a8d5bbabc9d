// A guided procedure as a sequence of orders: point there and take a picture, ask a person, or ask
// the stage again in a moment because something that it needs is still to come. The caller carries
// an order out and reports the result; clock, devices and files are the caller's. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

struct Shot {
  PanTilt angles;  // as the unit reports them
  // The sign of the last motion in counts: by a detour if need be.
  int approach_pan = 1, approach_tilt = 1;
  bool may_detour = true;  // else straight there, from wherever the unit is
  bool lossless = true;
  // Of scenery that stays: with such a picture it is compared later whether the tripod has moved.
  bool is_view = false;
};

struct Question {
  std::string text;
  std::vector<std::string> choices;
  cv::Mat picture;  // empty: none
  std::optional<Eigen::Vector2d> crosshair_px;
  double crosshair_sd_px = 0.0;
  bool is_live = false;  // new pictures go to the stage while the question stands
};

struct Order {
  enum class Kind { kShoot, kAsk, kWait };
  Kind kind = Kind::kShoot;
  std::string step;  // for a person
  Shot shot;
  Question question;
};

// A picture, and what the unit counted at its exposure.
struct Taken {
  cv::Mat gray;
  UnitReading reading;
  PanTilt angles;  // as the unit reports them [rad]
  std::int64_t utime_us = 0;
  std::int64_t pose = 0;  // a number of its own
};

struct Answer {
  std::string choice;                    // one of the question's
  std::optional<Eigen::Vector2d> pixel;  // of "point"
  PanTilt turn;                          // of "turn" [rad]
  std::int64_t utime_us = 0;             // when it was given
};

class Stage {
 public:
  virtual ~Stage() = default;
  // What is to be done now, the same until it is reported; nothing: the stage is complete.
  virtual std::optional<Order> next() = 0;
  virtual void taken(const Taken& picture) = 0;
  // Of a live question, which may change by it.
  virtual void seen(const Taken&) {}
  // What can be computed while the unit drives; true: there is more. All of it is done before the
  // stage is complete.
  virtual bool work() { return false; }
  // The order to shoot could not be carried out.
  virtual void not_taken(const std::string& why) = 0;
  virtual void answered(const Answer& answer) = 0;
  // The procedure was interrupted here and goes on now: what a person did to the unit may be
  // undone.
  virtual void resumed() {}
  // Of the stage so far; a later call may have others (a sighting was redone).
  virtual std::vector<Observation> observations() const = 0;
  virtual double progress() const = 0;  // 0..1
  // What a person should know, as sentences.
  std::vector<std::string> take_remarks() { return std::exchange(remarks_, {}); }

 protected:
  void remark(std::string sentence) { remarks_.push_back(std::move(sentence)); }

 private:
  std::vector<std::string> remarks_;
};

// An observation of a picture, as far as the picture tells.
Observation observation_of(Kind kind, const Taken& picture, const Eigen::Vector2d& pixel,
                           double sd_px, std::string reference);

}  // namespace ols::calibration
