#include "edge/camera/aravis/aravis_device.h"

#include <arv.h>

#include <algorithm>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/camera/aravis/aravis_error.h"
#include "edge/camera/aravis/aravis_features.h"
#include "edge/camera/aravis/aravis_setup.h"

namespace ols::camera {
namespace {

// GigE Vision bootstrap registers.
constexpr guint64 kTimestampControl = 0x0944;
constexpr guint64 kTimestampHigh = 0x0948;
constexpr guint64 kTimestampLow = 0x094c;
constexpr guint32 kTimestampLatch = 2;
constexpr guint64 kPrivilege = 0x0a00;

constexpr int kBuffers = 8;  // frames between the network and the station
constexpr std::int64_t kSecond_ns = 1'000'000'000;

// A frame with missing packets is abandoned after this; those behind it wait as long. Aravis
// requests missing packets of the last frame after 20 ms.
constexpr guint kFrameRetention_us = 50'000;

// As Aravis converts a frame's stamp, so that both are on the same line.
std::int64_t ticks_to_ns(std::uint64_t ticks, std::uint64_t hz) {
  constexpr auto kNs = static_cast<std::uint64_t>(kSecond_ns);
  return static_cast<std::int64_t>(ticks / hz * kNs + ticks % hz * kNs / hz);
}

}  // namespace

void Unref::operator()(void* object) const { g_object_unref(object); }

AravisDevice::BufferReturn::~BufferReturn() { arv_stream_push_buffer(stream, buffer); }

AravisDevice::AravisDevice(const AravisConfig& config) {
  AravisError error;
  camera_.reset(arv_camera_new(config.device.c_str(), error.out()));
  if (camera_ == nullptr) throw CameraAbsent(alarm::camera_not_found(config.device, error.text()));
  if (arv_camera_is_gv_device(camera_.get()) == 0)
    throw CameraUnfit(alarm::camera_not_gige(config.device));
  // Aravis continues without control, and then every setting is refused.
  if (arv_gv_device_is_controller(ARV_GV_DEVICE(device())) == 0)
    throw CameraAbsent(alarm::camera_controlled());
  g_signal_connect(device(), "control-lost",
                   G_CALLBACK(+[](ArvDevice*, std::atomic<bool>* lost) { *lost = true; }),
                   &control_lost_);
  // A camera that its last controller left streaming accepts no settings.
  arv_camera_stop_acquisition(camera_.get(), AravisError().out());
  set_picture(camera_.get(), config);
  limits_ = exposure_limits(camera_.get(), config.limits);
  set_trigger(camera_.get(), config);
  exposure_ = set_first_exposure(camera_.get(), config);
  set_ptp(camera_.get(), config);
  set_transport(camera_.get(), config);
  start(config);
}

AravisDevice::~AravisDevice() {
  if (camera_ == nullptr) return;
  g_signal_handlers_disconnect_by_data(device(), &control_lost_);
  if (!gone_ && !control_lost_) arv_camera_stop_acquisition(camera_.get(), AravisError().out());
}

ArvDevice* AravisDevice::device() const { return arv_camera_get_device(camera_.get()); }

std::string AravisDevice::identity() const {
  AravisError error;
  std::string words;
  for (const auto get : {arv_camera_get_vendor_name, arv_camera_get_model_name,
                         arv_camera_get_device_serial_number}) {
    const char* word = get(camera_.get(), error.out());
    if (error || word == nullptr || *word == 0) continue;
    if (!words.empty()) words.push_back(' ');
    words.append(word);
  }
  return words;
}

std::string AravisDevice::serial() const {
  AravisError error;
  const char* word = arv_camera_get_device_serial_number(camera_.get(), error.out());
  return error || word == nullptr ? std::string() : word;
}

void AravisDevice::start(const AravisConfig& config) {
  AravisError error;
  tick_hz_ = arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(device()), error.out());
  if (error) tick_hz_ = 0;
  const AravisFeatures features(camera_.get());
  latch_by_feature_ = features.has("GevTimestampControlLatch") && features.has("GevTimestampValue");
  stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, error.out()));
  if (stream_ == nullptr) throw CameraAbsent(alarm::camera_no_stream(error.text()));
  g_object_set(stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED,
               "socket-buffer-size", config.socket_buffer, "frame-retention", kFrameRetention_us,
               nullptr);
  if (!config.packet_resend)
    g_object_set(stream_.get(), "packet-resend", ARV_GV_STREAM_PACKET_RESEND_NEVER, nullptr);
  // A frame has few large packets: any number of them may be requested again.
  g_object_set(stream_.get(), "packet-request-ratio", 1.0, nullptr);
  const guint payload = arv_camera_get_payload(camera_.get(), error.out());
  error.check<CameraAbsent>(alarm::camera_hides_payload());
  for (int i = 0; i < kBuffers; ++i)
    arv_stream_push_buffer(stream_.get(), arv_buffer_new(payload, nullptr));
  arv_camera_start_acquisition(camera_.get(), error.out());
  error.check<CameraAbsent>(alarm::camera_does_not_start());
}

ArvBuffer* AravisDevice::pop(double timeout_s) {
  return arv_stream_timeout_pop_buffer(stream_.get(),
                                       static_cast<guint64>(std::max(0.0, timeout_s) * 1e6));
}

ReceivedFrame AravisDevice::describe(ArvBuffer* buffer) const {
  ReceivedFrame frame;
  gint empty = 0, waiting = 0;
  arv_stream_get_n_buffers(stream_.get(), &empty, &waiting);
  frame.id = arv_buffer_get_frame_id(buffer);
  frame.overtaken = waiting > 0;
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
  // Without a tick frequency Aravis silently substitutes the host's time for the camera's.
  if (tick_hz_ != 0 && stamp_ns != system_ns && stamp_ns != 0)
    frame.device_ns = static_cast<std::int64_t>(stamp_ns);
  // Aravis stamps the arrival on CLOCK_REALTIME; a clock step in the milliseconds since then is
  // unlikely.
  const double age_s =
      1e-9 * static_cast<double>(clock_utc_ns()) - 1e-9 * static_cast<double>(system_ns);
  frame.arrival_s = clock_monotonic_s() - std::clamp(age_s, 0.0, 1.0);
  return frame;
}

bool AravisDevice::command_latch() {
  AravisError error;
  if (!latch_by_feature_)
    return arv_device_write_register(device(), kTimestampControl, kTimestampLatch, error.out()) !=
           0;
  arv_camera_execute_command(camera_.get(), "GevTimestampControlLatch", error.out());
  return !error;
}

std::optional<std::uint64_t> AravisDevice::latched_ticks() {
  AravisError error;
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

bool AravisDevice::answers() {
  AravisError error;
  guint32 privilege = 0;
  return arv_device_read_register(device(), kPrivilege, &privilege, error.out()) != 0;
}

void AravisDevice::trigger() { AravisFeatures(camera_.get()).execute("TriggerSoftware"); }

void AravisDevice::set_exposure(const ExposureSetting& setting) {
  exposure_ = ols::camera::set_exposure(camera_.get(), setting);
}

std::optional<double> AravisDevice::temperature_degC() const {
  return AravisFeatures(camera_.get()).number(kTemperature);
}

std::optional<PtpState> AravisDevice::ptp() const {
  const AravisFeatures features(camera_.get());
  features.execute(kPtpLatch);  // SFNC's status is that of the last latch
  const auto status = features.chosen(kPtpStatus);
  return status ? std::optional(ptp_state(*status)) : std::nullopt;
}

std::optional<LatchSample> AravisDevice::latch() {
  if (tick_hz_ == 0) return std::nullopt;
  const double before_s = clock_monotonic_s();
  if (!command_latch()) return std::nullopt;
  const double after_s = clock_monotonic_s();
  const auto ticks = latched_ticks();
  // A camera without the latch leaves its register unchanged.
  if (!ticks || *ticks == last_latch_ticks_) return std::nullopt;
  last_latch_ticks_ = *ticks;
  return LatchSample{
      .device_ns = ticks_to_ns(*ticks, tick_hz_), .before_s = before_s, .after_s = after_s};
}

}  // namespace ols::camera
