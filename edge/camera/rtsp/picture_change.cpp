#include "edge/camera/rtsp/picture_change.h"

#include <cstring>

namespace ols::camera {
namespace {

constexpr std::size_t kMostSeen = 1000;  // pictures: some key frame intervals
constexpr int kEvery = 8;                // rows: a live picture has noise everywhere

std::uint64_t print_of(const cv::Mat& gray) {
  std::uint64_t print = 14695981039346656037ULL;  // FNV-1a, by words
  for (int row = 0; row < gray.rows; row += kEvery) {
    const std::uint8_t* bytes = gray.ptr(row);
    for (int at = 0; at + 8 <= gray.cols; at += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + at, sizeof word);
      print = (print ^ word) * 1099511628211ULL;
      print ^= print >> 29U;
    }
  }
  return print;
}

}  // namespace

double PictureChange::unchanged_s(const cv::Mat& gray, double arrival_s) {
  if (seen_.size() > kMostSeen) seen_.clear();
  if (seen_.insert(print_of(gray)).second) since_s_ = arrival_s;
  return arrival_s - since_s_;
}

}  // namespace ols::camera
