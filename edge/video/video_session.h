// One viewer of a station's video. Used only by the video server's thread.
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
    kIdle,       // made no request
    kStalled,    // read nothing
    kMalformed,  // sent an invalid request
    kUncoded,    // requested a picture that cannot be coded
  };
  struct Callbacks {
    // A request has come: answer() it, now or later.
    std::function<void(VideoSession&)> asked;
    // Nothing is called after this.
    std::function<void(VideoSession&, End)> ended;
  };

  VideoSession(boost::asio::ip::tcp::socket socket, Callbacks callbacks);

  void begin() { read_request(); }
  // The request that waits for an answer; nullopt: none.
  const std::optional<VideoRequest>& request() const { return request_; }
  void answer(const Bytes& message);
  // The number of the last frame sent to it; -1: none yet.
  std::int64_t had() const { return had_; }
  void note_had(std::int64_t frame) { had_ = frame; }
  // The encoder of this connection: every unit that it makes must be sent here, and nowhere else.
  H264Encoder& stream() { return stream_; }
  void close(End end);

 private:
  void read_request();
  void read_body(std::uint32_t length);
  void take(std::span<const std::uint8_t> body);
  // Ends the session unless another step begins in time.
  void expect_within(double seconds, End otherwise);

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  Callbacks callbacks_;
  LengthPrefix prefix_{};
  std::array<std::uint8_t, kLargestRequest_bytes> body_{};
  std::optional<VideoRequest> request_;
  Bytes sent_;  // being sent
  H264Encoder stream_;
  std::int64_t had_ = -1;
  bool ended_ = false;
};

}  // namespace ols::video
