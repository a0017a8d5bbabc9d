#include "calibration/contradiction_cause.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <utility>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

bool all_agree(const Problem& problem, const Levels& levels) {
  try {
    const Calibration found = calibrate(Adjustment(network_of(problem)), levels);
    return found.scaled_by == 1.0 && std::ranges::none_of(found.tests, &GroupTest::rejected);
  } catch (const std::exception&) {
    return false;  // what is refused, or contradicts itself in another way, explains nothing
  }
}

void add_exchanged(const Problem& problem, const Levels& levels, std::vector<std::string>& causes) {
  // Each two of them cost an adjustment.
  constexpr std::size_t kMost = 12;
  std::set<std::string> names;
  for (const Observation& one : problem.observations) {
    if (one.kind == Kind::kLandmark) names.insert(one.reference);
  }
  if (names.size() > kMost) return;
  for (auto a = names.begin(); a != names.end(); ++a) {
    for (auto b = std::next(a); b != names.end(); ++b) {
      Problem exchanged = problem;
      std::swap(exchanged.references.at(*a), exchanged.references.at(*b));
      if (!all_agree(exchanged, levels)) continue;
      causes.push_back("all agree if landmarks '" + *a + "' and '" + *b + "' were exchanged");
    }
  }
}

void add_hemispheres(const Problem& problem, const Levels& levels,
                     std::vector<std::string>& causes) {
  for (std::size_t s = 0; s < problem.stations.size(); ++s) {
    for (const auto& [south, west] : {std::pair{true, false}, {false, true}, {true, true}}) {
      Problem other = problem;
      Geodetic& place = other.stations[s].model.geometry.position;
      if (south) place.latitude_rad *= -1.0;
      if (west) place.longitude_rad *= -1.0;
      if (!all_agree(other, levels)) continue;
      char text[200];
      std::snprintf(text, sizeof text,
                    "all agree if station '%s' stands at latitude %.2f, longitude %.2f deg: is the "
                    "sign of its position wrong?",
                    problem.names[s].c_str(), degrees(place.latitude_rad),
                    degrees(place.longitude_rad));
      causes.emplace_back(text);
    }
  }
}

}  // namespace

std::vector<std::string> causes_of_contradiction(const Problem& problem, const Levels& levels) {
  std::vector<std::string> causes;
  add_exchanged(problem, levels, causes);
  const bool sees_sky = std::ranges::any_of(problem.observations, [](const Observation& one) {
    return one.kind == Kind::kStar || one.kind == Kind::kSun;
  });
  // Without the sky the distance of a reference tells.
  if (sees_sky) add_hemispheres(problem, levels, causes);
  return causes;
}

}  // namespace ols::calibration
