// A guided procedure as a sequence of orders: point there and take a picture, ask a person, or ask
// the stage again in a moment because it waits for data. The caller carries out an order and
// reports the result. Clock, devices and files belong to the caller. Pure.
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
  // The required sign of the last motion in counts; the unit makes a detour if needed.
  int approach_pan = 1, approach_tilt = 1;
  bool may_detour = true;  // false: go straight there
  bool lossless = true;
  // Whether the picture shows permanent scenery. Later pictures are compared with it to see whether
  // the tripod has moved.
  bool is_view = false;
};

struct Question {
  std::string text;
  std::vector<std::string> choices;
  cv::Mat picture;  // empty: no picture
  std::optional<Eigen::Vector2d> crosshair_px;
  double crosshair_sd_px = 0.0;
  bool is_live = false;  // the stage gets new pictures while the question is open
};

struct Order {
  enum class Kind { kShoot, kAsk, kWait };
  Kind kind = Kind::kShoot;
  std::string step;  // for a person
  Shot shot;
  Question question;
};

// A picture, and the unit's counts at its exposure.
struct Taken {
  cv::Mat gray;
  UnitReading reading;
  PanTilt angles;  // as the unit reports them [rad]
  std::int64_t utime_us = 0;
  std::int64_t pose = 0;  // its own number
};

struct Answer {
  std::string choice;                    // one of the question's choices
  std::optional<Eigen::Vector2d> pixel;  // of "point"
  PanTilt turn;                          // of "turn" [rad]
  std::int64_t utime_us = 0;             // when it was given
};

class Stage {
 public:
  virtual ~Stage() = default;
  // The current order, the same until its result is reported; nullopt: the stage is complete.
  virtual std::optional<Order> next() = 0;
  virtual void taken(const Taken& picture) = 0;
  // Takes a new picture for a live question. The question may change because of it.
  virtual void seen(const Taken&) {}
  // Does a piece of computation while the unit drives; true: there is more. A stage is complete
  // only when all of it is done.
  virtual bool work() { return false; }
  // The order to take a picture could not be carried out.
  virtual void not_taken(const std::string& why) = 0;
  virtual void answered(const Answer& answer) = 0;
  // The procedure was interrupted and continues now. What a person did to the unit may have been
  // undone.
  virtual void resumed() {}
  // The stage's observations so far. A later call may return different ones (after a sighting was
  // redone).
  virtual std::vector<Observation> observations() const = 0;
  virtual double progress() const = 0;  // 0..1
  // Sentences for a person.
  std::vector<std::string> take_remarks() { return std::exchange(remarks_, {}); }

 protected:
  void remark(std::string sentence) { remarks_.push_back(std::move(sentence)); }

 private:
  std::vector<std::string> remarks_;
};

// The parts of an observation that the picture alone determines.
Observation observation_of(Kind kind, const Taken& picture, const Eigen::Vector2d& pixel,
                           double sd_px, std::string reference);

}  // namespace ols::calibration
