#include "edge/camera/aravis_device.h"

#include <arv.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>

#include "base/clocks.h"

namespace ols {
namespace {

// GigE Vision bootstrap registers.
constexpr guint64 kTimestampControl = 0x0944;
constexpr guint64 kTimestampHigh = 0x0948;
constexpr guint64 kTimestampLow = 0x094c;
constexpr guint32 kTimestampLatch = 2;

constexpr int kMaxPacket = 65000;  // [byte] IPv4 carries 65535

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kExposureTolerance =
    0.05;  // of what was asked for; cameras round to their line time

class Error {
 public:
  ~Error() { clear(); }
  GError** out() {
    clear();
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const { return error_ != nullptr ? error_->message : "unknown error"; }
  template <typename Exception>
  void check(const std::string& what) const {
    if (error_ != nullptr) throw Exception(what + ": " + error_->message);
  }

 private:
  void clear() { g_clear_error(&error_); }
  GError* error_ = nullptr;
};

// As Aravis does it for a frame's stamp, so that both are on the same line.
std::int64_t ticks_to_ns(std::uint64_t ticks, std::uint64_t hz) {
  constexpr auto kNs = static_cast<std::uint64_t>(kSecond_ns);
  return static_cast<std::int64_t>(ticks / hz * kNs + ticks % hz * kNs / hz);
}

bool has_feature(ArvCamera* camera, const char* name) {
  Error error;
  return arv_camera_is_feature_available(camera, name, error.out()) != 0;
}

bool on_loopback(ArvDevice* device) {
  GSocketAddress* address = arv_gv_device_get_interface_address(ARV_GV_DEVICE(device));
  return g_inet_address_get_is_loopback(
             g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(address))) != 0;
}

// [byte] 0 when it cannot be found out.
int loopback_mtu() {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return 0;
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  const int result = ioctl(fd, SIOCGIFMTU, &request);
  close(fd);
  return result == 0 ? request.ifr_mtu : 0;
}

}  // namespace

void Unref::operator()(void* object) const { g_object_unref(object); }

AravisDevice::BufferReturn::~BufferReturn() { arv_stream_push_buffer(stream, buffer); }

AravisDevice::AravisDevice(const CameraConfig& config) {
  Error error;
  camera_.reset(arv_camera_new(config.device.c_str(), error.out()));
  if (camera_ == nullptr)
    throw CameraAbsent("camera " + config.device + " does not answer: " + error.text());
  if (arv_camera_is_gv_device(camera_.get()) == 0)
    throw CameraUnfit("camera " + config.device + " is not a GigE Vision camera");
  // Aravis goes on without control, and then every setting is refused.
  if (arv_gv_device_is_controller(ARV_GV_DEVICE(device())) == 0)
    throw CameraAbsent("camera is under the control of another, or still of the last connection");
  g_signal_connect(device(), "control-lost",
                   G_CALLBACK(+[](ArvDevice*, std::atomic<bool>* lost) { *lost = true; }),
                   &control_lost_);
  // A camera that its last master left streaming accepts no settings.
  arv_camera_stop_acquisition(camera_.get(), Error().out());
  configure(config);
  set_transport(config);
  start(config);
}

AravisDevice::~AravisDevice() {
  if (camera_ == nullptr) return;
  g_signal_handlers_disconnect_by_data(device(), &control_lost_);
  if (!gone_ && !control_lost_) arv_camera_stop_acquisition(camera_.get(), Error().out());
}

ArvDevice* AravisDevice::device() const { return arv_camera_get_device(camera_.get()); }

void AravisDevice::configure(const CameraConfig& config) {
  ArvCamera* camera = camera_.get();
  Error error;
  arv_camera_set_pixel_format_from_string(camera, config.pixel_format.c_str(), error.out());
  error.check<CameraUnfit>("camera refuses pixel format " + config.pixel_format);
  // Some take a value without a word and keep their own.
  const char* format = arv_camera_get_pixel_format_as_string(camera, error.out());
  error.check<CameraAbsent>("camera does not tell its pixel format");
  if (format == nullptr || config.pixel_format != format)
    throw CameraUnfit("camera wants pixel format " + std::string(format ? format : "unknown") +
                      " instead of " + config.pixel_format);
  const std::string size = std::to_string(config.width_px) + "x" + std::to_string(config.height_px);
  arv_camera_set_region(camera, 0, 0, config.width_px, config.height_px, error.out());
  error.check<CameraUnfit>("camera refuses size " + size);
  int x = 0, y = 0, width = 0, height = 0;
  arv_camera_get_region(camera, &x, &y, &width, &height, error.out());
  error.check<CameraAbsent>("camera does not tell its size");
  if (width != config.width_px || height != config.height_px)
    throw CameraUnfit("camera has size " + std::to_string(width) + "x" + std::to_string(height) +
                      " instead of " + size);
  arv_camera_set_acquisition_mode(camera, ARV_ACQUISITION_MODE_CONTINUOUS, error.out());
  error.check<CameraUnfit>("camera refuses continuous acquisition");
  arv_camera_set_frame_rate(camera, config.frame_rate_hz, error.out());
  error.check<CameraUnfit>("camera refuses the frame rate");
  if (arv_camera_is_exposure_auto_available(camera, error.out()) != 0)
    arv_camera_set_exposure_time_auto(camera, ARV_AUTO_OFF, error.out());
  arv_camera_set_exposure_time(camera, config.exposure_us, error.out());
  error.check<CameraUnfit>("camera refuses the exposure");
  const double exposure_us = arv_camera_get_exposure_time(camera, error.out());
  error.check<CameraAbsent>("camera does not tell its exposure");
  if (std::abs(exposure_us - config.exposure_us) > kExposureTolerance * config.exposure_us)
    throw CameraUnfit("camera exposes for " + std::to_string(exposure_us) + " us instead of " +
                      std::to_string(config.exposure_us));
  exposure_s_ = 1e-6 * exposure_us;
}

void AravisDevice::set_transport(const CameraConfig& config) {
  Error error;
  arv_camera_gv_set_stream_options(
      camera_.get(), config.packet_socket ? ARV_GV_STREAM_OPTION_NONE
                                          : ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  int packet_size = config.packet_size;
  // Where no link lies between, the interface's own limit is the path's.
  if (packet_size == 0 && on_loopback(device())) packet_size = std::min(loopback_mtu(), kMaxPacket);
  if (packet_size != 0) {
    arv_camera_gv_set_packet_size(camera_.get(), packet_size, error.out());
    error.check<CameraUnfit>("camera refuses packets of " + std::to_string(packet_size) + " bytes");
    arv_camera_gv_set_packet_size_adjustment(camera_.get(), ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  } else {
    arv_camera_gv_set_packet_size_adjustment(camera_.get(), ARV_GV_PACKET_SIZE_ADJUSTMENT_ALWAYS);
  }
  tick_hz_ = arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(device()), error.out());
  if (error) tick_hz_ = 0;
  latch_by_feature_ = has_feature(camera_.get(), "GevTimestampControlLatch") &&
                      has_feature(camera_.get(), "GevTimestampValue");
}

void AravisDevice::start(const CameraConfig& config) {
  Error error;
  stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, error.out()));
  if (stream_ == nullptr) throw CameraAbsent("camera gives no stream: " + error.text());
  g_object_set(stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED,
               "socket-buffer-size", config.socket_buffer, nullptr);
  if (!config.packet_resend)
    g_object_set(stream_.get(), "packet-resend", ARV_GV_STREAM_PACKET_RESEND_NEVER, nullptr);
  // With large packets a frame has few of them: any number of them may be asked for again.
  g_object_set(stream_.get(), "packet-request-ratio", 1.0, nullptr);
  const guint payload = arv_camera_get_payload(camera_.get(), error.out());
  error.check<CameraAbsent>("camera does not tell its payload");
  for (int i = 0; i < config.buffers; ++i)
    arv_stream_push_buffer(stream_.get(), arv_buffer_new(payload, nullptr));
  arv_camera_start_acquisition(camera_.get(), error.out());
  error.check<CameraAbsent>("camera does not start");
}

ArvBuffer* AravisDevice::pop(double timeout_s) {
  return arv_stream_timeout_pop_buffer(stream_.get(),
                                       static_cast<guint64>(std::max(0.0, timeout_s) * 1e6));
}

ReceivedFrame AravisDevice::describe(ArvBuffer* buffer) const {
  ReceivedFrame frame;
  frame.id = arv_buffer_get_frame_id(buffer);
  frame.complete = arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS &&
                   arv_buffer_get_payload_type(buffer) == ARV_BUFFER_PAYLOAD_TYPE_IMAGE;
  if (!frame.complete) return frame;
  std::size_t bytes = 0;
  const void* data = arv_buffer_get_image_data(buffer, &bytes);
  frame.picture = {.data = static_cast<const std::uint8_t*>(data),
                   .bytes = bytes,
                   .width_px = arv_buffer_get_image_width(buffer),
                   .height_px = arv_buffer_get_image_height(buffer),
                   .format = arv_buffer_get_image_pixel_format(buffer)};
  const guint64 stamp_ns = arv_buffer_get_timestamp(buffer);
  const guint64 system_ns = arv_buffer_get_system_timestamp(buffer);
  // Aravis puts the host's time in place of a camera's that has no tick frequency, without a word.
  if (tick_hz_ != 0 && stamp_ns != system_ns && stamp_ns != 0)
    frame.device_ns = static_cast<std::int64_t>(stamp_ns);
  // Aravis takes the arrival on CLOCK_REALTIME; a step since then is a matter of milliseconds.
  const double age_s =
      1e-9 * static_cast<double>(clock_utc_ns()) - 1e-9 * static_cast<double>(system_ns);
  frame.arrival_s = clock_monotonic_s() - std::clamp(age_s, 0.0, 1.0);
  return frame;
}

bool AravisDevice::command_latch() {
  Error error;
  if (!latch_by_feature_)
    return arv_device_write_register(device(), kTimestampControl, kTimestampLatch, error.out()) !=
           0;
  arv_camera_execute_command(camera_.get(), "GevTimestampControlLatch", error.out());
  return !error;
}

std::optional<std::uint64_t> AravisDevice::latched_ticks() {
  Error error;
  if (latch_by_feature_) {
    const gint64 ticks = arv_camera_get_integer(camera_.get(), "GevTimestampValue", error.out());
    if (error) return std::nullopt;
    return static_cast<std::uint64_t>(ticks);
  }
  guint32 high = 0, low = 0;
  if (arv_device_read_register(device(), kTimestampHigh, &high, error.out()) == 0 ||
      arv_device_read_register(device(), kTimestampLow, &low, error.out()) == 0)
    return std::nullopt;
  return std::uint64_t{high} << 32 | low;
}

std::optional<LatchSample> AravisDevice::latch() {
  if (tick_hz_ == 0) return std::nullopt;
  const double before_s = clock_monotonic_s();
  if (!command_latch()) return std::nullopt;
  const double after_s = clock_monotonic_s();
  const auto ticks = latched_ticks();
  // A camera without the latch leaves its register as it was.
  if (!ticks || *ticks == last_latch_ticks_) return std::nullopt;
  last_latch_ticks_ = *ticks;
  return LatchSample{
      .device_ns = ticks_to_ns(*ticks, tick_hz_), .before_s = before_s, .after_s = after_s};
}

}  // namespace ols
