// The stage in which one rectification target is measured with the help of a person. While the
// person sets up the target, a live picture shows the measured value. When the person confirms,
// pictures are taken with both directions of approach, and each is read separately. If the target's
// position depends on where the unit points, the unit does not move during the stage. Pure.
#pragma once

#include <string>
#include <vector>

#include "calibration/procedure/target_reader.h"

namespace ols::calibration {

class RectificationStage : public Stage {
 public:
  // `start`: the angles to which the unit turns first. `rounds`: number of pictures for each
  // direction of approach.
  RectificationStage(TargetReaderPtr reader, const PanTilt& start, int rounds);

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void seen(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer& answer) override;
  std::vector<Observation> observations() const override { return observations_; }
  double progress() const override;

 private:
  enum class State { kPuttingUp, kMeasuring, kDone };

  int pictures() const { return 2 * rounds_; }
  Shot shot() const;
  void look(const Taken& picture);
  void ask(const std::string& trouble);
  void measure(const Taken& picture);
  void end_measuring();

  TargetReaderPtr reader_;
  PanTilt angles_;
  int rounds_;
  State state_ = State::kPuttingUp;
  std::optional<Taken> picture_;  // the newest picture, while the person sets up the target
  std::optional<Eigen::Vector2d> pointed_;
  std::optional<TargetReading> reading_;  // of picture_
  std::optional<Order> question_;
  int taken_ = 0, read_ = 0;
  std::string number_;  // the measured value, from the last picture that could be read
  std::vector<Observation> observations_;
};

}  // namespace ols::calibration
