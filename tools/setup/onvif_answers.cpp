#include "tools/setup/onvif_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/config/toml_text.h"
#include "edge/camera/rtsp/rtsp_config.h"
#include "tools/setup/plan.h"

namespace ols::setup {
namespace {

bool is_onvif_mount(const Values& values) {
  const std::string* kind = find(values, "station.mount.kind");
  return kind != nullptr && *kind == toml_text("onvif");
}

void add_number(Values& values, const std::string& key, double number) {
  if (number != 0.0 && find(values, key) == nullptr)
    values.emplace_back(key, fmt::format("{}", number));
}

// Generic spaces reach from -1 to 1; wider ones are in degrees. `whole`: at 1 of a generic one.
double scale(const std::optional<mount::Space>& space, mount::Span mount::Space::*axis,
             double whole) {
  constexpr double kGeneric = 2.0;
  if (!space) return whole;
  const mount::Span& span = (*space).*axis;
  const double greatest = std::max(std::abs(span.min), std::abs(span.max));
  return greatest > kGeneric ? 1.0 : whole / greatest;
}

void add_login(Values& values, const std::string& device, const std::string& url,
               const OnvifLogin& login) {
  const bool is_secure = url.starts_with("https:") || url.starts_with("rtsps:");
  if (is_secure && !login.pinned_key.empty()) add(values, device + ".pinned_key", login.pinned_key);
  if (login.user.empty()) return;
  add(values, device + ".user", login.user);
  add(values, device + ".password_file", login.password_file);
}

void add_mount(Values& values, const std::string& url, const onvif::Offer::Stream& stream) {
  const onvif::PtzOptions& can = *stream.ptz;
  add(values, "station.mount.kind", "onvif");
  add(values, "station.mount.url", url);
  add(values, "station.mount.profile", stream.profile.token);
  // By the standard, pan counts to the right.
  constexpr double kPan_deg = 180.0, kTilt_deg = 90.0, kPan_deg_s = 60.0, kTilt_deg_s = 40.0;
  using mount::Space;
  add_number(values, "station.mount.pan_gain_deg", -scale(can.absolute, &Space::x, kPan_deg));
  add_number(values, "station.mount.tilt_gain_deg", scale(can.absolute, &Space::y, kTilt_deg));
  add_number(values, "station.mount.pan_speed_deg_s",
             -scale(can.continuous, &Space::x, kPan_deg_s));
  add_number(values, "station.mount.tilt_speed_deg_s",
             scale(can.continuous, &Space::y, kTilt_deg_s));
}

}  // namespace

std::string words_of(const onvif::Offer::Stream& stream) {
  const onvif::Profile& profile = stream.profile;
  std::string text = profile.token + ":";
  if (!profile.encoding.empty()) text += " " + profile.encoding + ",";
  if (profile.width_px > 0) text += fmt::format(" {} x {},", profile.width_px, profile.height_px);
  if (profile.frame_rate_hz > 0.0) text += fmt::format(" {} Hz,", profile.frame_rate_hz);
  return text + (stream.ptz ? " turns" : " does not turn");
}

void add_onvif(Values& values, const std::string& url, const onvif::Offer::Stream& stream,
               const OnvifLogin& login) {
  if (!has_camera(values)) {
    add(values, "station.camera.kind", "rtsp");
    add(values, "station.camera.url", camera::without_password(stream.url));
    add_number(values, "station.camera.width_px", stream.profile.width_px);
    add_number(values, "station.camera.height_px", stream.profile.height_px);
    add_number(values, "station.camera.frame_rate_hz", stream.profile.frame_rate_hz);
    add_login(values, "station.camera", stream.url, login);
  }
  const bool wanted = is_onvif_mount(values);
  if (has_mount(values) && !wanted) return;
  if (wanted && !stream.ptz)
    throw std::runtime_error("the ONVIF camera at " + url + " does not turn");
  if (stream.ptz) {
    add_mount(values, url, stream);
    add_login(values, "station.mount", url, login);
  } else {
    add(values, "station.mount.kind", "fixed");
  }
}

}  // namespace ols::setup
