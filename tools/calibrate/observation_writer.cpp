#include "tools/calibrate/observation_writer.h"

#include <nlohmann/json.hpp>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

void add_axis(nlohmann::ordered_json& line, const std::string& axis, const AxisReading& reading) {
  line[axis + "_counts"] = reading.counts;
  line["approach_" + axis] = reading.approach;
  if (reading.counts_per_s != 0.0) line[axis + "_counts_s"] = reading.counts_per_s;
}

void add_target(nlohmann::ordered_json& line, const Observation& one) {
  const TargetFacts& target = one.target;
  if (one.kind == Kind::kLevelLine) {
    line["x2_px"] = target.second_px.x();
    line["y2_px"] = target.second_px.y();
    line["level_sd_deg"] = degrees(target.sd);
    return;
  }
  const bool is_cross = one.kind == Kind::kCross;
  line["distance_m"] = target.distance_m;
  line[is_cross ? "offset_m" : "height_m"] = target.offset_m;
  line[is_cross ? "offset_sd_m" : "height_sd_m"] = target.sd;
}

}  // namespace

std::string observation_lines(const std::vector<Observation>& observations,
                              const std::string& station) {
  std::string text;
  for (const Observation& one : observations) {
    nlohmann::ordered_json line;
    line["kind"] = name(one.kind);
    line["station"] = station;
    if (one.pose) line["pose"] = *one.pose;
    if (one.utime_us != 0) line["utime_us"] = one.utime_us;
    if (one.kind == Kind::kInclinometer) {
      line["x_deg"] = degrees(one.tilt_rad.x());
      line["y_deg"] = degrees(one.tilt_rad.y());
      line["sd_deg"] = degrees(one.tilt_sd_rad);
      line["zero_sd_deg"] = degrees(one.zero_sd_rad);
    } else {
      add_axis(line, "pan", one.reading.pan);
      add_axis(line, "tilt", one.reading.tilt);
      line["x_px"] = one.pixel.x();
      line["y_px"] = one.pixel.y();
      line["sd_px"] = one.sd_px;
      if (!one.reference.empty()) line["reference"] = one.reference;
      if (is_rectification_target(one.kind)) add_target(line, one);
    }
    text += line.dump() + "\n";
  }
  return text;
}

}  // namespace ols::calibration
