// Asks a person where an object is in a picture. The person points at the object, a crosshair snaps
// to it, and the person confirms. The person may turn the unit first. Pure.
#pragma once

#include <optional>
#include <string>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

class PointingDialog {
 public:
  enum class Event { kAsksOn, kConfirmed, kTurn, kSkipped };

  // Asks for `what` in this picture, without a crosshair.
  void begin(const std::string& what, const Taken& picture);
  // Puts the crosshair on the structure near this pixel; if there is none, the question says why.
  // If `as_is`, puts the crosshair on the pixel itself.
  void place(const Eigen::Vector2d& near_px, double radius_px, bool as_is = false);
  Event answered(const Answer& answer);
  void end() { question_.reset(); }

  // The current question; nullopt before begin() and after end().
  const std::optional<Order>& question() const { return question_; }
  bool has_crosshair() const { return question_ && question_->question.crosshair_px.has_value(); }
  // The picture, and the position of the crosshair in the picture.
  const Taken& picture() const { return picture_; }
  Eigen::Vector2d pixel() const { return *question_->question.crosshair_px; }
  double sd_px() const { return question_->question.crosshair_sd_px; }

 private:
  void show(const std::string& trouble);

  std::string what_;
  Taken picture_;
  std::optional<Order> question_;
};

}  // namespace ols::calibration
