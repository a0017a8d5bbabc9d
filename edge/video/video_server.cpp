#include "edge/video/video_server.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <utility>

#include "base/net/ip_endpoint.h"
#include "base/net/ip_networks.h"
#include "base/net/tcp_keepalive.h"
#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/device/behind_control_loop.h"
#include "edge/device/device_thread.h"
#include "edge/video/messages_video.h"
#include "edge/video/video_session.h"

namespace ols::video {
namespace asio = boost::asio;
using Error = boost::system::error_code;

struct VideoServer::Impl {
  // One frame, and what was made of it for one request: viewers who want the same share it.
  struct Encoded {
    std::int64_t sequence = 0;
    int max_width_px = 0, quality = 0;
    cv::Rect region;
    VideoSession::Bytes bytes;
  };

  struct Counters {
    std::atomic<std::uint64_t> requests = 0, sent = 0, turned_away = 0, malformed = 0, stalled = 0,
                               uncoded = 0;
  };

  Impl(const VideoConfig& config, VideoSender video_sender)
      : endpoint(parse_endpoint(config.address)),
        address(config.address),
        allowed(config.allow),
        sender(std::move(video_sender)),
        thread({.name = "video", .opening = "is being opened", .alarm = alarm::video_fails}) {}

  // --- of the serving thread

  void run(const std::stop_token& stop) {
    device::go_behind_control_loop();
    asio::io_context io;
    asio::ip::tcp::acceptor acceptor = listen(io);
    thread.opened();
    thread.works();
    open_to_frames(&io);
    accept(acceptor);
    const std::stop_callback end(stop, [&io] { io.stop(); });
    try {
      io.run();
    } catch (...) {
      close_sessions();
      throw;
    }
    close_sessions();
  }

  asio::ip::tcp::acceptor listen(asio::io_context& io) const {
    try {
      return {io, endpoint};  // sets SO_REUSEADDR
    } catch (const boost::system::system_error& error) {
      throw std::runtime_error("cannot listen on " + address + ": " + error.code().message());
    }
  }

  void open_to_frames(asio::io_context* io) {
    const std::lock_guard lock(mutex);
    context = io;
  }

  void close_sessions() {
    open_to_frames(nullptr);
    sessions.clear();
    viewers = 0;
  }

  void accept(asio::ip::tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](const Error& error, asio::ip::tcp::socket socket) {
      if (!error) admit(std::move(socket));
      if (acceptor.is_open()) accept(acceptor);
    });
  }

  void admit(asio::ip::tcp::socket socket) {
    Error gone;
    const auto peer = socket.remote_endpoint(gone);
    if (gone) return;
    if (!allowed.contain(peer.address()) || sessions.size() >= kMaxViewers) {
      ++counters.turned_away;
      return;  // closes it
    }
    socket.set_option(asio::ip::tcp::no_delay(true), gone);
    keep_alive(socket.native_handle(), {.idle_s = 10, .interval_s = 5, .probes = 3});
    const auto session = std::make_shared<VideoSession>(
        std::move(socket),
        VideoSession::Callbacks{
            [this](VideoSession& one) { ask(one); },
            [this](VideoSession& one, VideoSession::End end) { forget(one, end); }});
    sessions.push_back(session);
    viewers = static_cast<int>(sessions.size());
    session->begin();
  }

  void forget(const VideoSession& session, VideoSession::End end) {
    if (end == VideoSession::End::kMalformed) ++counters.malformed;
    if (end == VideoSession::End::kStalled) ++counters.stalled;
    if (end == VideoSession::End::kUncoded) ++counters.uncoded;
    std::erase_if(sessions, [&](const auto& one) { return one.get() == &session; });
    viewers = static_cast<int>(sessions.size());
  }

  void ask(VideoSession& session) {
    ++counters.requests;
    serve(session);
  }

  void serve_all() {
    // A copy: a session that ends meanwhile leaves the list.
    for (const auto& session : std::vector(sessions)) serve(*session);
  }

  void serve(VideoSession& session) {
    if (!session.request()) return;
    std::shared_ptr<const VideoFrame> frame;
    std::int64_t number = 0;
    {
      const std::lock_guard lock(mutex);
      frame = newest;
      number = sequence;
    }
    const VideoRequest request = *session.request();
    // Each frame once: a viewer of a camera that stands still does not make it busy.
    if (!frame || frame->utime_us <= request.after_utime_us || session.had() == number) return;
    session.note_had(number);
    const auto bytes = request.codec == VideoCodec::kH264
                           ? made(*frame, number, request, session)
                           : encoded(*frame, number, request, session);
    if (bytes->empty()) return session.close(VideoSession::End::kUncoded);
    ++counters.sent;
    session.answer(bytes);
  }

  VideoSession::Bytes made(const VideoFrame& frame, std::int64_t number,
                           const VideoRequest& request, VideoSession& session) const {
    return std::make_shared<const std::vector<std::uint8_t>>(
        encode_frame(frame, number, sender, request, session.stream()));
  }

  // JPEGs are the same for all who ask for the same.
  VideoSession::Bytes encoded(const VideoFrame& frame, std::int64_t number,
                              const VideoRequest& request, VideoSession& session) {
    const cv::Rect region = region_of(request, frame.gray.size());
    if (!cache.empty() && cache.front().sequence != number) cache.clear();
    const auto same = std::ranges::find_if(cache, [&](const Encoded& one) {
      return one.max_width_px == request.max_width_px && one.quality == request.quality &&
             one.region == region;
    });
    if (same != cache.end()) return same->bytes;
    const auto bytes = made(frame, number, request, session);
    if (cache.size() >= kMaxViewers) cache.erase(cache.begin());
    cache.push_back({number, request.max_width_px, request.quality, region, bytes});
    return bytes;
  }

  // --- of any thread

  void offer(VideoFrame frame) {
    auto shared = std::make_shared<const VideoFrame>(std::move(frame));
    const std::lock_guard lock(mutex);
    newest = std::move(shared);
    ++sequence;
    if (context && viewers > 0) asio::post(*context, [this] { serve_all(); });
  }

  const asio::ip::tcp::endpoint endpoint;
  const std::string address;
  const IpNetworks allowed;
  const VideoSender sender;

  // Of the serving thread.
  std::vector<std::shared_ptr<VideoSession>> sessions;
  std::vector<Encoded> cache;  // of the newest frame that was asked for

  std::atomic<int> viewers = 0;
  Counters counters;

  std::mutex mutex;  // guards the next three
  asio::io_context* context = nullptr;
  std::shared_ptr<const VideoFrame> newest;
  std::int64_t sequence = 0;

  device::DeviceThread thread;  // last: it uses the rest
};

VideoServer::VideoServer(const VideoConfig& config, VideoSender sender)
    : impl_(std::make_unique<Impl>(config, std::move(sender))) {
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

VideoServer::~VideoServer() = default;

bool VideoServer::has_viewers() const { return impl_->viewers > 0; }

void VideoServer::offer(VideoFrame frame) { impl_->offer(std::move(frame)); }

device::DeviceReport VideoServer::report() const {
  device::DeviceReport report = impl_->thread.report();
  if (report.state == device::DeviceState::kOk) {
    report.text = impl_->address;
    report.last_good_s = clock_monotonic_s();
  }
  report.readings["video_viewers"] = impl_->viewers;
  report.counters["video_requests"] = impl_->counters.requests;
  report.counters["video_frames_sent"] = impl_->counters.sent;
  report.counters["video_turned_away"] = impl_->counters.turned_away;
  report.counters["video_malformed"] = impl_->counters.malformed;
  report.counters["video_stalled"] = impl_->counters.stalled;
  report.counters["video_uncoded"] = impl_->counters.uncoded;
  return report;
}

}  // namespace ols::video
