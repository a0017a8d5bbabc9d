#include "edge/camera/aravis/aravis_setup.h"

#include <arv.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "conditions/alarms.h"
#include "edge/camera/aravis/aravis_error.h"
#include "edge/camera/aravis/aravis_features.h"
#include "edge/camera/aravis/packet_plan.h"
#include "edge/camera/picture.h"

namespace ols::camera {
namespace {

constexpr int kMaxPacket = 65000;            // [byte] IPv4 carries 65535
constexpr double kExposureTolerance = 0.05;  // share; cameras round to their line time
constexpr double kFreeRun_hz = 100.0;        // maximum, of a camera that runs at its own rate

bool on_loopback(ArvDevice* device) {
  GSocketAddress* address = arv_gv_device_get_interface_address(ARV_GV_DEVICE(device));
  return g_inet_address_get_is_loopback(
             g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(address))) != 0;
}

// [byte] 0: cannot be determined.
int loopback_mtu() {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return 0;
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  const int result = ioctl(fd, SIOCGIFMTU, &request);
  close(fd);
  return result == 0 ? request.ifr_mtu : 0;
}

// [byte] The buffer that the kernel grants for such a request, as the kernel counts it.
std::size_t granted_buffer(int asked) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return 0;
  int granted = 0;
  socklen_t size = sizeof granted;
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &asked, sizeof asked);
  const int result = getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &size);
  close(fd);
  return result == 0 ? static_cast<std::size_t>(granted) : 0;
}

struct TriggerSource {
  const char* gt1290c;  // a source other than the lines; nullptr: not supported
  const char* sfnc;     // nullptr: the trigger is off
};

TriggerSource source_of(TriggerMode mode) {
  switch (mode) {
    case TriggerMode::kFixedRate:
      return {"FixedRate", nullptr};
    case TriggerMode::kFreeRun:
      return {"Freerun", nullptr};
    case TriggerMode::kSoftware:
      return {"Software", "Software"};
    case TriggerMode::kLine1:
      return {"Line1", "Line1"};
    case TriggerMode::kLine2:
      return {"Line2", "Line2"};
    case TriggerMode::kLine3:
      return {"Line3", "Line3"};
    case TriggerMode::kLine4:
      return {"Line4", "Line4"};
  }
  return {"FixedRate", nullptr};
}

bool is_line(TriggerMode mode) { return !is_timed(mode) && mode != TriggerMode::kSoftware; }

const char* activation_of(const std::string& configured) {
  if (configured == "falling-edge") return "FallingEdge";
  return configured == "any-edge" ? "AnyEdge" : "RisingEdge";
}

void check_near(double is, double wanted, const char* what, double tolerance) {
  if (std::abs(is - wanted) > tolerance)
    throw CameraUnfit(alarm::camera_has_other(std::string(what) + " " + std::to_string(is),
                                              std::to_string(wanted)));
}

void set_pace(ArvCamera* camera, const AravisConfig& config, int packet_bytes) {
  AravisError error;
  const guint payload = arv_camera_get_payload(camera, error.out());
  error.check<CameraAbsent>(alarm::camera_hides_payload());
  const double rate_hz = config.trigger == TriggerMode::kFreeRun
                             ? std::max(config.frame_rate_hz, kFreeRun_hz)
                             : config.frame_rate_hz;
  PacketPlan plan = plan_packets({.frame_bytes = payload,
                                  .packet_bytes = packet_bytes,
                                  .frame_period_s = 1.0 / rate_hz,
                                  .receive_buffer = granted_buffer(config.socket_buffer),
                                  .spread = config.packet_spread});
  // The kernel's packet ring loses nothing.
  if (config.packet_socket) plan = {};
  if (config.packet_delay_us >= 0.0) {
    const double delay_s = 1e-6 * config.packet_delay_us;
    plan = {.delay_s = delay_s, .bytes_per_second = delay_s > 0.0 ? packet_bytes / delay_s : 0.0};
  }
  // AVT's cameras have a rate in place of the standard's delay.
  const AravisFeatures features(camera);
  if (const auto bounds = features.bounds(kStreamRate)) {
    const double rate = plan.bytes_per_second > 0.0 ? plan.bytes_per_second : bounds->second;
    features.set_number(kStreamRate, std::clamp(rate, bounds->first, bounds->second));
    return;
  }
  // A camera without a time base takes no delay: it sends at full speed.
  arv_camera_gv_set_packet_delay(camera, std::llround(1e9 * plan.delay_s), error.out());
}

}  // namespace

void set_picture(ArvCamera* camera, const AravisConfig& config) {
  AravisError error;
  // By code, because names differ: RGB8 is RGB8Packed in older cameras.
  const auto wanted = static_cast<ArvPixelFormat>(*pixel_format(config.pixel_format));
  arv_camera_set_pixel_format(camera, wanted, error.out());
  error.check<CameraUnfit>(alarm::camera_refuses_format(config.pixel_format));
  const ArvPixelFormat format = arv_camera_get_pixel_format(camera, error.out());
  error.check<CameraAbsent>(alarm::camera_hides_format());
  if (format != wanted)
    throw CameraUnfit(alarm::camera_other_format(pixel_format_name(format), config.pixel_format));
  const std::string size = std::to_string(config.width_px) + "x" + std::to_string(config.height_px);
  arv_camera_set_region(camera, 0, 0, config.width_px, config.height_px, error.out());
  error.check<CameraUnfit>(alarm::camera_refuses_size(size));
  int x = 0, y = 0, width = 0, height = 0;
  arv_camera_get_region(camera, &x, &y, &width, &height, error.out());
  error.check<CameraAbsent>(alarm::camera_hides_size());
  if (width != config.width_px || height != config.height_px)
    throw CameraUnfit(alarm::camera_other_size(width, height, size));
  arv_camera_set_acquisition_mode(camera, ARV_ACQUISITION_MODE_CONTINUOUS, error.out());
  error.check<CameraUnfit>(alarm::camera_refuses_acquisition());
}

void set_trigger(ArvCamera* camera, const AravisConfig& config) {
  const AravisFeatures features(camera);
  if (features.offers("TriggerSelector", "FrameStart"))
    features.choose("TriggerSelector", "FrameStart");
  if (features.has("TriggerMode")) features.choose("TriggerMode", "Off");
  const auto [gt1290c, sfnc] = source_of(config.trigger);
  const char* source = features.offers("TriggerSource", gt1290c) ? gt1290c : sfnc;
  if (features.has(kFrameRateEnable))
    features.set_flag(kFrameRateEnable, config.trigger == TriggerMode::kFixedRate);
  if (config.trigger == TriggerMode::kFixedRate) {
    features.set_number(kFrameRate, config.frame_rate_hz);
    const double rate_hz = features.number(kFrameRate).value_or(config.frame_rate_hz);
    check_near(rate_hz, config.frame_rate_hz, "frame rate", 0.05 * config.frame_rate_hz);
  }
  if (source == nullptr) return;  // the trigger stays off
  features.choose("TriggerSource", source);
  if (is_line(config.trigger) && features.has("TriggerActivation"))
    features.choose("TriggerActivation", activation_of(config.trigger_activation));
  if (!is_timed(config.trigger) && (config.trigger_delay_us > 0.0 || features.has(kTriggerDelay)))
    features.set_number(kTriggerDelay, config.trigger_delay_us);
  features.choose("TriggerMode", "On");
}

ExposureSetting set_exposure(ArvCamera* camera, const ExposureSetting& setting) {
  const AravisFeatures features(camera);
  features.set_number(kExposureTime, setting.exposure_us);
  const auto exposure_us = features.number(kExposureTime);
  if (!exposure_us) throw CameraAbsent(alarm::camera_hides_exposure());
  if (!features.has(kGain)) return {.exposure_us = *exposure_us};
  features.set_number(kGain, setting.gain_dB);
  return {.exposure_us = *exposure_us, .gain_dB = features.number(kGain).value_or(setting.gain_dB)};
}

ExposureSetting set_first_exposure(ArvCamera* camera, const AravisConfig& config) {
  const AravisFeatures features(camera);
  for (const char* automatic : {"ExposureAuto", "GainAuto"})
    if (features.offers(automatic, "Off")) features.choose(automatic, "Off");
  const ExposureSetting made =
      set_exposure(camera, {.exposure_us = config.exposure_us, .gain_dB = config.gain_dB});
  check_near(made.exposure_us, config.exposure_us, "exposure [us]",
             kExposureTolerance * config.exposure_us);
  return made;
}

ExposureLimits exposure_limits(ArvCamera* camera, const ExposureLimits& configured) {
  const AravisFeatures features(camera);
  ExposureLimits limits = configured;
  if (const auto bounds = features.bounds(kExposureTime)) {
    limits.exposure_min_us = std::clamp(limits.exposure_min_us, bounds->first, bounds->second);
    limits.exposure_max_us = std::clamp(limits.exposure_max_us, bounds->first, bounds->second);
  }
  const auto gain = features.bounds(kGain).value_or(std::pair{0.0, 0.0});
  limits.gain_min_dB = std::clamp(limits.gain_min_dB, gain.first, gain.second);
  limits.gain_max_dB = std::clamp(limits.gain_max_dB, gain.first, gain.second);
  return limits;
}

void set_ptp(ArvCamera* camera, const AravisConfig& config) {
  const AravisFeatures features(camera);
  const bool on = config.ptp != "off";
  if (features.has(kPtpMode)) {
    features.choose(kPtpMode.names[0], !on ? "Off" : config.ptp == "slave" ? "Slave" : "Auto");
  } else if (features.has(kPtpEnable)) {
    features.set_flag(kPtpEnable, on);
  } else if (on) {
    throw CameraUnfit(alarm::camera_has_no("PTP"));
  }
}

void set_transport(ArvCamera* camera, const AravisConfig& config) {
  AravisError error;
  ArvDevice* device = arv_camera_get_device(camera);
  arv_camera_gv_set_stream_options(camera, config.packet_socket
                                               ? ARV_GV_STREAM_OPTION_NONE
                                               : ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  int packet_size = config.packet_size;
  // On a direct link the interface's own limit is the path's.
  if (packet_size == 0 && on_loopback(device)) packet_size = std::min(loopback_mtu(), kMaxPacket);
  arv_camera_gv_set_packet_size_adjustment(camera, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  if (packet_size != 0) {
    arv_camera_gv_set_packet_size(camera, packet_size, error.out());
    error.check<CameraUnfit>(alarm::camera_refuses_packets(packet_size));
  } else {
    // By test packets. A camera that does not support them keeps its size.
    arv_camera_gv_auto_packet_size(camera, error.out());
  }
  const guint size = arv_camera_gv_get_packet_size(camera, error.out());
  error.check<CameraAbsent>(alarm::camera_hides_packet_size());
  set_pace(camera, config, static_cast<int>(size));
}

}  // namespace ols::camera
