// Reads the paper's rectification targets in pictures, while a person sets them up and when they
// are measured. Returns a picture for the person, the measured value, and observations. Pure.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/procedure/stage.h"
#include "geometry/station_model.h"

namespace ols::calibration {

// A board with level, parallel lines, dark on light.
struct LevelBoard {
  double level_sd_rad = 30.0 * EIGEN_PI / 648000.0;
};
// Two crosses. The left cross is straight ahead of the unit's axes. The right cross is beside it,
// at the distance by which the camera is to the right of the axes. If the camera is directly above
// the axes, there is only one cross.
struct CrossBoard {
  double distance_m = 0.0;  // from the pan axis
  double apart_m = 0.0;
  double arm_m = 0.12, width_m = 0.03;  // length of an arm from the centre, and its width
  double sd_m = 0.003;  // 1-sigma of the left cross's position relative to the unit's direction
};
// Two rulers at two distances, side by side in the picture, with their zeros at the same height.
struct RulerPair {
  double near_m = 0.0, far_m = 0.0;  // from the pan axis
  double bar_m = 0.05;               // height of a bar
  double sd_m = 0.001;               // 1-sigma of each zero's height
};
struct RectificationTargets {
  std::optional<LevelBoard> level;
  std::optional<CrossBoard> cross;
  std::optional<RulerPair> rulers;
};

struct TargetReading {
  std::string trouble;  // why the target cannot be read, as a sentence; empty if it was read
  std::string number;   // the measured value, as text
  cv::Mat shown;
  std::optional<Eigen::Vector2d> crosshair_px;
  double crosshair_sd_px = 0.0;
  std::vector<Observation> observations;  // empty if there is trouble
};

class TargetReader {
 public:
  virtual ~TargetReader() = default;
  virtual std::string name() const = 0;         // for example "level line"
  virtual std::string instruction() const = 0;  // what a person has to set up, and where
  // Whether the target's position depends on where the unit points. If so, the unit must not turn
  // before all pictures are taken.
  virtual bool holds_unit() const { return false; }
  // `pointed`: the pixel of the target, or of a part of it, at which a person has pointed.
  virtual TargetReading read(const Taken& picture,
                             const std::optional<Eigen::Vector2d>& pointed) const = 0;
};
using TargetReaderPtr = std::unique_ptr<const TargetReader>;

TargetReaderPtr level_line_reader(const LevelBoard& board);
TargetReaderPtr cross_reader(const StationModel& model, const CrossBoard& board);
TargetReaderPtr ruler_reader(const StationModel& model, const RulerPair& rulers);
// The readers of all targets that are set, in the paper's order.
std::vector<TargetReaderPtr> target_readers(const StationModel& model,
                                            const RectificationTargets& targets);

}  // namespace ols::calibration
