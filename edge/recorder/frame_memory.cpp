#include "edge/recorder/frame_memory.h"

namespace ols::recorder {

std::size_t bytes_of(const RecordedFrame& frame) {
  return frame.picture.total() * frame.picture.elemSize();
}

void FrameMemory::add(const RecordedFrame& frame) {
  frames_.push_back(frame);
  bytes_ += bytes_of(frame);
  while (!frames_.empty() &&
         (frames_.front().mid_exposure_s < frames_.back().mid_exposure_s - span_s_ ||
          static_cast<double>(bytes_) > most_bytes_)) {
    bytes_ -= bytes_of(frames_.front());
    frames_.pop_front();
  }
}

std::vector<RecordedFrame> FrameMemory::between(double from_s, double to_s) const {
  std::vector<RecordedFrame> found;
  for (const RecordedFrame& frame : frames_) {
    if (frame.mid_exposure_s >= from_s && frame.mid_exposure_s <= to_s) found.push_back(frame);
  }
  return found;
}

}  // namespace ols::recorder
