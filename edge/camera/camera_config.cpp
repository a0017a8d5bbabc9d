#include "edge/camera/camera_config.h"

#include <array>
#include <utility>

namespace ols {
namespace {

constexpr std::array<std::pair<const char*, TriggerMode>, 7> kTriggers{{
    {"fixed-rate", TriggerMode::kFixedRate},
    {"free-run", TriggerMode::kFreeRun},
    {"software", TriggerMode::kSoftware},
    {"line1", TriggerMode::kLine1},
    {"line2", TriggerMode::kLine2},
    {"line3", TriggerMode::kLine3},
    {"line4", TriggerMode::kLine4},
}};

void read_trigger(ConfigTable& table, CameraConfig& c) {
  std::vector<std::string> names;
  for (const auto& [name, mode] : kTriggers) names.emplace_back(name);
  const std::string chosen = table.choice("trigger", names.front(), names);
  for (const auto& [name, mode] : kTriggers)
    if (chosen == name) c.trigger = mode;
  c.trigger_activation = table.choice("trigger_activation", c.trigger_activation,
                                      {"rising-edge", "falling-edge", "any-edge"});
  c.trigger_delay_us = table.number("trigger_delay_us", c.trigger_delay_us, 0.0, 1e7);
}

void read_exposure(ConfigTable& table, CameraConfig& c) {
  c.exposure_us = table.number("exposure_us", c.exposure_us, 1.0, 1e7);
  c.gain_dB = table.number("gain_dB", c.gain_dB, 0.0, 60.0);
  c.auto_exposure = table.boolean("auto_exposure", c.auto_exposure);
  ExposureLimits& l = c.limits;
  l.exposure_min_us = table.number("exposure_min_us", l.exposure_min_us, 1.0, 1e7);
  l.exposure_max_us = table.number("exposure_max_us", l.exposure_max_us, 1.0, 1e7);
  l.gain_min_dB = table.number("gain_min_dB", l.gain_min_dB, 0.0, 60.0);
  l.gain_max_dB = table.number("gain_max_dB", l.gain_max_dB, 0.0, 60.0);
  if (l.exposure_max_us < l.exposure_min_us)
    throw table.error("exposure_max_us", "must not be less than exposure_min_us");
  if (l.gain_max_dB < l.gain_min_dB)
    throw table.error("gain_max_dB", "must not be less than gain_min_dB");
  c.auto_levels.bright_level =
      table.number("auto_bright_level", c.auto_levels.bright_level, 50.0, 245.0);
  c.auto_levels.mean_level = table.number("auto_mean_level", c.auto_levels.mean_level, 20.0, 200.0);
  c.auto_levels.settle_frames =
      static_cast<int>(table.integer("auto_settle_frames", c.auto_levels.settle_frames, 1, 1000));
}

void read_transport(ConfigTable& table, CameraConfig& c) {
  c.packet_size = static_cast<int>(table.integer("packet_size", c.packet_size, 0, 65535));
  if (c.packet_size != 0 && c.packet_size < 576)
    throw table.error("packet_size", "must be 0 (automatic) or 576..65535");
  c.packet_socket = table.boolean("packet_socket", c.packet_socket);
  c.socket_buffer =
      static_cast<int>(table.integer("socket_buffer", c.socket_buffer, 65536, 1 << 30));
  c.packet_delay_us = table.number("packet_delay_us", c.packet_delay_us, -1.0, 1e6);
  if (c.packet_delay_us < 0.0 && c.packet_delay_us != -1.0)
    throw table.error("packet_delay_us", "must be -1 (automatic) or 0..1e6");
  c.packet_spread = table.number("packet_spread", c.packet_spread, 0.05, 0.9);
  c.packet_resend = table.boolean("packet_resend", c.packet_resend);
  c.buffers = static_cast<int>(table.integer("buffers", c.buffers, 3, 100));
}

}  // namespace

bool is_timed(TriggerMode trigger) {
  return trigger == TriggerMode::kFixedRate || trigger == TriggerMode::kFreeRun;
}

CameraConfig read_camera_config(ConfigTable& table) {
  CameraConfig c;
  c.device = table.required_text("device");
  if (c.device.empty()) throw table.error("device", "must not be empty");
  // GigE Vision carries sizes in 32 bits; no sensor of ours comes near these.
  c.width_px = static_cast<int>(table.integer("width_px", c.width_px, 16, 16384));
  c.height_px = static_cast<int>(table.integer("height_px", c.height_px, 16, 16384));
  c.pixel_format =
      table.choice("pixel_format", c.pixel_format,
                   {"Mono8", "BayerRG8", "BayerGR8", "BayerGB8", "BayerBG8", "RGB8", "BGR8"});
  c.frame_rate_hz = table.number("frame_rate_hz", c.frame_rate_hz, 0.1, 1000.0);
  read_trigger(table, c);
  read_exposure(table, c);
  const std::string stamp_at =
      table.choice("stamp_at", "exposure-start", {"exposure-start", "exposure-end"});
  c.stamp_at = stamp_at == "exposure-start" ? StampAt::kExposureStart : StampAt::kExposureEnd;
  c.readout_s = table.number("readout_s", c.readout_s, 0.0, 1.0);
  c.readout_sd_s = table.number("readout_sd_s", c.readout_sd_s, 1e-6, 1.0);
  c.ptp = table.choice("ptp", c.ptp, {"off", "slave", "auto"});
  c.tai_minus_utc_s = static_cast<int>(table.integer("tai_minus_utc_s", c.tai_minus_utc_s, 30, 60));
  c.ptp_sd_s = table.number("ptp_sd_s", c.ptp_sd_s, 1e-9, 1.0);
  c.no_frame_timeout_s = table.number("no_frame_timeout_s", c.no_frame_timeout_s, 0.1, 60.0);
  c.retry_s = table.number("retry_s", c.retry_s, 0.01, 60.0);
  read_transport(table, c);
  return c;
}

}  // namespace ols
