// The stream channel of a simulated GigE Vision camera: sends an image as packets, and resends
// packets that the client has lost.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <random>
#include <thread>

#include "sim/camera/gige_device.h"
#include "sim/camera/gige_wire.h"

namespace ols::sim {

class GigeStream {
 public:
  // Sends from `address` (network byte order), in its own thread. Throws std::system_error.
  explicit GigeStream(std::uint32_t address);
  ~GigeStream();
  GigeStream(const GigeStream&) = delete;
  GigeStream& operator=(const GigeStream&) = delete;

  // An image to draw into. It may reuse the memory of the oldest frame, which is then no longer
  // available for resend.
  cv::Mat blank(int width_px, int height_px, int type);
  // Sends the image at the packet rate that the client has set, and keeps it for resend(). Normally
  // returns at once; waits if images come faster than they can be sent at that rate.
  void send(const StreamSettings& settings, const gige::Picture& description,
            const cv::Mat& picture);
  void resend(const ResendRequest& request);

  // Sets the share of packets that are lost from now on, and whether they are resent on request.
  void set_loss(double share, bool can_resend);

 private:
  struct Sent {
    StreamSettings settings;
    gige::Picture description;
    cv::Mat picture;
  };
  void run();
  void send_paced(const Sent& sent);
  void send_packet(const Sent& sent, std::uint32_t packet, gige::Status status) const;
  bool loses_one();

  int fd_ = -1;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<const Sent>> waiting_;  // to be sent
  std::deque<std::shared_ptr<const Sent>> sent_;     // sent or being sent; newest last
  bool stop_ = false;

  std::mutex loss_mutex_;
  std::mt19937_64 generator_;
  double loss_ = 0.0;
  bool can_resend_ = true;

  std::thread thread_;
};

}  // namespace ols::sim
