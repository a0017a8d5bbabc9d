#include "central/ground/lost_places.h"

#include <algorithm>
#include <cmath>

namespace ols::fusion {
namespace {

constexpr double kLost = 0.9;            // where something stands
constexpr double kFirstLogOdds = -9.21;  // 1 : 10 000
// So that the end of an obstacle is noticed after a few passes.
constexpr double kMostLogOdds = 9.21;
constexpr double kProbable = 0.5, kAlmostCertain = 0.999;
constexpr double kNearer = 0.9;  // a target at this share of the distance may be before it

}  // namespace

LostPlaces::Cell LostPlaces::cell_of(const AzimuthElevation& direction) {
  const auto index = [](double angle_rad, int count) {
    return std::clamp(static_cast<int>(std::floor(angle_rad / kCell_rad)), 0, count - 1);
  };
  return {index(wrap_two_pi(direction.azimuth_rad), kAround),
          index(direction.elevation_rad - kLowest_rad, kUpwards)};
}

double LostPlaces::probability(double log_odds) {
  return 1.0 / (1.0 + std::exp(-kFirstLogOdds - log_odds));
}

// At the elevations at which targets were lost.
double LostPlaces::most_probable(const Column& column) {
  const auto begin = column.log_odds.begin();
  return probability(*std::max_element(begin + column.lowest, begin + column.highest + 1));
}

// One loss in 20 passes is assumed before anything is known. A share below 1 % is never believed:
// losses come in clusters.
double LostPlaces::by_chance() const {
  return std::max(0.01, (1.0 + first_losses_) / (20.0 + passes_));
}

void LostPlaces::seen(const Cell& cell, double distance_m) {
  ++passes_;
  const auto found = columns_.find(cell.azimuth);
  if (found == columns_.end() || distance_m < kNearer * found->second.from_m) return;
  const double by = std::log((1.0 - kLost) / (1.0 - by_chance()));
  auto& log_odds = found->second.log_odds;
  for (int i = cell.elevation; i < kUpwards; ++i) {
    double& one = log_odds[static_cast<std::size_t>(i)];
    one = std::max(0.0, one + by);
  }
  if (most_probable(found->second) <= probability(0.0)) columns_.erase(found);
}

// Losses that repeat are not by chance.
void LostPlaces::lost(const Cell& cell, double distance_m) {
  ++passes_;
  const auto [found, is_first] = columns_.try_emplace(cell.azimuth, Column{.from_m = distance_m});
  if (is_first) ++first_losses_;
  Column& column = found->second;
  const double by = std::log(kLost / by_chance());
  for (int i = 0; i <= cell.elevation; ++i) {
    double& one = column.log_odds[static_cast<std::size_t>(i)];
    one = std::min(one + by, kMostLogOdds - kFirstLogOdds);
  }
  column.from_m = std::min(column.from_m, distance_m);
  column.lowest = std::min(column.lowest, cell.elevation);
  column.highest = std::max(column.highest, cell.elevation);
}

double LostPlaces::probability(const AzimuthElevation& direction, double distance_m) const {
  const Cell cell = cell_of(direction);
  const auto found = columns_.find(cell.azimuth);
  if (found == columns_.end() || distance_m < kNearer * found->second.from_m) return 0.0;
  return probability(found->second.log_odds[static_cast<std::size_t>(cell.elevation)]);
}

bool LostPlaces::is_probable(int azimuth) const {
  const auto found = columns_.find((azimuth + kAround) % kAround);
  return found != columns_.end() && most_probable(found->second) >= kProbable;
}

std::vector<LostPlace> LostPlaces::places() const {
  std::vector<LostPlace> places;
  for (const auto& [azimuth, first] : columns_) {
    if (!is_probable(azimuth) || is_probable(azimuth - 1)) continue;  // not the first of a region
    double certainty = 0.0;
    int lowest = kUpwards, highest = 0, to = azimuth;
    for (; is_probable(to) && to < azimuth + kAround; ++to) {
      const Column& column = columns_.at(to % kAround);
      certainty = std::max(certainty, most_probable(column));
      lowest = std::min(lowest, column.lowest);
      highest = std::max(highest, column.highest);
    }
    if (certainty < kAlmostCertain) continue;
    places.push_back({azimuth * kCell_rad, wrap_two_pi(to * kCell_rad),
                      kLowest_rad + lowest * kCell_rad, kLowest_rad + (highest + 1) * kCell_rad});
  }
  return places;
}

}  // namespace ols::fusion
