#include "edge/detector/appearance_book.h"

#include <algorithm>
#include <utility>

namespace ols::detector {
namespace {

constexpr double kLeast = 0.5;    // of the usual response
constexpr double kEvery_s = 0.1;  // between two images that are learnt
constexpr std::size_t kMost = 8;  // appearances; each costs half a millisecond an image

bool can_be_learnt(const Tracklet& tracklet) {
  return tracklet.confirmed() && tracklet.seen() && !tracklet.path();
}

}  // namespace

void AppearanceBook::next_image(const cv::Mat& gray, double time_s) {
  image_.gray = gray;
  image_.time_s = time_s;
}

std::optional<Eigen::Vector2d> AppearanceBook::find(const Tracklet& tracklet) {
  const auto known = known_.find(tracklet.id());
  if (known == known_.end()) return std::nullopt;
  return known->second.appearance.find(image_, {tracklet.pixel()}, tracklet.size_px(), kLeast);
}

void AppearanceBook::learn(const std::vector<Tracklet>& tracklets) {
  std::erase_if(known_, [&](const auto& known) {
    return std::ranges::none_of(tracklets, [&](const Tracklet& tracklet) {
      return tracklet.id() == known.first && tracklet.confirmed();
    });
  });
  for (const Tracklet& tracklet : tracklets) {
    if (!can_be_learnt(tracklet)) continue;
    const auto known = known_.find(tracklet.id());
    if (known != known_.end()) {
      learn(known->second, tracklet);
    } else if (known_.size() < kMost) {
      tracker::LearntAppearance first(image_, tracklet.pixel(), tracklet.size_px());
      known_.emplace(tracklet.id(), Known{std::move(first), image_.time_s});
    }
  }
}

void AppearanceBook::learn(Known& known, const Tracklet& tracklet) const {
  const double since_s = image_.time_s - known.learnt_s;
  if (since_s < kEvery_s) return;
  known.learnt_s = image_.time_s;
  known.appearance.find(image_, {tracklet.pixel()}, tracklet.size_px(), kLeast);
  known.appearance.learn(image_, tracklet.pixel(), tracklet.size_px(), since_s);
}

}  // namespace ols::detector
