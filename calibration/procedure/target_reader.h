// The paper's rectification targets as a person sets them up, and the evaluation of a picture of
// each: what to show, the measured value, observations. Pure.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/procedure/stage.h"
#include "geometry/station_model.h"

namespace ols::calibration {

// Level, parallel lines, dark on light.
struct LevelBoard {
  double level_sd_rad = 30.0 * EIGEN_PI / 648000.0;
};
// A cross straight ahead of the unit's axes, and another one to the right of it, at the camera's
// offset from the axes. If the camera is directly above the axes, there is only one.
struct CrossBoard {
  double distance_m = 0.0;  // from the pan axis
  double apart_m = 0.0;
  double arm_m = 0.12, width_m = 0.03;  // from the centre to the end of an arm; its width
  double sd_m = 0.003;                  // of the left cross, against where the unit points
};
// Two rulers at two distances, side by side in the picture, with their zeros at the same height.
struct RulerPair {
  double near_m = 0.0, far_m = 0.0;  // from the pan axis
  double bar_m = 0.05;               // height of a bar
  double sd_m = 0.001;               // of each zero's height
};
struct RectificationTargets {
  std::optional<LevelBoard> level;
  std::optional<CrossBoard> cross;
  std::optional<RulerPair> rulers;
};

struct TargetReading {
  std::string trouble;  // why the target cannot be read, as a sentence; empty: it is read
  std::string number;   // the measured value in words
  cv::Mat shown;
  std::optional<Eigen::Vector2d> crosshair_px;
  double crosshair_sd_px = 0.0;
  std::vector<Observation> observations;  // none if there is trouble
};

class TargetReader {
 public:
  virtual ~TargetReader() = default;
  virtual std::string name() const = 0;         // "level line"
  virtual std::string instruction() const = 0;  // what a person has to set up, and where
  // Whether the target's place depends on where the unit points. If so, the unit must not turn
  // until all pictures are taken.
  virtual bool holds_unit() const { return false; }
  // `pointed`: where a person says the target, or a part of it, is.
  virtual TargetReading read(const Taken& picture,
                             const std::optional<Eigen::Vector2d>& pointed) const = 0;
};
using TargetReaderPtr = std::unique_ptr<const TargetReader>;

TargetReaderPtr level_line_reader(const LevelBoard& board);
TargetReaderPtr cross_reader(const StationModel& model, const CrossBoard& board);
TargetReaderPtr ruler_reader(const StationModel& model, const RulerPair& rulers);
// In the paper's order.
std::vector<TargetReaderPtr> target_readers(const StationModel& model,
                                            const RectificationTargets& targets);

}  // namespace ols::calibration
