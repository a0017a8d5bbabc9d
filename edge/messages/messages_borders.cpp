#include "edge/messages/messages_borders.h"

#include <cstdint>

namespace ols::station {

void fill_borders(const std::vector<Border>& borders, ols_msg::station_status_t& message) {
  using M = ols_msg::station_status_t;
  for (const Border& border : borders) {
    // By value: lcm-gen declares its constants without defining them.
    const std::int8_t kind = border.is_keep_out ? +M::BORDER_KEEP_OUT : +M::BORDER_TRAVEL;
    message.border_kind.push_back(kind);
    for (const AzimuthElevation& point : border.outline) {
      message.border_azimuth_rad.push_back(point.azimuth_rad);
      message.border_elevation_rad.push_back(point.elevation_rad);
    }
  }
  message.borders = static_cast<std::int16_t>(message.border_kind.size());
  message.border_points = static_cast<std::int16_t>(message.border_azimuth_rad.size());
}

void fill_borders(ChainParameters chain, const StationReport& report,
                  ols_msg::station_status_t& message) {
  chain.tilt_x_rad = report.snapshot.pose.tilt_x_rad;
  chain.tilt_y_rad = report.snapshot.pose.tilt_y_rad;
  fill_borders(borders(chain, report.limits, report.limits_known), message);
}

}  // namespace ols::station
