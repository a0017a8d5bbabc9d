// A stage of a guided procedure: a sequence of orders. An order is to point in a direction and take
// a picture, to ask a person, or to wait a moment for data. The caller carries out each order and
// reports the result. Only the caller uses the clock, devices and files.
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
  bool may_detour = true;  // if false, the unit turns directly to the angles
  bool lossless = true;
  // Whether the picture shows permanent scenery. If so, later pictures are compared with this one,
  // to detect that the tripod has moved.
  bool is_view = false;
};

struct Question {
  std::string text;
  std::vector<std::string> choices;
  cv::Mat picture;  // empty if there is no picture
  std::optional<Eigen::Vector2d> crosshair_px;
  double crosshair_sd_px = 0.0;
  bool is_live = false;  // the stage gets new pictures while the question is open
};

struct Order {
  enum class Kind { kShoot, kAsk, kWait };
  Kind kind = Kind::kShoot;
  std::string step;  // the current step, described for a person
  Shot shot;
  Question question;
};

// A picture that was taken, with the unit's counts at its exposure.
struct Taken {
  cv::Mat gray;
  UnitReading reading;
  PanTilt angles;  // as the unit reports them [rad]
  std::int64_t utime_us = 0;
  std::int64_t pose = 0;  // the number of this picture's pose
};

struct Answer {
  std::string choice;                    // one of the question's choices
  std::optional<Eigen::Vector2d> pixel;  // where the person pointed, for the choice "point"
  PanTilt turn;                          // how far to turn the unit [rad], for the choice "turn"
  std::int64_t utime_us = 0;             // when it was given
};

class Stage {
 public:
  virtual ~Stage() = default;
  // The current order. It stays the same until its result is reported. nullopt if the stage is
  // complete.
  virtual std::optional<Order> next() = 0;
  virtual void taken(const Taken& picture) = 0;
  // Takes a new picture for a live question. It may change the question.
  virtual void seen(const Taken&) {}
  // Does a part of the computation while the unit moves. Returns whether computation remains; until
  // it is done, the stage is not complete.
  virtual bool work() { return false; }
  // Reports that the picture could not be taken.
  virtual void not_taken(const std::string& why) = 0;
  virtual void answered(const Answer& answer) = 0;
  // Reports that the procedure was interrupted and now continues. In the meantime, a person's
  // changes at the unit (such as putting a filter on) may have been undone.
  virtual void resumed() {}
  // The stage's observations so far. If a sighting is redone, the new observation replaces the old
  // one.
  virtual std::vector<Observation> observations() const = 0;
  virtual double progress() const = 0;  // 0..1
  // Returns the sentences for a person that are new since the last call.
  std::vector<std::string> take_remarks() { return std::exchange(remarks_, {}); }

 protected:
  void remark(std::string sentence) { remarks_.push_back(std::move(sentence)); }

 private:
  std::vector<std::string> remarks_;
};

// Makes an observation: reading, pose and time are those of the picture.
Observation observation_of(Kind kind, const Taken& picture, const Eigen::Vector2d& pixel,
                           double sd_px, std::string reference);

}  // namespace ols::calibration
