// One event on the disk: PNG frames named by utime, as the camera sent them (of a Bayer camera the
// mosaic), and frames.csv with `utime_us,number,file,mid_exposure_sd_s,pixel_format`. It is
// NAME.partial until it is complete.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "edge/recorder/frame_memory.h"

namespace ols::recorder {

inline constexpr const char* kPartial = ".partial";

// Without loss, and with the least effort: the tracker needs the processor. Throws cv::Exception.
std::vector<unsigned char> encode_png(const RecordedFrame& frame);

// All throw std::system_error naming the path; what was written before stays.
class EventFolder {
 public:
  EventFolder(const std::string& store, const std::string& name);

  // Bytes that it took on the disk. A frame that could not be written leaves nothing behind.
  std::size_t write(const RecordedFrame& frame, const std::vector<unsigned char>& png);
  bool exists() const;
  // On the disk for good, and under its name. May be tried again.
  void finish();
  // Of an event without a frame.
  void discard();

 private:
  std::string path_;  // without kPartial
};

}  // namespace ols::recorder
