// The stream channel of a simulated GigE Vision camera: a picture as packets on the wire, and again
// the packets that the client has lost.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <random>

#include "tools/sim/gige_device.h"
#include "tools/sim/gige_wire.h"

namespace ols::sim {

class GigeStream {
 public:
  // Sends from `address` (network byte order). Throws std::system_error.
  explicit GigeStream(std::uint32_t address);
  ~GigeStream();
  GigeStream(const GigeStream&) = delete;
  GigeStream& operator=(const GigeStream&) = delete;

  // A picture to draw into: one whose frame can no longer be asked for again.
  cv::Mat blank(int width_px, int height_px);
  // Sends the picture and keeps it for resend().
  void send(const StreamSettings& settings, const gige::Picture& description,
            const cv::Mat& picture);
  void resend(const ResendRequest& request);

  // From now on this share of packets gets lost; and whether lost ones are sent again.
  void set_loss(double share, bool can_resend);

 private:
  struct Sent {
    StreamSettings settings;
    gige::Picture description;
    cv::Mat picture;
  };
  void send_packet(const Sent& sent, std::uint32_t packet, gige::Status status) const;
  bool loses_one();

  int fd_ = -1;
  std::mutex mutex_;
  std::deque<std::shared_ptr<const Sent>> sent_;  // the newest last

  std::mutex loss_mutex_;
  std::mt19937_64 generator_;
  double loss_ = 0.0;
  bool can_resend_ = true;
};

}  // namespace ols::sim
