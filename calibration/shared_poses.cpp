#include "calibration/shared_poses.h"

#include <map>
#include <string>
#include <tuple>

namespace ols::calibration {
namespace {

bool same_place(const AxisReading& a, const AxisReading& b) {
  return a.counts == b.counts && a.approach == b.approach;
}

// Of one station: by its number, or by the time and where the unit stood.
using Stop = std::tuple<std::size_t, std::int64_t, std::int64_t, double, double, int, int>;

std::optional<Stop> stop_of(const Observation& one) {
  if (one.kind == Kind::kInclinometer) return std::nullopt;
  if (one.pose) return Stop(one.station, *one.pose, 0, 0.0, 0.0, 0, 0);
  if (one.utime_us == 0) return std::nullopt;
  const AxisReading &pan = one.reading.pan, &tilt = one.reading.tilt;
  return Stop(one.station, 0, one.utime_us, pan.counts, tilt.counts, pan.approach, tilt.approach);
}

}  // namespace

SharedPoses::SharedPoses(const std::vector<Observation>& observations)
    : poses_(observations.size()) {
  std::map<Stop, std::vector<std::size_t>> stops;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const auto stop = stop_of(observations[i]);
    if (!stop) continue;
    std::vector<std::size_t>& same = stops[*stop];
    same.push_back(i);
    const UnitReading &here = observations[i].reading, &there = observations[same[0]].reading;
    if (same_place(here.pan, there.pan) && same_place(here.tilt, there.tilt)) continue;
    throw ObservationRefused(
        i, "pose",
        std::to_string(*observations[i].pose) + " is another stop already, at other counts",
        same[0]);
  }
  for (const auto& [stop, same] : stops) {
    if (same.size() == 1) continue;
    if (stations_.size() == kMostSharedPoses) {
      throw ObservationRefused(
          same[0], "pose",
          "is one too many: at most " + std::to_string(kMostSharedPoses) +
              " stops with several sightings each can be adjusted together (its memory grows with "
              "their square); leave some of them out");
    }
    for (const std::size_t i : same) poses_[i] = stations_.size();
    stations_.push_back(std::get<0>(stop));
  }
}

}  // namespace ols::calibration
