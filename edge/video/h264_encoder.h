// Encodes one viewer's pictures as an H.264 stream, for slow links. Each access unit refers to the
// previous one, so all of them must reach the viewer, in order. The caller decides which pictures
// are encoded, and must send each unit. Pure: the same pictures give the same bytes.
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
  // `quality`: on the scale of JPEG. The unit is a key frame if `key_frame` is set, if it is the
  // first one, or if size or quality have changed. Returns empty if the encoder fails.
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
