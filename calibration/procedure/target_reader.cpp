#include "calibration/procedure/target_reader.h"

#include <algorithm>
#include <cmath>

#include "calibration/pictures/cross_finding.h"
#include "calibration/pictures/level_lines.h"
#include "calibration/pictures/mirrored_blend.h"
#include "calibration/pictures/ruler_reading.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;

// Of anything that a lens images: blooming, paint, haze.
constexpr double kFloor_px = 0.1;

Vector2d middle_of(const cv::Mat& gray) { return {0.5 * (gray.cols - 1), 0.5 * (gray.rows - 1)}; }

class LevelLineReader : public TargetReader {
 public:
  explicit LevelLineReader(const LevelBoard& board) : board_(board) {}
  std::string name() const override { return "level line"; }
  std::string instruction() const override {
    return "Put up the board with the level lines square to the line of sight, with lines above "
           "and below the middle of the picture. In the blend with the mirror image they run "
           "through when the camera is not rolled";
  }
  TargetReading read(const Taken& picture, const std::optional<Vector2d>&) const override {
    TargetReading reading;
    reading.shown = mirrored_blend(picture.gray);
    const LevelLines lines = find_level_lines(picture.gray);
    if (!lines) {
      reading.trouble = to_string(lines.refusal);
      return reading;
    }
    reading.number = printed("rolled by %+.3f deg (clockwise > 0), %zu edges",
                             -degrees(std::atan(lines.slope)), lines.edges.size());
    for (const LevelEdge& edge : lines.edges) {
      Observation one = observation_of(Kind::kLevelLine, picture, edge.left_px,
                                       std::hypot(kFloor_px, edge.sd_px), name());
      one.target.second_px = edge.right_px;
      one.target.sd = board_.level_sd_rad;
      reading.observations.push_back(std::move(one));
    }
    return reading;
  }

 private:
  LevelBoard board_;
};

class CrossReader : public TargetReader {
 public:
  CrossReader(const StationModel& model, const CrossBoard& board)
      : focal_px_(model.geometry.camera.fx_px), board_(board) {
    const ChainParameters& chain = model.geometry.chain;
    beside_m_ = -chain.ele_to_focus_m.y() - chain.focus_to_camera_m.y();
  }
  std::string name() const override { return "cross"; }
  bool holds_unit() const override { return true; }
  std::string instruction() const override {
    return board_.apart_m > 0.0
               ? printed(
                     "Put up the board with the crosses at %.2f m, the left one where the unit's "
                     "own pointer meets it, the right one %.3f m to the right",
                     board_.distance_m, board_.apart_m)
               : printed(
                     "Put up the board with the cross at %.2f m, where the unit's own pointer "
                     "meets it",
                     board_.distance_m);
  }
  TargetReading read(const Taken& picture, const std::optional<Vector2d>& pointed) const override {
    TargetReading reading;
    reading.shown = picture.gray;
    const double px_m = focal_px_ / board_.distance_m;
    const CrossSize size{board_.arm_m * px_m, board_.width_m * px_m, board_.apart_m * px_m};
    const cv::Rect part = around(picture.gray, pointed, 1.5 * size.apart_px + 5.0 * size.arm_px);
    const Crosses found = find_crosses(picture.gray(part), size);
    if (!found) {
      reading.trouble = to_string(found.refusal);
      if (found.refusal == Crosses::Refusal::kScale) {
        reading.trouble += printed(": by their size they stand at %.1f m, not at %.1f",
                                   board_.distance_m / found.scale, board_.distance_m);
      }
      return reading;
    }
    const Vector2d at = found.right_px + Vector2d(part.x, part.y);
    const double seen_rad = std::atan((at.x() - middle_of(picture.gray).x()) / focal_px_);
    const double there_rad = std::atan((board_.apart_m - beside_m_) / board_.distance_m);
    reading.number = printed(
        "the image's middle lies %+.3f deg beside it, the camera looks %+.3f deg to the right",
        -degrees(seen_rad), degrees(there_rad - seen_rad));
    reading.crosshair_px = at;
    reading.crosshair_sd_px = std::hypot(kFloor_px, found.sd_px);
    Observation one = observation_of(Kind::kCross, picture, at, reading.crosshair_sd_px, name());
    one.target.distance_m = board_.distance_m;
    one.target.offset_m = board_.apart_m;
    one.target.sd = board_.sd_m;
    reading.observations.push_back(std::move(one));
    return reading;
  }

 private:
  // All of the picture, or what is around a finger.
  static cv::Rect around(const cv::Mat& gray, const std::optional<Vector2d>& pointed,
                         double reach_px) {
    const cv::Rect all({}, gray.size());
    if (!pointed) return all;
    const int reach = static_cast<int>(std::ceil(reach_px));
    return cv::Rect(static_cast<int>(pointed->x()) - reach, static_cast<int>(pointed->y()) - reach,
                    2 * reach + 1, 2 * reach + 1) &
           all;
  }

  double focal_px_;
  double beside_m_;  // of the camera, to the right of the unit's axes
  CrossBoard board_;
};

class RulerReader : public TargetReader {
 public:
  RulerReader(const StationModel& model, const RulerPair& pair)
      : focal_px_(model.geometry.camera.fy_px), pair_(pair) {}
  std::string name() const override { return "rulers"; }
  std::string instruction() const override {
    return printed(
        "Put up the rulers one behind the other, at %.2f and %.2f m, their zeros at one "
        "height, both in the picture; tilt the unit until both show the same mark in the middle",
        pair_.near_m, pair_.far_m);
  }
  TargetReading read(const Taken& picture, const std::optional<Vector2d>& pointed) const override {
    TargetReading reading;
    reading.shown = picture.gray;
    const RulerReading near = read_at(picture.gray, pair_.near_m, pointed);
    const RulerReading far = read_at(picture.gray, pair_.far_m, pointed);
    reading.trouble = trouble("nearer", near, pair_.near_m);
    if (reading.trouble.empty()) reading.trouble = trouble("farther", far, pair_.far_m);
    if (!reading.trouble.empty()) return reading;
    const double near_m = near.bars * pair_.bar_m, far_m = far.bars * pair_.bar_m;
    const double up_rad = std::atan((far_m - near_m) / (pair_.far_m - pair_.near_m));
    reading.number = printed(
        "nearer ruler %+.4f m, farther one %+.4f m: the camera looks %+.3f deg up, %+.3f over the "
        "unit's tilt",
        near_m, far_m, degrees(up_rad), degrees(up_rad - picture.angles.tilt_rad));
    const double row_px = middle_of(picture.gray).y();
    reading.crosshair_px = Vector2d(near.x_px, row_px);
    reading.crosshair_sd_px = std::hypot(kFloor_px, near.sd_px);
    add(reading, picture, "nearer", near, pair_.near_m);
    add(reading, picture, "farther", far, pair_.far_m);
    return reading;
  }

 private:
  double bar_px(double away_m) const { return pair_.bar_m * focal_px_ / away_m; }

  // Where a finger is, if it is on this one; else where its bars are.
  RulerReading read_at(const cv::Mat& gray, double away_m,
                       const std::optional<Vector2d>& pointed) const {
    const double row_px = middle_of(gray).y();
    RulerReading there;
    there.refusal = RulerReading::Refusal::kNothing;
    if (pointed) there = read_ruler(gray, *pointed, bar_px(away_m), row_px);
    if (there) return there;
    const auto place = find_ruler(gray, bar_px(away_m));
    return place ? read_ruler(gray, *place, bar_px(away_m), row_px) : there;
  }
  std::string trouble(const char* which, const RulerReading& reading, double away_m) const {
    if (reading) return "";
    std::string why = printed("the %s ruler: %s", which, to_string(reading.refusal));
    if (reading.refusal == RulerReading::Refusal::kScale) {
      why += printed(": by their height they stand at %.1f m, not at %.1f; is it the other ruler?",
                     away_m / reading.scale, away_m);
    }
    return why;
  }
  void add(TargetReading& reading, const Taken& picture, const char* which,
           const RulerReading& ruler, double away_m) const {
    Observation one =
        observation_of(Kind::kRuler, picture, {ruler.x_px, middle_of(picture.gray).y()},
                       std::hypot(kFloor_px, ruler.sd_px), which);
    one.target.distance_m = away_m;
    one.target.offset_m = ruler.bars * pair_.bar_m;
    one.target.sd = pair_.sd_m;
    reading.observations.push_back(std::move(one));
  }

  double focal_px_;
  RulerPair pair_;
};

}  // namespace

TargetReaderPtr level_line_reader(const LevelBoard& board) {
  return std::make_unique<LevelLineReader>(board);
}
TargetReaderPtr cross_reader(const StationModel& model, const CrossBoard& board) {
  return std::make_unique<CrossReader>(model, board);
}
TargetReaderPtr ruler_reader(const StationModel& model, const RulerPair& rulers) {
  return std::make_unique<RulerReader>(model, rulers);
}

std::vector<TargetReaderPtr> target_readers(const StationModel& model,
                                            const RectificationTargets& targets) {
  std::vector<TargetReaderPtr> readers;
  if (targets.level) readers.push_back(level_line_reader(*targets.level));
  if (targets.cross) readers.push_back(cross_reader(model, *targets.cross));
  if (targets.rulers) readers.push_back(ruler_reader(model, *targets.rulers));
  return readers;
}

}  // namespace ols::calibration
