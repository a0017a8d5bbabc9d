#include "central/fusion/track_intake.h"

#include <optional>

namespace ols::fusion {

Associated associate(const BearingMeasurement& measurement, TrackManager& tracks,
                     PointingMonitor& pointing) {
  const bool believed = pointing.quarantine(measurement.station).empty();
  Associated associated{.result = tracks.add(measurement, believed)};
  if (associated.result.kind == Association::Kind::kAmbiguous) return associated;
  associated.explained = associated.result.kind == Association::Kind::kTrack;
  std::optional<Eigen::Vector2d> off_rad;
  if (!associated.explained) off_rad = tracks.off_nearest(measurement);
  pointing.hear(measurement.station, measurement.utime_us, associated.explained, off_rad);
  associated.quarantined = !pointing.quarantine(measurement.station).empty();
  associated.newly_so = believed && associated.quarantined;
  return associated;
}

}  // namespace ols::fusion
