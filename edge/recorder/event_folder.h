// The folder of one recorded event. Contains the raw frames (for a Bayer camera, the mosaics) as
// PNG files named by their utime, and frames.csv with the columns
// `utime_us,number,file,mid_exposure_sd_s,pixel_format,stamp_source`. The folder's name is
// NAME.partial until the event is complete.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "edge/recorder/frame_memory.h"

namespace ols::recorder {

inline constexpr const char* kPartial = ".partial";

// Encodes without loss and at the lowest compression, because the tracker needs the processor.
// Throws cv::Exception.
std::vector<unsigned char> encode_png(const RecordedFrame& frame);

// All functions throw std::system_error with the path on a failure. Files that were written before
// a failure remain.
class EventFolder {
 public:
  EventFolder(const std::string& store, const std::string& name);

  // Returns the number of bytes written. If a frame cannot be written, its incomplete file is
  // removed.
  std::size_t write(const RecordedFrame& frame, const std::vector<unsigned char>& png);
  bool exists() const;
  // Flushes all data to the disk and gives the folder its final name. May be called again after a
  // failure.
  void finish();
  // Removes the folder of an event that has no frames.
  void discard();

 private:
  std::string path_;  // final path, without kPartial
};

}  // namespace ols::recorder
