#include "edge/camera/camera_config.h"

namespace ols {

CameraConfig read_camera_config(ConfigTable& table) {
  CameraConfig c;
  c.device = table.required_text("device");
  if (c.device.empty()) throw table.error("device", "must not be empty");
  // GigE Vision carries sizes in 32 bits; no sensor of ours comes near these.
  c.width_px = static_cast<int>(table.integer("width_px", c.width_px, 16, 16384));
  c.height_px = static_cast<int>(table.integer("height_px", c.height_px, 16, 16384));
  c.pixel_format = table.choice("pixel_format", c.pixel_format,
                                {"Mono8", "BayerRG8", "BayerGR8", "BayerGB8", "BayerBG8"});
  c.frame_rate_hz = table.number("frame_rate_hz", c.frame_rate_hz, 0.1, 1000.0);
  c.exposure_us = table.number("exposure_us", c.exposure_us, 1.0, 1e7);
  const std::string stamp_at =
      table.choice("stamp_at", "exposure-start", {"exposure-start", "exposure-end"});
  c.stamp_at = stamp_at == "exposure-start" ? StampAt::kExposureStart : StampAt::kExposureEnd;
  c.readout_s = table.number("readout_s", c.readout_s, 0.0, 1.0);
  c.readout_sd_s = table.number("readout_sd_s", c.readout_sd_s, 1e-6, 1.0);
  c.no_frame_timeout_s = table.number("no_frame_timeout_s", c.no_frame_timeout_s, 0.1, 60.0);
  c.retry_s = table.number("retry_s", c.retry_s, 0.01, 60.0);
  c.packet_size = static_cast<int>(table.integer("packet_size", c.packet_size, 0, 65535));
  if (c.packet_size != 0 && c.packet_size < 576)
    throw table.error("packet_size", "must be 0 (automatic) or 576..65535");
  c.packet_socket = table.boolean("packet_socket", c.packet_socket);
  c.socket_buffer =
      static_cast<int>(table.integer("socket_buffer", c.socket_buffer, 65536, 1 << 30));
  c.packet_resend = table.boolean("packet_resend", c.packet_resend);
  c.buffers = static_cast<int>(table.integer("buffers", c.buffers, 3, 100));
  return c;
}

}  // namespace ols
