// One viewer's pictures as a stream of H.264, for thin links. Each access unit refers to the one
// before it, so all of them must reach the viewer, in order. The caller decides which pictures
// become units, and must send each. Pure: the same pictures give the same bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

class ISVCEncoder;

namespace ols::video {

class H264Encoder {
 public:
  H264Encoder() = default;

  // Encodes the next picture (8-bit, one channel, even sides) as an access unit (Annex B).
  // `quality`: as for JPEG. It is a key frame if `key_frame` is set, if it is the first, or if size
  // or quality have changed. Empty: the encoder cannot.
  std::vector<std::uint8_t> encode(const cv::Mat& gray, int quality, bool key_frame,
                                   std::int64_t utime_us);

 private:
  struct Destroy {
    void operator()(ISVCEncoder* encoder) const;
  };

  bool open(const cv::Size& size, int quality);

  std::unique_ptr<ISVCEncoder, Destroy> encoder_;
  cv::Size size_;
  int quality_ = 0;
  std::vector<std::uint8_t> no_colour_;
};

}  // namespace ols::video
