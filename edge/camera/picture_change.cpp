#include "edge/camera/picture_change.h"

#include <boost/container_hash/hash.hpp>
#include <functional>
#include <string_view>

namespace ols::camera {
namespace {

constexpr std::size_t kMostSeen = 1000;  // pictures: some key frame intervals
constexpr int kEvery = 8;                // rows: a live picture has noise everywhere

std::size_t print_of(const cv::Mat& gray) {
  std::size_t print = 0;
  for (int row = 0; row < gray.rows; row += kEvery) {
    const std::string_view bytes(gray.ptr<char>(row), static_cast<std::size_t>(gray.cols));
    boost::hash_combine(print, std::hash<std::string_view>{}(bytes));
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
