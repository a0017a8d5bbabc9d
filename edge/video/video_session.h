// The connection of one viewer of a station's video. Only the video server's thread uses it.
#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/net/length_prefix.h"
#include "edge/video/messages_video.h"

namespace ols::video {

class VideoSession : public std::enable_shared_from_this<VideoSession> {
 public:
  using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;
  enum class End {
    kGone,       // closed by the viewer, or the connection is lost
    kIdle,       // the viewer made no request
    kStalled,    // the viewer read nothing
    kMalformed,  // the viewer sent an invalid request
    kUncoded,    // the viewer requested a picture that cannot be coded
  };
  struct Callbacks {
    // Called for each request. The owner must then answer the request with answer(), at once or
    // later.
    std::function<void(VideoSession&)> asked;
    // Called once, when the connection ends; no callback is called after this one.
    std::function<void(VideoSession&, End)> ended;
  };

  VideoSession(boost::asio::ip::tcp::socket socket, Callbacks callbacks);

  void begin() { read_request(); }
  // The request that is waiting for its answer; nullopt if there is none.
  const std::optional<VideoRequest>& request() const { return request_; }
  void answer(const Bytes& message);
  // The number of the last frame that was sent to the viewer; -1 if none was.
  std::int64_t had() const { return had_; }
  void note_had(std::int64_t frame) { had_ = frame; }
  // The encoder of this connection. Every unit that it makes must be sent on this connection, and
  // on no other.
  H264Encoder& stream() { return stream_; }
  void close(End end);

 private:
  void read_request();
  void read_body(std::uint32_t length);
  void take(std::span<const std::uint8_t> body);
  // Ends the session with the reason `otherwise` after `seconds`, unless the timer is set again or
  // cancelled before.
  void expect_within(double seconds, End otherwise);

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  Callbacks callbacks_;
  LengthPrefix prefix_{};
  std::array<std::uint8_t, kLargestRequest_bytes> body_{};
  std::optional<VideoRequest> request_;
  Bytes sent_;  // the message that is being sent
  H264Encoder stream_;
  std::int64_t had_ = -1;
  bool ended_ = false;
};

}  // namespace ols::video
