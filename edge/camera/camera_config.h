// What the station's camera is and how it shall run.
#pragma once

#include <string>

#include "edge/camera/auto_exposure.h"
#include "edge/camera/exposure.h"

namespace ols::config {
struct Section;
}
namespace ols::camera {

// The instant of the exposure that the camera's time stamp marks; differs by model.
enum class StampAt { kExposureStart, kExposureEnd };

// What makes the camera expose.
enum class TriggerMode {
  kFixedRate,  // its own timer, at frame_rate_hz
  kFreeRun,    // itself, as fast as it can
  kSoftware,   // AravisCamera::trigger()
  kLine1,      // a pulse on one of its lines
  kLine2,
  kLine3,
  kLine4,
};

struct CameraConfig {
  std::string device;  // Aravis id (vendor-serial, user name, MAC) or IPv4 address
  int width_px = 1280;
  int height_px = 960;
  std::string pixel_format = "Mono8";  // or Bayer{RG,GR,GB,BG}8, RGB8, BGR8
  double frame_rate_hz = 15.0;         // with a trigger: the greatest that is expected

  TriggerMode trigger = TriggerMode::kFixedRate;
  std::string trigger_activation = "rising-edge";  // of a line; or falling-edge, any-edge
  double trigger_delay_us = 0.0;                   // from the trigger to the exposure

  double exposure_us = 5000.0;
  double gain_dB = 0.0;
  // Automatic exposure begins with the two above and keeps to the limits below, and to the camera's
  // own. The greatest exposure is what the motion blur allows.
  bool auto_exposure = false;
  ExposureLimits limits{
      .exposure_min_us = 50.0, .exposure_max_us = 5000.0, .gain_min_dB = 0.0, .gain_max_dB = 24.0};
  AutoExposureConfig auto_levels;

  StampAt stamp_at = StampAt::kExposureStart;
  // From the end of the exposure to the arrival of the frame's first packet. Only used as long as
  // the camera's clock cannot be read: then it is what the mid-exposure time hangs on.
  double readout_s = 0.010;
  double readout_sd_s = 0.010;

  std::string ptp = "off";   // or slave, auto: the camera's clock follows a PTP master
  int tai_minus_utc_s = 37;  // leap seconds, where the kernel does not know them
  double ptp_sd_s = 1e-5;    // 1-sigma of the master and the way to it

  // As long without a frame, and two frame periods: closed and opened again.
  double no_frame_timeout_s = 1.0;
  double retry_s = 0.5;  // between attempts to open

  int packet_size = 0;  // [byte] IP packet of the stream; 0: what the path allows
  // The kernel's ring buffer where CAP_NET_RAW allows it. Without, the station's capabilities can
  // be dropped, and nothing is lost as long as the packets are paced or the buffer is large.
  bool packet_socket = false;
  int socket_buffer = 8 << 20;  // [byte] asked for; the kernel gives up to net.core.rmem_max
  // Between two packets. -1: automatic, none when the socket's buffer holds some frames, otherwise
  // such that a frame takes packet_spread of the frame period.
  double packet_delay_us = -1.0;
  double packet_spread = 0.6;
  bool packet_resend = true;  // ask again for lost packets where the camera can

  bool keep_raw = false;  // beside the gray picture, what the camera sent: for a recorder
};

// Whether it exposes by itself.
bool is_timed(TriggerMode trigger);

config::Section camera_section(CameraConfig& config);  // [camera]

}  // namespace ols::camera
