#include "edge/camera/v4l2/v4l2_camera.h"

#include <gst/app/gstappsink.h>
#include <gst/gst.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/camera/camera_errors.h"
#include "edge/camera/gstreamer/gst_picture.h"
#include "edge/camera/picture.h"
#include "edge/camera/picture_change.h"
#include "edge/camera/retry_pause.h"
#include "edge/camera/v4l2/v4l2_control_link.h"

namespace ols::camera {
namespace {

constexpr double kPoll_s = 0.1;         // delay until the end is noticed
constexpr double kFirstFrame_s = 10.0;  // a camera starts its sensor first

struct Unref {
  void operator()(void* object) const { gst_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref>;

// A camera that is open: a pipeline that plays.
class OpenCamera {
 public:
  explicit OpenCamera(const V4l2Config& config) {
    start_gstreamer();
    GError* error = nullptr;
    pipeline_.reset(gst_parse_launch(v4l2_pipeline(config).c_str(), &error));
    if (error != nullptr) {
      const std::string text = error->message;
      g_clear_error(&error);
      throw CameraUnfit(alarm::camera_not_video(printable(text)));
    }
    // Its time is CLOCK_MONOTONIC, as that of the driver's stamps.
    const Owned<GstClock> clock(gst_system_clock_obtain());
    gst_pipeline_use_clock(GST_PIPELINE(pipeline_.get()), clock.get());
    sink_.reset(gst_bin_get_by_name(GST_BIN(pipeline_.get()), "sink"));
    set_source(config);
    GstCaps* formats = gst_caps_from_string(gst_formats(config.keep_raw));
    g_object_set(sink_.get(), "caps", formats, "sync", FALSE, "drop", TRUE, "max-buffers", 1,
                 nullptr);
    gst_caps_unref(formats);
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }
  ~OpenCamera() { gst_element_set_state(pipeline_.get(), GST_STATE_NULL); }
  OpenCamera(const OpenCamera&) = delete;
  OpenCamera& operator=(const OpenCamera&) = delete;

  struct Stamped {
    GstPicture picture;
    double stamp_s;  // CLOCK_MONOTONIC
  };
  // nullopt: none came in time. Throws CameraAbsent.
  std::optional<Stamped> receive(double timeout_s, bool with_colour) {
    check();
    GstSample* sample = gst_app_sink_try_pull_sample(GST_APP_SINK(sink_.get()),
                                                     static_cast<GstClockTime>(timeout_s * 1e9));
    if (sample == nullptr) return std::nullopt;
    const std::unique_ptr<GstSample, decltype(&gst_sample_unref)> owned(sample, gst_sample_unref);
    auto picture = gst_picture(sample, with_colour);
    const GstClockTime pts = GST_BUFFER_PTS(gst_sample_get_buffer(sample));
    if (!picture || !GST_CLOCK_TIME_IS_VALID(pts)) return std::nullopt;
    const GstClockTime stamp = gst_element_get_base_time(pipeline_.get()) + pts;
    return Stamped{std::move(*picture), 1e-9 * static_cast<double>(stamp)};
  }

 private:
  // Only a V4L2 source has these.
  void set_source(const V4l2Config& config) {
    if (config.element != "v4l2src") return;
    const Owned<GstElement> source(gst_bin_get_by_name(GST_BIN(pipeline_.get()), "source"));
    g_object_set(source.get(), "device", config.device.c_str(), nullptr);
    if (config.controls.empty()) return;
    const auto known = v4l2_controls_of(config.device);
    if (!known.empty()) check_v4l2_controls(config.controls, known);
    GstStructure* controls = gst_structure_from_string(("c," + config.controls).c_str(), nullptr);
    if (controls == nullptr)
      throw CameraUnfit(alarm::camera_not_video("controls = " + config.controls));
    g_object_set(source.get(), "extra-controls", controls, nullptr);
    gst_structure_free(controls);
  }

  void check() {
    const Owned<GstBus> bus(gst_element_get_bus(pipeline_.get()));
    GstMessage* message = gst_bus_pop_filtered(
        bus.get(), static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS));
    if (message == nullptr) return;
    const std::unique_ptr<GstMessage, decltype(&gst_message_unref)> owned(message,
                                                                          gst_message_unref);
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_EOS)
      throw CameraAbsent(alarm::camera_no_stream("it ended the stream"));
    GError* error = nullptr;
    gst_message_parse_error(message, &error, nullptr);
    const std::string text = printable(error->message);
    const bool unfit = error->domain == GST_STREAM_ERROR;
    g_clear_error(&error);
    if (unfit) throw CameraUnfit(alarm::camera_not_video(text));
    throw CameraAbsent(alarm::camera_no_stream(text));
  }

  Owned<GstElement> pipeline_, sink_;
};

class V4l2Source : public CameraSource {
 public:
  V4l2Source(const V4l2Config& config, CameraHandover& handover)
      : config_(config), handover_(handover) {}

  void serve() override;
  double pause_s() override {
    return pause_.after_stream(last_s_.value_or(0.0) - first_s_.value_or(0.0));
  }

 private:
  void take(OpenCamera::Stamped stamped);
  void note_rate(double now_s);

  const V4l2Config config_;
  CameraHandover& handover_;
  RetryPause pause_;
  PictureChange change_;
  std::uint64_t number_ = 0;

  // Since it was opened.
  FrameStatistics statistics_;
  std::optional<double> first_s_, last_s_;  // stamps
};

void V4l2Source::serve() {
  statistics_ = {};
  change_ = {};  // some begin with the same picture each time
  first_s_.reset();
  last_s_.reset();
  OpenCamera camera(config_);
  double heard_s = clock_monotonic_s();
  while (!handover_.ended()) {
    auto stamped = camera.receive(kPoll_s, config_.keep_raw);
    if (stamped) {
      take(std::move(*stamped));
      heard_s = clock_monotonic_s();
    }
    const double patience_s = first_s_ ? config_.no_frame_timeout_s : kFirstFrame_s;
    if (clock_monotonic_s() - heard_s > patience_s + 2.0 / config_.frame_rate_hz)
      throw CameraAbsent(alarm::camera_lost());
  }
}

void V4l2Source::take(OpenCamera::Stamped stamped) {
  const double now_s = clock_monotonic_s();
  if (!first_s_) handover_.note_opened("V4L2 " + config_.device);
  const double periods =
      (stamped.stamp_s - last_s_.value_or(stamped.stamp_s)) * config_.frame_rate_hz;
  const auto step = static_cast<std::uint64_t>(std::max(1LL, std::llround(periods)));
  const std::uint64_t lost = first_s_ ? step - 1 : 0;
  number_ += step;
  if (!first_s_) first_s_ = stamped.stamp_s;
  last_s_ = stamped.stamp_s;
  statistics_.add(now_s, true);
  const cv::Mat& gray = stamped.picture.gray;
  if (gray.cols != config_.width_px || gray.rows != config_.height_px)
    return handover_.note_refused(PictureRefusal::kWrongSize, lost, statistics_);
  const double unchanged_s = change_.unchanged_s(gray, now_s);
  if (config_.frozen_s > 0.0 && unchanged_s >= config_.frozen_s)
    throw CameraAbsent(alarm::camera_frozen(unchanged_s));
  note_rate(now_s);
  Frame frame{.gray = std::move(stamped.picture.gray),
              .mid_exposure_s = stamped.stamp_s - config_.delay_s,
              .stamp_sd_s = config_.delay_sd_s,
              .stamp_source = StampSource::kCamera,
              .row_readout_s = config_.row_readout_s,
              .number = number_,
              .raw = std::move(stamped.picture.bgr),
              .pixel_format = config_.pixel_format};
  handover_.publish(std::move(frame), lost, statistics_);
}

void V4l2Source::note_rate(double now_s) {
  auto differs = rate_alarm(config_, statistics_.rate_hz(), now_s - *first_s_);
  handover_.change_facts([&](CameraFacts& facts) {
    facts.kind_alarms.clear();
    if (differs) facts.kind_alarms.push_back(std::move(*differs));
  });
}

}  // namespace

V4l2Camera::V4l2Camera(const V4l2Config& config)
    : ThreadedCamera(config, [&config](CameraHandover& handover) {
        return std::make_unique<V4l2Source>(config, handover);
      }) {}

}  // namespace ols::camera
