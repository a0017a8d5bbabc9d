#include "sim/camera/rtsp_server.h"

#include <gst/app/gstappsrc.h>
#include <gst/rtp/gstrtcpbuffer.h>
#include <gst/rtsp-server/rtsp-server.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <future>
#include <mutex>
#include <random>
#include <stdexcept>
#include <thread>

#include "base/process/clocks.h"

namespace ols::sim {
namespace {

constexpr const char* kPath = "/video";
constexpr double kStampClock_hz = 90'000.0;
constexpr std::uint64_t kNtpMinusUtc_s = 2'208'988'800U;
constexpr double kIdle_s = 0.05;

// x264 is not everywhere; JPEG is. As in a camera, a picture is left out when the encoder is late;
// in an endless queue, pictures would become ever older.
std::string launch_line(const RtspServerConfig& c) {
  const std::string source =
      "( appsrc name=source is-live=true format=time max-buffers=2 max-bytes=0 "
      "leaky-type=downstream ! ";
  GstElementFactory* x264 = gst_element_factory_find("x264enc");
  if (x264 != nullptr) gst_object_unref(x264);
  if (c.codec == VideoCodec::kJpeg || x264 == nullptr)
    return source + "jpegenc quality=85 ! rtpjpegpay name=pay0 timestamp-offset=0 )";
  if (c.codec == VideoCodec::kH265)
    return source + "x265enc tune=zerolatency speed-preset=ultrafast key-int-max=" +
           std::to_string(c.key_every) + " bitrate=" + std::to_string(c.kbit_s) +
           " option-string=pools=none:frame-threads=1 ! rtph265pay name=pay0 config-interval=-1 "
           "timestamp-offset=0 )";
  return source + "x264enc tune=zerolatency speed-preset=ultrafast threads=1 key-int-max=" +
         std::to_string(c.key_every) + " bitrate=" + std::to_string(c.kbit_s) +
         " ! rtph264pay name=pay0 config-interval=-1 timestamp-offset=0 )";
}

// The gray image as luma, without colour.
GstSample* sample_of(const cv::Mat& gray, double frame_rate_hz) {
  const auto luma = gray.total();
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, luma * 3 / 2, nullptr);
  GstMapInfo map;
  gst_buffer_map(buffer, &map, GST_MAP_WRITE);
  std::copy_n(gray.data, luma, map.data);
  std::fill_n(map.data + luma, luma / 2, std::uint8_t{128});
  gst_buffer_unmap(buffer, &map);
  GstCaps* caps = gst_caps_new_simple(
      "video/x-raw", "format", G_TYPE_STRING, "I420", "width", G_TYPE_INT, gray.cols, "height",
      G_TYPE_INT, gray.rows, "framerate", GST_TYPE_FRACTION,
      static_cast<int>(std::lround(1000.0 * frame_rate_hz)), 1000, nullptr);
  GstSample* sample = gst_sample_new(buffer, caps, nullptr, nullptr);
  gst_buffer_unref(buffer);
  gst_caps_unref(caps);
  return sample;
}

}  // namespace

struct RtspServer::Impl {
  Impl(const RtspServerConfig& config, std::function<void(const Exposure&, cv::Mat&)> draw);
  ~Impl();

  void be_secure();
  void require_login(GstRTSPMediaFactory* factory);
  void listen();
  void hang_up();
  void on_media(GstRTSPMedia* media);
  void on_prepared(GstRTSPMedia* media);
  void on_unprepared(GstRTSPMedia* media);
  bool rewrite_report(GstBuffer* buffer);
  GstPadProbeReturn on_packets(GstPadProbeInfo* info);
  void expose();
  void push(GstSample* sample, std::int64_t mid_ns);
  // Runs in the thread of the server's main loop, and waits for it.
  void in_loop(void (*what)(Impl&));
  CameraFaults faults() const;

  const RtspServerConfig config_;
  const std::function<void(const Exposure&, cv::Mat&)> draw_;
  const std::int64_t switched_on_ns_ = clock_monotonic_ns();
  GMainContext* context_ = g_main_context_new();
  GMainLoop* loop_ = g_main_loop_new(context_, FALSE);
  GstRTSPServer* server_ = gst_rtsp_server_new();
  GSource* listening_ = nullptr;
  std::atomic<int> connections_ = 0, port_ = 0;

  mutable std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  bool ended_ = false;
  CameraFaults faults_;
  int width_px_, height_px_;
  GstRTSPMedia* media_ = nullptr;
  GstElement* source_ = nullptr;  // while a client looks on
  std::int64_t base_ns_ = 0;      // CLOCK_MONOTONIC of stamp 0
  std::int64_t stamp_ns_ = 0;     // of the newest picture
  std::int64_t stamped_ns_ = 0;   // what it is told to be of
  std::uint64_t frames_ = 0;
  std::mt19937 random_{1};

  std::thread serving_, exposing_;
};

RtspServer::Impl::Impl(const RtspServerConfig& config,
                       std::function<void(const Exposure&, cv::Mat&)> draw)
    : config_(config),
      draw_(std::move(draw)),
      width_px_(config.width_px),
      height_px_(config.height_px) {
  gst_rtsp_server_set_address(server_, config.address.c_str());
  gst_rtsp_server_set_service(server_, std::to_string(config.port).c_str());
  g_signal_connect(
      server_, "client-connected",
      G_CALLBACK(+[](GstRTSPServer*, GstRTSPClient*, Impl* self) { ++self->connections_; }), this);
  GstRTSPMediaFactory* factory = gst_rtsp_media_factory_new();
  gst_rtsp_media_factory_set_launch(factory, launch_line(config).c_str());
  gst_rtsp_media_factory_set_shared(factory, TRUE);
  if (!config.certificate.empty()) be_secure();
  if (!config.user.empty()) require_login(factory);
  g_signal_connect(factory, "media-configure",
                   G_CALLBACK(+[](GstRTSPMediaFactory*, GstRTSPMedia* media, Impl* self) {
                     self->on_media(media);
                   }),
                   this);
  GstRTSPMountPoints* mounts = gst_rtsp_server_get_mount_points(server_);
  gst_rtsp_mount_points_add_factory(mounts, kPath, factory);  // takes the factory
  g_object_unref(mounts);
  listen();
  if (listening_ == nullptr) throw std::runtime_error("no RTSP server at " + config.address);
  serving_ = std::thread([this] {
    g_main_context_push_thread_default(context_);
    g_main_loop_run(loop_);
    g_main_context_pop_thread_default(context_);
  });
  exposing_ = std::thread([this] { expose(); });
}

RtspServer::Impl::~Impl() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  exposing_.join();
  in_loop([](Impl& self) { self.hang_up(); });
  {  // Its threads call this object until then.
    constexpr double kDeadline_s = 5.0;
    std::unique_lock lock(mutex_);
    time_source().wait(lock, changed_, kDeadline_s, [this] { return media_ == nullptr; });
  }
  g_main_loop_quit(loop_);
  serving_.join();
  g_object_unref(server_);
  g_main_loop_unref(loop_);
  g_main_context_unref(context_);
}

void RtspServer::Impl::require_login(GstRTSPMediaFactory* factory) {
  constexpr const char* kRole = "viewer";
  GstRTSPAuth* auth = gst_rtsp_server_get_auth(server_);
  if (auth == nullptr) auth = gst_rtsp_auth_new();
  gst_rtsp_auth_set_supported_methods(auth, GST_RTSP_AUTH_DIGEST);
  GstRTSPToken* token =
      gst_rtsp_token_new(GST_RTSP_TOKEN_MEDIA_FACTORY_ROLE, G_TYPE_STRING, kRole, nullptr);
  gst_rtsp_auth_add_digest(auth, config_.user.c_str(), config_.password.c_str(), token);
  gst_rtsp_token_unref(token);
  gst_rtsp_server_set_auth(server_, auth);
  g_object_unref(auth);
  GstRTSPPermissions* permissions = gst_rtsp_permissions_new();
  gst_rtsp_permissions_add_role(permissions, kRole, GST_RTSP_PERM_MEDIA_FACTORY_ACCESS,
                                G_TYPE_BOOLEAN, TRUE, GST_RTSP_PERM_MEDIA_FACTORY_CONSTRUCT,
                                G_TYPE_BOOLEAN, TRUE, nullptr);
  gst_rtsp_media_factory_set_permissions(factory, permissions);
  gst_rtsp_permissions_unref(permissions);
}

void RtspServer::Impl::be_secure() {
  GError* error = nullptr;
  GTlsCertificate* certificate =
      g_tls_certificate_new_from_pem(config_.certificate.c_str(), -1, &error);
  if (error != nullptr) {
    const std::string text = error->message;
    g_clear_error(&error);
    throw std::runtime_error("certificate: " + text);
  }
  GstRTSPAuth* auth = gst_rtsp_auth_new();
  gst_rtsp_auth_set_tls_certificate(auth, certificate);
  gst_rtsp_server_set_auth(server_, auth);
  g_object_unref(auth);
  g_object_unref(certificate);
}

void RtspServer::Impl::listen() {
  if (listening_ != nullptr) return;
  GSocket* socket = gst_rtsp_server_create_socket(server_, nullptr, nullptr);
  if (socket == nullptr) return;
  GSocketAddress* address = g_socket_get_local_address(socket, nullptr);
  port_ = g_inet_socket_address_get_port(G_INET_SOCKET_ADDRESS(address));
  g_object_unref(address);
  gst_rtsp_server_set_service(server_, std::to_string(port_).c_str());
  listening_ = g_socket_create_source(socket, G_IO_IN, nullptr);
  g_source_set_callback(listening_, G_SOURCE_FUNC(gst_rtsp_server_io_func), server_, nullptr);
  g_source_attach(listening_, context_);
  g_object_unref(socket);
}

// As a camera without power: no address, no connection.
void RtspServer::Impl::hang_up() {
  if (listening_ == nullptr) return;
  g_source_destroy(listening_);
  g_source_unref(listening_);
  listening_ = nullptr;
  gst_rtsp_server_client_filter(
      server_, [](GstRTSPServer*, GstRTSPClient*, gpointer) { return GST_RTSP_FILTER_REMOVE; },
      nullptr);
}

void RtspServer::Impl::in_loop(void (*what)(Impl&)) {
  struct Call {
    Impl& self;
    void (*what)(Impl&);
    std::promise<void> done = {};
  };
  const auto call = std::make_shared<Call>(Call{*this, what});
  g_main_context_invoke_full(
      context_, G_PRIORITY_DEFAULT,
      [](gpointer data) -> gboolean {
        const auto& own = *static_cast<std::shared_ptr<Call>*>(data);
        own->what(own->self);
        own->done.set_value();
        return G_SOURCE_REMOVE;
      },
      new std::shared_ptr<Call>(call),
      [](gpointer data) { delete static_cast<std::shared_ptr<Call>*>(data); });
  call->done.get_future().wait();
}

CameraFaults RtspServer::Impl::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

void RtspServer::Impl::on_media(GstRTSPMedia* media) {
  g_signal_connect(media, "prepared",
                   G_CALLBACK(+[](GstRTSPMedia* m, Impl* self) { self->on_prepared(m); }), this);
  g_signal_connect(media, "unprepared",
                   G_CALLBACK(+[](GstRTSPMedia* m, Impl* self) { self->on_unprepared(m); }), this);
  GstElement* bin = gst_rtsp_media_get_element(media);
  GstElement* payloader = gst_bin_get_by_name_recurse_up(GST_BIN(bin), "pay0");
  GstPad* packets = gst_element_get_static_pad(payloader, "src");
  gst_pad_add_probe(
      packets,
      static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_BUFFER | GST_PAD_PROBE_TYPE_BUFFER_LIST),
      [](GstPad*, GstPadProbeInfo* info, gpointer self) {
        return static_cast<Impl*>(self)->on_packets(info);
      },
      this, nullptr);
  gst_object_unref(packets);
  gst_object_unref(payloader);
  const std::lock_guard lock(mutex_);
  if (source_ != nullptr) gst_object_unref(source_);
  source_ = gst_bin_get_by_name_recurse_up(GST_BIN(bin), "source");
  media_ = media;
  base_ns_ = 0;
  gst_object_unref(bin);
}

void RtspServer::Impl::on_prepared(GstRTSPMedia* media) {
  GObject* session = gst_rtsp_stream_get_rtpsession(gst_rtsp_media_get_stream(media, 0));
  if (session == nullptr) return;
  g_signal_connect(session, "on-sending-rtcp",
                   G_CALLBACK(+[](GObject*, GstBuffer* buffer, gboolean, Impl* self) -> gboolean {
                     return self->rewrite_report(buffer) ? TRUE : FALSE;
                   }),
                   this);
  g_object_unref(session);
}

void RtspServer::Impl::on_unprepared(GstRTSPMedia* media) {
  const std::lock_guard lock(mutex_);
  if (media_ != media) return;
  gst_object_unref(source_);
  source_ = nullptr;
  media_ = nullptr;
  changed_.notify_all();
}

// The instant of the newest picture by the camera's clock, and its stamp.
bool RtspServer::Impl::rewrite_report(GstBuffer* buffer) {
  const std::lock_guard lock(mutex_);
  if (stamped_ns_ == 0) return false;
  const std::int64_t utc_ns = stamped_ns_ + clock_utc_ns() - clock_monotonic_ns();
  const double drifted_s =
      faults_.clock_drift * 1e-9 * static_cast<double>(stamped_ns_ - switched_on_ns_);
  const double off_s = faults_.clock_off_s + drifted_s;
  const auto ntp_ns = static_cast<std::uint64_t>(utc_ns + std::llround(1e9 * off_s)) +
                      kNtpMinusUtc_s * 1'000'000'000U;
  const std::uint64_t ntp = gst_util_uint64_scale(ntp_ns, std::uint64_t{1} << 32U, 1'000'000'000U);
  const auto stamp = static_cast<std::uint32_t>(static_cast<std::uint64_t>(
      std::llround(kStampClock_hz * 1e-9 * static_cast<double>(stamp_ns_))));
  GstRTCPBuffer rtcp = GST_RTCP_BUFFER_INIT;
  gst_rtcp_buffer_map(buffer, GST_MAP_READWRITE, &rtcp);
  GstRTCPPacket packet;
  bool changed = false;
  for (gboolean more = gst_rtcp_buffer_get_first_packet(&rtcp, &packet); more != FALSE;
       more = gst_rtcp_packet_move_to_next(&packet)) {
    if (gst_rtcp_packet_get_type(&packet) != GST_RTCP_TYPE_SR) continue;
    guint32 ssrc = 0, packets = 0, octets = 0;
    gst_rtcp_packet_sr_get_sender_info(&packet, &ssrc, nullptr, nullptr, &packets, &octets);
    gst_rtcp_packet_sr_set_sender_info(&packet, ssrc, ntp, stamp, packets, octets);
    changed = true;
  }
  gst_rtcp_buffer_unmap(&rtcp);
  return changed;
}

GstPadProbeReturn RtspServer::Impl::on_packets(GstPadProbeInfo* info) {
  const double loss = faults().packet_loss;
  if (loss <= 0.0) return GST_PAD_PROBE_OK;
  std::bernoulli_distribution lost(loss);
  if ((GST_PAD_PROBE_INFO_TYPE(info) & GST_PAD_PROBE_TYPE_BUFFER_LIST) == 0)
    return lost(random_) ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
  GstBufferList* list = gst_buffer_list_make_writable(GST_PAD_PROBE_INFO_BUFFER_LIST(info));
  info->data = list;
  for (guint i = gst_buffer_list_length(list); i-- > 0;)
    if (lost(random_)) gst_buffer_list_remove(list, i, 1);
  return gst_buffer_list_length(list) > 0 ? GST_PAD_PROBE_OK : GST_PAD_PROBE_DROP;
}

// The lock is held.
void RtspServer::Impl::push(GstSample* sample, std::int64_t mid_ns) {
  if (base_ns_ == 0) {
    base_ns_ =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(gst_element_get_base_time(source_)));
    stamp_ns_ = std::max<std::int64_t>(0, mid_ns - base_ns_);
  } else if (faults_.missing_rate > 0.0) {
    stamp_ns_ += static_cast<std::int64_t>(1e9 / config_.frame_rate_hz);
  } else {
    stamp_ns_ = std::max(stamp_ns_ + 1, mid_ns - base_ns_);
  }
  stamped_ns_ = mid_ns;
  GST_BUFFER_PTS(gst_sample_get_buffer(sample)) = static_cast<GstClockTime>(stamp_ns_);
  gst_app_src_push_sample(GST_APP_SRC(source_), sample);
}

void RtspServer::Impl::expose() {
  const auto period_ns = [&] {  // a camera that lies sends fewer than it stamps
    const double rate = config_.frame_rate_hz * (1.0 - faults_.missing_rate);
    return static_cast<std::int64_t>(1e9 / rate);
  };
  const auto until_sent_ns =
      static_cast<std::int64_t>(1e9 * (config_.exposure_s + config_.delay_s));
  std::int64_t start_ns = clock_monotonic_ns();
  std::unique_lock lock(mutex_);
  while (!ended_) {
    const double wait_s =
        1e-9 * static_cast<double>(start_ns + until_sent_ns - clock_monotonic_ns());
    if (source_ == nullptr || faults_.gone) {
      time_source().wait(lock, changed_, kIdle_s, [this] { return ended_; });
      start_ns = clock_monotonic_ns();
      continue;
    }
    if (wait_s > 0.0) {
      time_source().wait(lock, changed_, wait_s, [this] { return ended_; });
      continue;
    }
    const Exposure exposure{.start_monotonic_ns = start_ns,
                            .exposure_s = config_.exposure_s,
                            .gain_dB = 0.0,
                            .frame = frames_++};
    cv::Mat gray(height_px_, width_px_, CV_8U);
    lock.unlock();
    draw_(exposure, gray);
    GstSample* sample = sample_of(gray, config_.frame_rate_hz);
    lock.lock();
    if (source_ != nullptr) push(sample, start_ns + std::llround(0.5e9 * config_.exposure_s));
    gst_sample_unref(sample);
    start_ns += period_ns();
    // Pictures that could not be drawn in time are left out.
    while (start_ns + until_sent_ns + period_ns() < clock_monotonic_ns()) start_ns += period_ns();
  }
}

RtspServer::RtspServer(const RtspServerConfig& config,
                       std::function<void(const Exposure&, cv::Mat&)> draw) {
  gst_registry_fork_set_enabled(FALSE);
  gst_init(nullptr, nullptr);
  impl_ = std::make_unique<Impl>(config, std::move(draw));
}
RtspServer::~RtspServer() = default;

std::string RtspServer::url() const {
  return (impl_->config_.certificate.empty() ? "rtsp://" : "rtsps://") + impl_->config_.address +
         ":" + std::to_string(impl_->port_) + kPath;
}

void RtspServer::set_size(int width_px, int height_px) {
  const std::lock_guard lock(impl_->mutex_);
  impl_->width_px_ = width_px;
  impl_->height_px_ = height_px;
}

void RtspServer::set_faults(const CameraFaults& faults) {
  bool was_gone = false;
  {
    const std::lock_guard lock(impl_->mutex_);
    was_gone = impl_->faults_.gone;
    impl_->faults_ = faults;
  }
  if (faults.gone && !was_gone) impl_->in_loop([](Impl& self) { self.hang_up(); });
  if (!faults.gone && was_gone) impl_->in_loop([](Impl& self) { self.listen(); });
}

int RtspServer::connections() const { return impl_->connections_; }

}  // namespace ols::sim
