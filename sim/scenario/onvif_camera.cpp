#include "sim/scenario/onvif_camera.h"

namespace ols::sim {

std::string stream_address(const StationScenario& station) {
  return "rtsp://" + station.camera_address + ":8554/video";
}

OnvifConfig onvif_config(const Scenario& s, const StationScenario& station) {
  OnvifConfig c;
  c.address = station.camera_address;
  c.port = s.onvif.port;
  c.serial = station.id;
  c.stream_uri = stream_address(station);
  c.width_px = s.camera.width_px;
  c.height_px = s.camera.height_px;
  c.frame_rate_hz = s.frame_rate_hz;
  c.unit.max_speed_rad_s = s.onvif.max_speed_rad_s;
  c.unit.acceleration_rad_s2 = s.onvif.acceleration_rad_s2;
  c.unit.command_delay_s = s.onvif.command_delay_s;
  c.unit.repeatability_rad = s.onvif.repeatability_rad;
  c.unit.boot_s = s.onvif.boot_s;
  return c;
}

}  // namespace ols::sim
