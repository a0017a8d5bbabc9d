#include "tools/calibrate/target_file.h"

#include "base/config/config_section.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr config::Range kAway_m{2.0, 1000.0};

LevelBoard level_board(ConfigTable& table) {
  LevelBoard board;
  double level_sd_deg = degrees(board.level_sd_rad);
  config::read({"level_line",
                "Level, parallel lines, dark on light.",
                {config::number("level_sd_deg", level_sd_deg, {1e-4, 5.0}, "deg",
                                "How well the lines are level, 1-sigma.")}},
               table);
  board.level_sd_rad = radians(level_sd_deg);
  return board;
}

CrossBoard cross_board(ConfigTable& table) {
  CrossBoard board;
  config::read(
      {"cross",
       "A cross straight ahead of the unit, and one so far to the right as the camera stands.",
       {config::number("distance_m", board.distance_m, kAway_m, "m", "From the pan axis.")
            .required(),
        config::number("apart_m", board.apart_m, {0.0, 10.0}, "m",
                       "Between the crosses; 0: the camera stands above the axes, they are one."),
        config::number("arm_m", board.arm_m, {0.005, 5.0}, "m",
                       "From the centre to the end of an arm."),
        config::number("width_m", board.width_m, {0.001, 1.0}, "m", "Width of an arm."),
        config::number("sd_m", board.sd_m, {1e-5, 1.0}, "m",
                       "How well the left cross is where the unit points, 1-sigma.")}},
      table);
  if (board.width_m >= board.arm_m) throw table.error("width_m", "is not smaller than arm_m");
  return board;
}

RulerPair ruler_pair(ConfigTable& table) {
  RulerPair pair;
  config::read(
      {"rulers",
       "Two rulers of black and white bars, one behind the other, their zeros at one height.",
       {config::number("near_m", pair.near_m, kAway_m, "m", "The nearer one, from the pan axis.")
            .required(),
        config::number("far_m", pair.far_m, kAway_m, "m", "The farther one, from the pan axis.")
            .required(),
        config::number("bar_m", pair.bar_m, {0.001, 1.0}, "m", "Height of a bar."),
        config::number("sd_m", pair.sd_m, {1e-5, 0.1}, "m",
                       "How well each zero is at the common height, 1-sigma.")}},
      table);
  constexpr double kApart = 1.2;
  if (pair.far_m < kApart * pair.near_m) {
    throw table.error("far_m", pair.far_m < pair.near_m
                                   ? "is smaller than near_m: are the two exchanged?"
                                   : "is not a fifth larger than near_m");
  }
  return pair;
}

}  // namespace

RectificationTargets read_targets(const std::string& path) {
  ConfigFile file(path);
  ConfigTable& root = file.root();
  root.refuse_unknown({"level_line", "cross", "rulers"});
  RectificationTargets targets;
  if (root.has("level_line")) targets.level = level_board(root.table("level_line"));
  if (root.has("cross")) targets.cross = cross_board(root.table("cross"));
  if (root.has("rulers")) targets.rulers = ruler_pair(root.table("rulers"));
  if (!targets.level && !targets.cross && !targets.rulers) {
    throw root.error("level_line", "is missing, as are cross and rulers: one target is needed");
  }
  return targets;
}

}  // namespace ols::calibration
