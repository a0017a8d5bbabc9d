#include "edge/camera/rtsp/rtsp_stream.h"

#include <gio/gio.h>
#include <gst/app/gstappsink.h>
#include <gst/gst.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/camera/gstreamer/gst_picture.h"
#include "edge/camera/rtsp/rtsp_offer.h"
#include "edge/device/certificate_key.h"

namespace ols::camera {
namespace {

// A gap in the packets is waited for this long; packets in order do not wait.
constexpr guint kReorder_ms = 50;
constexpr guint64 kTimeout_us = 5'000'000;
constexpr std::int64_t kNtpToUtc_ns = 2'208'988'800LL * 1'000'000'000LL;

// The type of a database of authorities that has none.
GType trusts_nobody() {
  static const GType type = g_type_register_static_simple(
      G_TYPE_TLS_DATABASE, "OlsTrustsNobody", sizeof(GTlsDatabaseClass),
      [](gpointer class_, gpointer) {
        static_cast<GTlsDatabaseClass*>(class_)->verify_chain =
            [](GTlsDatabase*, GTlsCertificate*, const gchar*, GSocketConnectable*, GTlsInteraction*,
               GTlsDatabaseVerifyFlags, GCancellable*,
               GError**) { return G_TLS_CERTIFICATE_UNKNOWN_CA; };
      },
      sizeof(GTlsDatabase), nullptr, static_cast<GTypeFlags>(0));
  return type;
}

std::string words_of(GTlsCertificateFlags errors) {
  std::string words;
  for (const auto& [flag, meaning] :
       {std::pair{G_TLS_CERTIFICATE_UNKNOWN_CA, "signed by nobody whom this system trusts"},
        {G_TLS_CERTIFICATE_BAD_IDENTITY, "made for another host"},
        {G_TLS_CERTIFICATE_EXPIRED, "expired"},
        {G_TLS_CERTIFICATE_NOT_ACTIVATED, "not valid yet"},
        {G_TLS_CERTIFICATE_REVOKED, "revoked"}})
    if ((errors & flag) != 0) words += (words.empty() ? "" : ", ") + std::string(meaning);
  return words.empty() ? "not valid" : words;
}

struct Caps {
  explicit Caps(const char* text) : caps(gst_caps_from_string(text)) {}
  ~Caps() { gst_caps_unref(caps); }
  Caps(const Caps&) = delete;
  Caps& operator=(const Caps&) = delete;
  GstCaps* caps;
};

}  // namespace

struct RtspStream::Impl {
  Impl(const RtspConfig& config, const std::string& password);
  ~Impl();

  void add_source(const RtspConfig& config, const std::string& password);
  void secure(GstElement* source, const RtspConfig& config);
  bool judge(GTlsCertificate* certificate, GTlsCertificateFlags errors);
  bool choose(const GstCaps* caps);
  void link(GstPad* pad);
  void note_packet(GstBuffer* buffer);
  void note_decoding(GstBuffer* buffer);
  void check_bus();
  [[noreturn]] void fail(GstMessage* message);
  std::optional<DecodedPicture> picture_of(GstSample* sample);

  const bool wants_colour_;
  const std::string pinned_key_;
  const Caps ntp_{"timestamp/x-ntp"};
  GstElement* pipeline_ = nullptr;
  GstElement* sink_ = nullptr;  // in the pipeline

  mutable std::mutex mutex_;  // guards all below: GStreamer's threads write them
  const RtspCodec* codec_ = nullptr;
  std::string trouble_;      // there is nothing to decode
  std::string certificate_;  // why it is refused
  std::optional<RtpPictures> pictures_;
  bool linked_ = false;
};

RtspStream::Impl::Impl(const RtspConfig& config, const std::string& password)
    : wants_colour_(config.keep_raw), pinned_key_(config.pinned_key) {
  pipeline_ = gst_pipeline_new(nullptr);
  try {
    add_source(config, password);
  } catch (...) {
    gst_object_unref(pipeline_);
    throw;
  }
  gst_element_set_state(pipeline_, GST_STATE_PLAYING);
}

RtspStream::Impl::~Impl() {
  gst_element_set_state(pipeline_, GST_STATE_NULL);  // joins its threads
  gst_object_unref(pipeline_);
}

void RtspStream::Impl::add_source(const RtspConfig& config, const std::string& password) {
  GstElement* source = gst_element_factory_make("rtspsrc", nullptr);
  sink_ = gst_element_factory_make("appsink", nullptr);
  for (GstElement* element : {source, sink_}) {
    if (element != nullptr) gst_bin_add(GST_BIN(pipeline_), element);
  }
  if (source == nullptr || sink_ == nullptr)
    throw CameraUnfit(alarm::camera_not_video("GStreamer has no rtspsrc or appsink"));
  const std::string url = filled_url(config, password);
  // Stamps as the camera makes them (buffer-mode none): the arrivals are judged by our own clock.
  g_object_set(source, "location", url.c_str(), "latency", kReorder_ms, "buffer-mode", 0,
               "add-reference-timestamp-meta", TRUE, "tcp-timeout", kTimeout_us, "timeout",
               kTimeout_us, "protocols", config.transport == RtspTransport::kTcp ? 4 : 1, nullptr);
  if (!config.user.empty())
    g_object_set(source, "user-id", config.user.c_str(), "user-pw", password.c_str(), nullptr);
  secure(source, config);
  g_signal_connect(source, "select-stream",
                   G_CALLBACK(+[](GstElement*, guint, GstCaps* caps, Impl* self) -> gboolean {
                     return self->choose(caps) ? TRUE : FALSE;
                   }),
                   this);
  g_signal_connect(source, "pad-added",
                   G_CALLBACK(+[](GstElement*, GstPad* pad, Impl* self) { self->link(pad); }),
                   this);
  const Caps formats(gst_formats(wants_colour_));
  g_object_set(sink_, "caps", formats.caps, "sync", FALSE, "drop", TRUE, "max-buffers", 1,
               "wait-on-eos", FALSE, nullptr);
}

// If a key is pinned, no authority vouches for a certificate: judge() is asked about each.
void RtspStream::Impl::secure(GstElement* source, const RtspConfig& config) {
  if (!config.url.starts_with("rtsps:")) return;
  g_signal_connect(source, "accept-certificate",
                   G_CALLBACK(+[](GstElement*, GTlsConnection*, GTlsCertificate* certificate,
                                  GTlsCertificateFlags errors, Impl* self) -> gboolean {
                     return self->judge(certificate, errors) ? TRUE : FALSE;
                   }),
                   this);
  if (config.pinned_key.empty()) return;
  gpointer nobody = g_object_new(trusts_nobody(), nullptr);
  g_object_set(source, "tls-database", nobody, nullptr);
  g_object_unref(nobody);
}

// Asked about a certificate that no authority vouches for.
bool RtspStream::Impl::judge(GTlsCertificate* certificate, GTlsCertificateFlags errors) {
  GByteArray* der = nullptr;
  g_object_get(certificate, "certificate", &der, nullptr);
  const std::string key =
      der == nullptr ? "" : device::certificate_key({der->data, std::size_t{der->len}});
  if (der != nullptr) g_byte_array_unref(der);
  if (!pinned_key_.empty() && key == pinned_key_) return true;
  std::string words = pinned_key_.empty() ? "" : "its key is not pinned_key";
  if (words.empty()) words = words_of(errors);
  const std::lock_guard lock(mutex_);
  certificate_ = words + "; its key is " + key;
  return false;
}

// The first video stream; no sound, no metadata.
bool RtspStream::Impl::choose(const GstCaps* caps) {
  const std::lock_guard lock(mutex_);
  const RtspOffer offer = rtsp_offer(caps);
  if (codec_ != nullptr || !offer.is_video) return false;
  codec_ = offer.codec;
  trouble_ = codec_ == nullptr ? "codec " + offer.format : "";
  return codec_ != nullptr;
}

void RtspStream::Impl::link(GstPad* pad) {
  const std::lock_guard lock(mutex_);
  GstCaps* caps = gst_pad_get_current_caps(pad);
  if (caps == nullptr) caps = gst_pad_query_caps(pad, nullptr);
  const RtspOffer offer = rtsp_offer(caps);
  gst_caps_unref(caps);
  const bool usable = !linked_ && codec_ != nullptr && codec_ == offer.codec && offer.clock_hz > 0;
  if (!usable) return;
  const std::string description = std::string(codec_->pipeline) + " ! videoconvert n-threads=1";
  GError* error = nullptr;
  GstElement* bin = gst_parse_bin_from_description(description.c_str(), TRUE, &error);
  if (error != nullptr) {
    trouble_ = error->message;
    g_clear_error(&error);
  }
  if (bin == nullptr) return;
  linked_ = true;
  pictures_.emplace(offer.clock_hz);
  GstElement* decoder = gst_bin_get_by_name(GST_BIN(bin), "decoder");
  GstPad* encoded = gst_element_get_static_pad(decoder, "sink");
  gst_pad_add_probe(
      encoded, GST_PAD_PROBE_TYPE_BUFFER,
      [](GstPad*, GstPadProbeInfo* info, gpointer self) {
        static_cast<Impl*>(self)->note_decoding(GST_PAD_PROBE_INFO_BUFFER(info));
        return GST_PAD_PROBE_OK;
      },
      this, nullptr);
  gst_object_unref(encoded);
  gst_object_unref(decoder);
  gst_pad_add_probe(
      pad, GST_PAD_PROBE_TYPE_BUFFER,
      [](GstPad*, GstPadProbeInfo* info, gpointer self) {
        static_cast<Impl*>(self)->note_packet(GST_PAD_PROBE_INFO_BUFFER(info));
        return GST_PAD_PROBE_OK;
      },
      this, nullptr);
  gst_bin_add(GST_BIN(pipeline_), bin);
  gst_element_link(bin, sink_);
  gst_element_sync_state_with_parent(bin);
  GstPad* in = gst_element_get_static_pad(bin, "sink");
  if (gst_pad_link(pad, in) != GST_PAD_LINK_OK) trouble_ = "its packets do not fit their codec";
  gst_object_unref(in);
}

void RtspStream::Impl::note_packet(GstBuffer* buffer) {
  std::array<std::uint8_t, 8> head{};
  if (gst_buffer_extract(buffer, 0, head.data(), head.size()) != head.size()) return;
  RtpPacket packet = *rtp_packet(head);
  packet.pts_ns = GST_BUFFER_PTS(buffer);
  packet.arrival_s = clock_monotonic_s();
  const auto* report = gst_buffer_get_reference_timestamp_meta(buffer, ntp_.caps);
  if (report != nullptr)
    packet.report_utc_ns = static_cast<std::int64_t>(report->timestamp) - kNtpToUtc_ns;
  const std::lock_guard lock(mutex_);
  pictures_->add(packet);
}

void RtspStream::Impl::note_decoding(GstBuffer* buffer) {
  const std::lock_guard lock(mutex_);
  pictures_->decoding(GST_BUFFER_PTS(buffer),
                      !GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT));
}

void RtspStream::Impl::fail(GstMessage* message) {
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_EOS)
    throw CameraAbsent(alarm::camera_no_stream("it ended the stream"));
  GError* error = nullptr;
  gst_message_parse_error(message, &error, nullptr);
  const std::string text = printable(error->message);
  const bool login =
      g_error_matches(error, GST_RESOURCE_ERROR, GST_RESOURCE_ERROR_NOT_AUTHORIZED) != FALSE;
  const bool unfit = error->domain == GST_STREAM_ERROR;
  g_clear_error(&error);
  const std::lock_guard lock(mutex_);
  if (!certificate_.empty()) throw CameraUnfit(alarm::camera_certificate(certificate_));
  if (login) throw LoginRefused(alarm::camera_refuses_login());
  if (unfit || !trouble_.empty())
    throw CameraUnfit(alarm::camera_not_video(trouble_.empty() ? text : trouble_));
  throw CameraAbsent(alarm::camera_no_stream(text));
}

void RtspStream::Impl::check_bus() {
  GstBus* bus = gst_element_get_bus(pipeline_);
  GstMessage* message =
      gst_bus_pop_filtered(bus, static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS));
  gst_object_unref(bus);
  if (message == nullptr) return;
  const std::unique_ptr<GstMessage, decltype(&gst_message_unref)> owned(message, gst_message_unref);
  fail(message);
}

std::optional<DecodedPicture> RtspStream::Impl::picture_of(GstSample* sample) {
  GstBuffer* buffer = gst_sample_get_buffer(sample);
  DecodedPicture picture;
  {
    const std::lock_guard lock(mutex_);
    const auto rtp = pictures_->take(GST_BUFFER_PTS(buffer));
    if (!rtp) return std::nullopt;
    picture.rtp = *rtp;
  }
  auto decoded = gst_picture(sample, wants_colour_);
  if (!decoded) return std::nullopt;
  picture.gray = std::move(decoded->gray);
  picture.bgr = std::move(decoded->bgr);
  return picture;
}

RtspStream::RtspStream(const RtspConfig& config, const std::string& password) {
  start_gstreamer();
  impl_ = std::make_unique<Impl>(config, password);
}
RtspStream::~RtspStream() = default;

std::optional<DecodedPicture> RtspStream::receive(double timeout_s) {
  impl_->check_bus();
  GstSample* sample = gst_app_sink_try_pull_sample(GST_APP_SINK(impl_->sink_),
                                                   static_cast<GstClockTime>(timeout_s * 1e9));
  if (sample == nullptr) return std::nullopt;
  const std::unique_ptr<GstSample, decltype(&gst_sample_unref)> owned(sample, gst_sample_unref);
  return impl_->picture_of(sample);
}

std::string RtspStream::codec() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->codec_ == nullptr ? std::string() : std::string(impl_->codec_->rtp_name);
}

std::uint64_t RtspStream::lost_packets() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->pictures_ ? impl_->pictures_->lost_packets() : 0;
}

}  // namespace ols::camera
