// What a station's configuration amounts to, in words (--check-config).

#include "conditions/printed.h"
#include "edge/config/config.h"
#include "geometry/angles.h"

namespace ols::station {
namespace {

std::string position_words(const StationSettings& settings) {
  const auto& surveyed = settings.pose.surveyed_position;
  const bool checked = settings.gnss->is_configured();
  if (!surveyed) return "position from GNSS";
  return printed("position %.7f %.7f %.2f m surveyed%s", degrees(surveyed->latitude_rad),
                 degrees(surveyed->longitude_rad), surveyed->height_m,
                 checked ? ", checked by GNSS" : "");
}

std::string tilt_words(const StationSettings& settings) {
  const auto& surveyed = settings.pose.surveyed_tilt_rad;
  const bool sensor = settings.inclinometer->is_configured();
  if (surveyed) {
    return printed("tilt %.4f %.4f deg surveyed%s", degrees(surveyed->x()), degrees(surveyed->y()),
                   sensor ? ", checked by the inclinometer" : "");
  }
  if (sensor) return "tilt from the inclinometer";
  return printed("tilt unknown: taken as level to %.1f deg", degrees(settings.pose.level_sd_rad));
}

}  // namespace

std::vector<std::string> describe(const StationSettings& s) {
  std::vector<std::string> lines;
  lines.push_back("station: " + s.id + ", bus " + s.lcm_url);
  lines.push_back("pose: " + position_words(s) + "; " + tilt_words(s) +
                  printed("; heading %.3f deg", degrees(s.station.geometry.chain.heading_rad)));
  const camera::CameraConfig& camera = s.camera->config();
  lines.push_back("camera: " + s.camera->address() +
                  printed(", %dx%d ", camera.width_px, camera.height_px) + camera.pixel_format +
                  printed(" at %.1f Hz", camera.frame_rate_hz));
  lines.push_back("ptu: " + s.mount->words());
  if (s.inclinometer->is_configured())
    lines.push_back("inclinometer: " + s.inclinometer->address());
  if (s.gnss->is_configured()) lines.push_back("gnss: " + s.gnss->address());
  if (!s.gpio.chip.empty()) {
    lines.push_back("gpio: " + s.gpio.chip +
                    (s.gpio.has_stop() ? printed(", emergency stop on line %d", s.gpio.stop_line)
                                       : std::string(", no emergency stop")));
  }
  if (!s.video.address.empty()) lines.push_back("video: on " + s.video.address);
  if (!s.recorder.folder.empty()) lines.push_back("recorder: " + s.recorder.folder);
  return lines;
}

}  // namespace ols::station
