// What the station's camera is and how it shall run.
#pragma once

#include <string>

#include "base/toml_config.h"

namespace ols {

// The instant of the exposure that the camera's time stamp marks; differs by model.
enum class StampAt { kExposureStart, kExposureEnd };

struct CameraConfig {
  std::string device;  // Aravis id (vendor-serial, user name, MAC) or IPv4 address
  int width_px = 1280;
  int height_px = 960;
  std::string pixel_format = "Mono8";  // or BayerRG8, BayerGR8, BayerGB8, BayerBG8
  double frame_rate_hz = 15.0;
  double exposure_us = 5000.0;
  StampAt stamp_at = StampAt::kExposureStart;

  // From the end of the exposure to the arrival of the frame's first packet. Only used as long as
  // the camera's clock cannot be read: then it is what the mid-exposure time hangs on.
  double readout_s = 0.010;
  double readout_sd_s = 0.010;

  // As long without a frame, and two frame periods: closed and opened again.
  double no_frame_timeout_s = 1.0;
  double retry_s = 0.5;  // between attempts to open

  int packet_size = 0;          // [byte] IP packet of the stream; 0: what the path allows
  bool packet_socket = true;    // ring buffer of the kernel where CAP_NET_RAW allows it
  int socket_buffer = 8 << 20;  // [byte] asked for; the kernel gives up to net.core.rmem_max
  bool packet_resend = true;    // ask again for lost packets where the camera can
  int buffers = 8;              // frames between the network and the station
};

// Reads and checks the table; throws ConfigError.
CameraConfig read_camera_config(ConfigTable& table);

}  // namespace ols
