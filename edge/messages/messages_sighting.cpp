#include "edge/messages/messages_sighting.h"

namespace ols::station {

void fill_sighting(const Sighting& sighting, ols_msg::sighting_t& message) {
  const Bearing& bearing = sighting.bearing;
  const ExposedCounts& counts = sighting.counts;
  message.track_id = bearing.track_id;
  message.belief = bearing.belief;
  message.pan_counts = counts.pan;
  message.tilt_counts = counts.tilt;
  message.pan_counts_s = counts.pan_s;
  message.tilt_counts_s = counts.tilt_s;
  message.approach_pan = static_cast<std::int8_t>(counts.approach.pan);
  message.approach_tilt = static_cast<std::int8_t>(counts.approach.tilt);
  message.pan_count_rad = counts.count.pan_rad;
  message.tilt_count_rad = counts.count.tilt_rad;
  message.x_px = bearing.pixel.x();
  message.y_px = bearing.pixel.y();
  message.covariance_px2[0] = bearing.covariance_px2(0, 0);
  message.covariance_px2[1] = bearing.covariance_px2(0, 1);
  message.covariance_px2[2] = bearing.covariance_px2(1, 1);
  message.designation_sd_px = bearing.designation_sd_px;
}

}  // namespace ols::station
