#include "edge/camera/rtsp/picture_change.h"

#include <cstring>

namespace ols::camera {
namespace {

constexpr int kEvery = 8;  // rows: a live picture has noise everywhere

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
  const std::uint64_t print = print_of(gray);
  if (print_ != print) since_s_ = arrival_s;
  print_ = print;
  return arrival_s - since_s_;
}

}  // namespace ols::camera
