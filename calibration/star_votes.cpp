#include "calibration/star_votes.h"

#include <algorithm>
#include <cmath>

#include "calibration/systematic.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

// Wide enough for what a turn and a lift leave: the roll that a tilt makes, some pixels of scale.
constexpr double kCell_rad = 0.15 * kPi / 180.0;
constexpr double kSigmas = 3.0;
constexpr std::size_t kPeaks = 8;       // of a frame
constexpr std::size_t kHypotheses = 6;  // that are worth a fit

double slack_rad(double sd_rad) { return kSigmas * sd_rad + kCell_rad; }

}  // namespace

int StarVotes::Cells::block(int turn, int lift) const {
  int sum = 0;
  for (const int t : {wrapped(turn), wrapped(turn + 1)}) {
    for (const int l : {lift, lift + 1}) {
      if (l < lifts) sum += votes[static_cast<std::size_t>(l * turns + t)];
    }
  }
  return sum;
}

StarVotes::StarVotes(const StationPrior& station, std::span<const StarFrame> frames,
                     const StarConditions& conditions, std::span<const TableStar> table) {
  std::vector<Star> stars;
  stars.reserve(table.size());
  for (const TableStar& star : table) stars.push_back(star_of(star));
  for (const StarFrame& frame : frames) {
    frames_.push_back(seen(station, frame, conditions, stars));
    cells_.push_back(cells_of(frames_.back()));
  }
}

SeenFrame StarVotes::seen(const StationPrior& station, const StarFrame& frame,
                          const StarConditions& conditions, const std::vector<Star>& stars) const {
  StationModel model = station.model;
  model.geometry.chain.heading_rad = 0.0;
  const CameraIntrinsics& camera = model.geometry.camera;
  SeenFrame result;
  result.reading = frame.reading;
  const Eigen::Vector2d middle((camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0);
  const auto axis = systematic_direction(model, station.covariance, frame.reading, middle);
  if (!axis) return result;
  result.axis = axis->direction;
  result.across_sd_rad = std::sqrt(axis->covariance_rad2(0, 0));
  result.up_sd_rad = std::sqrt(axis->covariance_rad2(1, 1));
  double lowest = axis->direction.elevation_rad, highest = lowest;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const auto at = predict_direction(model, frame.reading, frame.pixels[i]);
    if (!at) continue;
    result.detections.push_back({i, frame.pixels[i], at->direction});
    lowest = std::min(lowest, at->direction.elevation_rad);
    highest = std::max(highest, at->direction.elevation_rad);
  }
  const double slack = slack_rad(result.up_sd_rad);
  const double least_deg = std::max(kLeastElevation_deg, degrees(lowest - slack) - 0.1);
  const Geodetic& place = model.geometry.position;
  for (const auto& [index, direction] :
       stars_between(stars, least_deg, degrees(highest + slack), frame.utime_us, place,
                     conditions.air, conditions.earth)) {
    const Eigen::Vector3d enu = R_ecef_enu(place).transpose() * direction.ecef;
    result.sky.push_back({index, enu, azimuth_elevation_from_enu(enu)});
  }
  return result;
}

StarVotes::Cells StarVotes::cells_of(const SeenFrame& frame) const {
  Cells cells;
  const double across = std::max(0.1, std::cos(frame.axis.elevation_rad));
  cells.turns = static_cast<int>(std::ceil(2.0 * kPi * across / kCell_rad));
  cells.lifts = static_cast<int>(std::ceil(2.0 * slack_rad(frame.up_sd_rad) / kCell_rad)) + 1;
  cells.votes.assign(static_cast<std::size_t>(cells.turns) * static_cast<std::size_t>(cells.lifts),
                     0);
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    for (std::size_t j = 0; j < frame.sky.size(); ++j) {
      const auto [turn, lift] = cell(frame, cells, i, j);
      if (lift < 0 || lift >= cells.lifts) continue;
      ++cells.votes[static_cast<std::size_t>(lift * cells.turns + turn)];
    }
  }
  return cells;
}

std::pair<int, int> StarVotes::cell(const SeenFrame& frame, const Cells& cells, std::size_t seen,
                                    std::size_t star) const {
  const AzimuthElevation &from = frame.detections[seen].at, &to = frame.sky[star].at;
  const double share = wrap_two_pi(to.azimuth_rad - from.azimuth_rad) / (2.0 * kPi);
  const double up = to.elevation_rad - from.elevation_rad + slack_rad(frame.up_sd_rad);
  return {cells.wrapped(static_cast<int>(share * cells.turns)),
          static_cast<int>(std::floor(up / kCell_rad))};
}

std::vector<StarVotes::Peak> StarVotes::peaks(std::size_t frame) const {
  const Cells& cells = cells_[frame];
  std::vector<Peak> all;
  for (int lift = 0; lift < cells.lifts; ++lift) {
    for (int turn = 0; turn < cells.turns; ++turn) {
      const int votes = cells.block(turn, lift);
      if (votes > 2) all.push_back({frame, turn, lift, votes});
    }
  }
  std::ranges::stable_sort(all, std::greater{}, &Peak::votes);
  std::vector<Peak> chosen;
  for (const Peak& one : all) {
    const bool beside = std::ranges::any_of(chosen, [&](const Peak& other) {
      const int turns = std::abs(one.turn - other.turn);
      return std::min(turns, cells.turns - turns) <= 2 && std::abs(one.lift - other.lift) <= 2;
    });
    if (!beside) chosen.push_back(one);
    if (chosen.size() == kPeaks) break;
  }
  return chosen;
}

StarVotes::Peak StarVotes::nearby(std::size_t frame, double heading_rad, double slack) const {
  const Cells& cells = cells_[frame];
  const double middle = wrap_two_pi(heading_rad) / (2.0 * kPi) * cells.turns;
  const int around = static_cast<int>(std::ceil(slack / (2.0 * kPi) * cells.turns)) + 1;
  Peak best{frame, 0, 0, 0};
  for (int turn = static_cast<int>(middle) - around; turn <= static_cast<int>(middle) + around;
       ++turn) {
    for (int lift = 0; lift < cells.lifts; ++lift) {
      const int votes = cells.block(cells.wrapped(turn), lift);
      if (votes > best.votes) best = {frame, cells.wrapped(turn), lift, votes};
    }
  }
  return best;
}

void StarVotes::add_pairs(const Peak& peak, StarHypothesis& to) const {
  const SeenFrame& frame = frames_[peak.frame];
  const Cells& cells = cells_[peak.frame];
  to.votes += peak.votes;
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    for (std::size_t j = 0; j < frame.sky.size(); ++j) {
      const auto [turn, lift] = cell(frame, cells, i, j);
      const bool inside = (turn == peak.turn || turn == cells.wrapped(peak.turn + 1)) &&
                          (lift == peak.lift || lift == peak.lift + 1);
      if (inside) to.pairs.push_back({peak.frame, i, j});
    }
  }
}

StarHypothesis StarVotes::hypothesis(const Peak& peak) const {
  StarHypothesis result;
  const SeenFrame& frame = frames_[peak.frame];
  result.heading_rad = wrap_pi(2.0 * kPi * (peak.turn + 1.0) / cells_[peak.frame].turns);
  add_pairs(peak, result);
  for (std::size_t other = 0; other < frames_.size(); ++other) {
    if (other == peak.frame || cells_[other].turns == 0) continue;
    const auto turned = [](const SeenFrame& of) {
      return of.across_sd_rad / std::max(0.1, std::cos(of.axis.elevation_rad));
    };
    const double slack = slack_rad(std::hypot(turned(frame), turned(frames_[other])));
    const Peak there = nearby(other, result.heading_rad, slack);
    if (there.votes > 2) add_pairs(there, result);
  }
  return result;
}

std::vector<StarHypothesis> StarVotes::hypotheses() const {
  std::vector<StarHypothesis> all;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    if (cells_[f].turns == 0) continue;
    for (const Peak& peak : peaks(f)) all.push_back(hypothesis(peak));
  }
  std::ranges::stable_sort(all, std::greater{}, &StarHypothesis::votes);
  std::vector<StarHypothesis> chosen;
  for (StarHypothesis& one : all) {
    const bool known = std::ranges::any_of(chosen, [&](const StarHypothesis& other) {
      return std::abs(wrap_pi(one.heading_rad - other.heading_rad)) < kCell_rad;
    });
    if (!known) chosen.push_back(std::move(one));
    if (chosen.size() == kHypotheses) break;
  }
  return chosen;
}

}  // namespace ols::calibration
