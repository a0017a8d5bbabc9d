// One recorded event on disk: raw PNG frames named by utime (for a Bayer camera, the mosaic), and
// frames.csv with `utime_us,number,file,mid_exposure_sd_s,pixel_format`. The folder's name is
// NAME.partial until it is complete.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "edge/recorder/frame_memory.h"

namespace ols::recorder {

inline constexpr const char* kPartial = ".partial";

// Encodes without loss and with the least effort, because the tracker needs the processor. Throws
// cv::Exception.
std::vector<unsigned char> encode_png(const RecordedFrame& frame);

// All functions throw std::system_error with the path. Data already written remain.
class EventFolder {
 public:
  EventFolder(const std::string& store, const std::string& name);

  // Returns the number of bytes written. A frame that could not be written leaves nothing behind.
  std::size_t write(const RecordedFrame& frame, const std::vector<unsigned char>& png);
  bool exists() const;
  // Flushes to disk and gives the event its final name. May be retried.
  void finish();
  // Removes an event that has no frame.
  void discard();

 private:
  std::string path_;  // without kPartial
};

}  // namespace ols::recorder
