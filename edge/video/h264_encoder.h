// Encodes one viewer's pictures as an H.264 stream, for slow networks. An access unit (a coded
// picture) refers to the previous one. Therefore, the caller must send every unit to the viewer, in
// order. Pure: the same pictures give the same bytes.
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

  // Encodes the next picture (8-bit, one channel, even width and height) as an access unit in the
  // format of Annex B. `quality`: 1 to 100, as for JPEG. The unit is a key frame if `key_frame` is
  // set, if it is the first one, or if the size or the quality has changed. Returns an empty vector
  // if the encoder fails.
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
