// The console's connection to one station's video socket (docs/video.md). Requests the newest
// picture again and again, with the wanted size and quality; reconnects after a failure. Use it
// only in the thread of the io_context.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/net/length_prefix.h"
#include "console/received.h"

namespace ols::console {

// What is requested from every station.
struct VideoWish {
  int max_width_px = 960;
  int quality = 65;
  // Quality of H.264. In the demo, H.264 of this quality needs a tenth of the data rate of JPEG.
  int thin_quality = 45;
  double interval_s = 0.0;  // pause between a picture and the next request
  Codec codec = Codec::kJpeg;
};

class VideoLink : public std::enable_shared_from_this<VideoLink> {
 public:
  // Receives the bytes of a whole video_frame_t. Returns the frame's utime, so that the next
  // request asks for a later picture. nullopt: the bytes are not a frame; the connection is then
  // closed.
  using Take = std::function<std::optional<std::int64_t>(std::vector<std::uint8_t>)>;

  VideoLink(boost::asio::io_context& io, const boost::asio::ip::tcp::endpoint& endpoint,
            const VideoWish& wish, Take take);

  void begin() { connect(); }
  // Ends the connection. `take` is not called any more.
  void end();

 private:
  using Error = boost::system::error_code;
  template <class Next>
  auto unless_it_fails(Next next);
  void connect();
  void ask();
  void receive();
  void receive_body(std::uint32_t length);
  void taken();
  void fail();
  // Closes the connection unless the next step begins within this time.
  void expect_within(double seconds);

  const boost::asio::ip::tcp::endpoint endpoint_;
  const VideoWish wish_;
  const Take take_;
  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  LengthPrefix prefix_{};
  std::vector<std::uint8_t> request_, answer_;
  std::int64_t last_utime_us_ = 0;
  int taken_ = 0;  // pictures received over this connection
  bool has_ended_ = false;
};

}  // namespace ols::console
