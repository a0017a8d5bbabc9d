// Encodes requested frames as picture files, in its own thread. An encoder takes tens of
// milliseconds, and the control loop must not wait for it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "edge/frames/frame_service.h"

namespace ols::station {

struct EncodedFrame {
  RequestedFrame frame;
  std::vector<std::uint8_t> file;
};

class FramePost {
 public:
  FramePost();
  ~FramePost() = default;  // waits for the frame that is being encoded
  FramePost(const FramePost&) = delete;
  FramePost& operator=(const FramePost&) = delete;

  // Returns false if too many frames are waiting. The frame is then dropped and must be requested
  // again.
  bool put(RequestedFrame frame);
  std::optional<EncodedFrame> take();

 private:
  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::condition_variable encoded_;
  std::deque<RequestedFrame> waiting_;
  std::deque<EncodedFrame> done_;
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace ols::station
