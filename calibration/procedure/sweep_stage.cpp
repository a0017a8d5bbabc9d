#include "calibration/procedure/sweep_stage.h"

namespace ols::calibration {

SweepStage::SweepStage(const StationGeometry& geometry, std::vector<Shot> shots)
    : shots_(std::move(shots)), tracks_(geometry) {}

std::optional<Order> SweepStage::next() {
  if (at_ >= shots_.size()) return std::nullopt;
  Order order;
  order.step = "sweep, picture " + std::to_string(at_ + 1) + " of " + std::to_string(shots_.size());
  order.shot = shots_[at_];
  return order;
}

void SweepStage::taken(const Taken& picture) {
  waiting_.push_back(picture);
  step();
}

bool SweepStage::work() {
  if (waiting_.empty()) return false;
  Taken picture = std::move(waiting_.front());
  waiting_.pop_front();
  tracks_.add(picture.gray, picture.angles);
  picture.gray.release();
  taken_.push_back(std::move(picture));
  return !waiting_.empty();
}

// One picture less is no harm; who stands in the way of many should be known.
void SweepStage::not_taken(const std::string& why) {
  constexpr int kNamed = 3;
  if (++missed_ <= kNamed) {
    remark("sweep: picture " + std::to_string(at_ + 1) + " is missing: " + why);
  }
  step();
}

void SweepStage::step() {
  if (++at_ < shots_.size()) return;
  while (work()) continue;
  if (missed_ > 0) remark("sweep: " + std::to_string(missed_) + " pictures are missing");
  const int pairs = static_cast<int>(tracks_.pairs().size());
  if (tracks_.moving_pairs() * 4 > pairs) {
    remark("sweep: the scene moves (" + std::to_string(tracks_.moving_pairs()) + " of " +
           std::to_string(pairs) +
           " pairs of pictures): wait for less wind or traffic, or lower the ring");
  }
  if (observations().empty()) {
    remark("sweep: nothing in the pictures could be found again: sky, fog or darkness");
  }
}

std::vector<Observation> SweepStage::observations() const {
  std::vector<Observation> result;
  for (const SceneSighting& one : tracks_.sightings()) {
    result.push_back(observation_of(Kind::kScene, taken_[one.picture], one.pixel, one.sd_px,
                                    std::to_string(one.track)));
  }
  return result;
}

double SweepStage::progress() const {
  return shots_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(shots_.size());
}

}  // namespace ols::calibration
