#include "central/fusion/track_intake.h"

#include <optional>

namespace ols::fusion {

namespace {

// A tracklet that no track explains may be anything, so its offset says nothing about the pose.
void report(const BearingMeasurement& measurement, const TrackManager& tracks, bool believed,
            PointingMonitor& pointing, Associated& associated) {
  if (associated.result.kind == Association::Kind::kAmbiguous) return;
  associated.explained = associated.result.kind == Association::Kind::kTrack;
  if (associated.explained || !measurement.is_tracklet) {
    std::optional<Eigen::Vector2d> off_rad;
    if (!associated.explained) off_rad = tracks.off_nearest(measurement);
    pointing.hear(measurement.station, measurement.utime_us, associated.explained, off_rad);
  }
  associated.quarantined = !pointing.quarantine(measurement.station).empty();
  associated.newly_so = believed && associated.quarantined;
}

}  // namespace

std::vector<Associated> associate(std::span<const BearingMeasurement> image, TrackManager& tracks,
                                  PointingMonitor& pointing) {
  const bool believed = pointing.quarantine(image.front().station).empty();
  std::vector<Associated> all;
  for (const Association& result : tracks.add(image, believed)) {
    Associated associated{.result = result};
    report(image[all.size()], tracks, believed, pointing, associated);
    all.push_back(associated);
  }
  return all;
}

}  // namespace ols::fusion
