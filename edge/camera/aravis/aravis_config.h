// The configuration of a GigE Vision camera. Pure.
#pragma once

#include <string>

#include "edge/camera/auto_exposure.h"
#include "edge/camera/camera_config.h"
#include "edge/camera/exposure.h"
#include "edge/camera/frame_clock.h"

namespace ols::camera {

struct AravisConfig : CameraConfig {
  std::string device;  // Aravis id (vendor-serial, user name, MAC) or IPv4 address

  // The edge that triggers if `trigger` is a line: rising-edge, falling-edge or any-edge.
  std::string trigger_activation = "rising-edge";
  double trigger_delay_us = 0.0;  // time from the trigger to the start of the exposure

  double exposure_us = 5000.0;
  double gain_dB = 0.0;
  // If true, automatic exposure starts from exposure_us and gain_dB. It stays within `limits` and
  // within the camera's own limits. The maximum exposure limits the motion blur.
  bool auto_exposure = false;
  ExposureLimits limits{
      .exposure_min_us = 50.0, .exposure_max_us = 5000.0, .gain_min_dB = 0.0, .gain_max_dB = 24.0};
  AutoExposureConfig auto_levels;

  StampAt stamp_at = StampAt::kExposureStart;
  // Time from the end of the exposure to the arrival of the frame's first packet. It is needed only
  // while the camera's clock cannot be read: the mid-exposure time is then computed from the
  // arrival.
  double readout_s = 0.010;
  double readout_sd_s = 0.010;

  // "off", "slave" or "auto": whether the camera's clock follows a PTP master.
  std::string ptp = "off";
  int tai_minus_utc_s = 37;  // TAI minus UTC; used if the kernel does not know it
  double ptp_sd_s = 1e-5;    // 1-sigma of the master's time and of the network path to the master

  // If no frame comes for this time plus two frame periods, the camera is closed and reopened.
  double no_frame_timeout_s = 1.0;
  double retry_s = 0.5;  // pause between attempts to open the camera

  // [byte] size of the stream's IP packets; 0 for the largest size that the network path allows.
  int packet_size = 0;
  // If true, packets are received through the kernel's ring buffer; this needs the capability
  // CAP_NET_RAW. If false, an ordinary socket receives them. The socket loses no packets as long as
  // the camera spreads them over time (packet_delay_us), or the socket's buffer is large.
  bool packet_socket = false;
  int socket_buffer = 8 << 20;  // [byte] requested; the kernel grants up to net.core.rmem_max
  // The time from the start of a packet to the start of the next one. If -1, it is chosen
  // automatically. The automatic choice is no delay if the socket's buffer holds three frames.
  // Otherwise, the packets of a frame are spread over the share packet_spread of the frame period.
  double packet_delay_us = -1.0;
  double packet_spread = 0.6;
  bool packet_resend = true;  // request lost packets again if the camera can repeat them

  bool keep_raw = false;  // also keep the camera's raw image
};

config::Section aravis_section(AravisConfig& config);  // the section [camera]

}  // namespace ols::camera
