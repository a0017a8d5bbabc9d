#include "calibration/contradiction_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "calibration/snooping.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

// One adjustment of everything. Most mistakes that are tried explain nothing, and the search for
// what to reject then takes hundreds of adjustments.
bool fits_at_once(const Adjustment& adjustment, const Levels& levels) {
  const Start start = find_start(adjustment, levels.mistaken);
  const std::vector<bool> all(adjustment.groups().size(), true);
  const Fit fit = adjustment.fit(start.state, all);
  if (!fit.converged || !is_finite(fit)) return false;
  const std::vector<GroupTest> tests = tests_of(adjustment, fit, levels.mistaken);
  return std::ranges::all_of(tests, [](const GroupTest& one) { return one.w <= one.critical; });
}

// The adjustment in which no observation contradicts another; nullopt: there is none.
std::optional<Fit> agreement(const Problem& problem, Levels levels) {
  levels.misfit = levels.mistaken;  // one mistake in twenty must not stay unexplained
  try {
    const Adjustment adjustment(network_of(problem));
    if (!fits_at_once(adjustment, levels)) return std::nullopt;
    Calibration found = calibrate(adjustment, levels);
    const bool agree =
        found.scaled_by == 1.0 && std::ranges::none_of(found.tests, &GroupTest::rejected);
    return agree ? std::optional(std::move(found.fit)) : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;  // what is refused, or contradicts itself in another way
  }
}

bool all_agree(const Problem& problem, const Levels& levels) {
  return agreement(problem, levels).has_value();
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
      const std::string text = printed(
          "all agree if station '%s' stands at latitude %.2f, longitude %.2f deg: is the "
          "sign of its position wrong?",
          problem.names[s].c_str(), degrees(place.latitude_rad), degrees(place.longitude_rad));
      causes.emplace_back(text);
    }
  }
}

std::string metres_towards(double metres, const char* plus, const char* minus) {
  return printed("%.2f m %s", std::abs(metres), metres < 0.0 ? minus : plus);
}

// Its position is left to what it sights.
void add_positions(const Problem& problem, const Levels& levels, std::vector<std::string>& causes) {
  constexpr double kAnywhere_m = 100.0, kCritical = 3.29;
  for (std::size_t s = 0; s < problem.stations.size(); ++s) {
    Problem freed = problem;
    StationMatrix& C = freed.stations[s].covariance;
    for (const int k : {kEast, kNorth, kUp}) {
      C.row(k).setZero();
      C.col(k).setZero();
      C(k, k) = kAnywhere_m * kAnywhere_m;
    }
    const auto found = agreement(freed, levels);
    if (!found) continue;
    const StationVector& off = found->state.stations[s].change;
    const StationMatrix& stated = problem.stations[s].covariance;
    const bool is_allowed = std::ranges::all_of(std::array{kEast, kNorth, kUp}, [&](int k) {
      return std::abs(off[k]) <= kCritical * std::sqrt(stated(k, k));
    });
    if (is_allowed) continue;
    causes.push_back("all agree if station '" + problem.names[s] + "' stood " +
                     metres_towards(off[kEast], "to the east", "to the west") + ", " +
                     metres_towards(off[kNorth], "to the north", "to the south") + " and " +
                     metres_towards(off[kUp], "higher", "lower") +
                     ": is its position surveyed right?");
  }
}

Problem with_reversed(const Problem& problem, std::size_t station, AxisReading UnitReading::*axis,
                      int approach) {
  Problem reversed = problem;
  for (Observation& one : reversed.observations) {
    if (one.station != station) continue;
    AxisReading& reading = one.reading.*axis;
    reading.counts = -reading.counts;
    reading.counts_per_s = -reading.counts_per_s;
    reading.approach *= approach;
  }
  return reversed;
}

void add_reversed_axes(const Problem& problem, const Levels& levels,
                       std::vector<std::string>& causes) {
  struct Axis {
    const char *name, *sign;
    AxisReading UnitReading::*reading;
  };
  constexpr std::array<Axis, 2> kAxes{
      {{"pan", "pan_sign", &UnitReading::pan}, {"tilt", "tilt_sign", &UnitReading::tilt}}};
  for (std::size_t s = 0; s < problem.stations.size(); ++s) {
    for (const Axis& axis : kAxes) {
      // Where the counts alone are reversed, the directions of approach are those of the motor.
      if (!all_agree(with_reversed(problem, s, axis.reading, -1), levels) &&
          !all_agree(with_reversed(problem, s, axis.reading, 1), levels)) {
        continue;
      }
      causes.push_back(std::string("all agree if ") + axis.name + " of station '" +
                       problem.names[s] + "' counts the other way: is " + axis.sign + " wrong?");
    }
  }
}

void add_exchanged_pixels(const Problem& problem, const Levels& levels,
                          std::vector<std::string>& causes) {
  for (std::size_t s = 0; s < problem.stations.size(); ++s) {
    Problem exchanged = problem;
    for (Observation& one : exchanged.observations) {
      if (one.station == s) std::swap(one.pixel.x(), one.pixel.y());
    }
    if (!all_agree(exchanged, levels)) continue;
    causes.push_back("all agree if x_px and y_px of station '" + problem.names[s] +
                     "' were exchanged");
  }
}

// In a local grid, as seen from the only station.
void add_exchanged_coordinates(const Problem& problem, const Levels& levels,
                               std::vector<std::string>& causes) {
  if (problem.stations.size() != 1) return;
  const Eigen::Vector3d origin = ecef_from_geodetic(problem.stations[0].model.geometry.position);
  const Eigen::Matrix3d R = R_ecef_enu(problem.stations[0].model.geometry.position);
  Problem exchanged = problem;
  for (auto& [name, reference] : exchanged.references) {
    auto* point = std::get_if<FixedPoint>(&reference);
    if (!point) continue;
    Eigen::Vector3d enu = R.transpose() * (point->ecef - origin);
    std::swap(enu.x(), enu.y());
    point->ecef = origin + R * enu;
  }
  if (!all_agree(exchanged, levels)) return;
  causes.emplace_back("all agree if east and north of the landmarks were exchanged");
}

// A tripod that was turned, or a unit that lost its counts, between two sightings: from then on it
// is a station of its own.
class TurnSearch {
 public:
  TurnSearch(const Problem& problem, std::size_t station, const Levels& levels)
      : problem_(problem), station_(station), levels_(levels) {
    // Tracks are many, and no heading needs them.
    std::erase_if(problem_.observations,
                  [](const Observation& one) { return one.kind == Kind::kTrack; });
    for (std::size_t i = 0; i < problem_.observations.size(); ++i) {
      if (problem_.observations[i].station == station) order_.push_back(i);
    }
    const bool timed = std::ranges::all_of(order_, [this](std::size_t i) {
      const Observation& one = problem_.observations[i];
      return one.kind == Kind::kInclinometer || one.utime_us != 0;
    });
    if (timed) {
      std::ranges::stable_sort(order_, {},
                               [this](std::size_t i) { return problem_.observations[i].utime_us; });
    }
  }

  void run(std::vector<std::string>& causes) const {
    const std::vector<std::size_t> cuts = possible_cuts();
    if (cuts.empty()) return;
    // First some, then between the best's neighbours, until each place there is tried.
    constexpr std::size_t kTries = 20;
    std::size_t best = 0, from = 0, to = cuts.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t step = cuts.size();;) {
      step = std::min(step, to - from) / kTries + 1;
      for (std::size_t c = from; c < to; c += step) {
        const double misfit = misfit_of(cuts[c]);
        if (misfit >= least) continue;
        least = misfit;
        best = c;
      }
      if (step == 1) break;
      from = best < step ? 0 : best - step + 1;
      to = std::min(cuts.size(), best + step);
    }
    if (!std::isfinite(least)) return;
    const auto found = agreement(cut_at(cuts[best]), levels_);
    if (found) causes.push_back(sentence(cuts[best], *found));
  }

 private:
  // Places in the order before which the unit was driven elsewhere. A few sightings prove nothing:
  // a tripod of their own explains them, whatever is wrong.
  std::vector<std::size_t> possible_cuts() const {
    constexpr std::size_t kLeast = 4;
    std::vector<std::size_t> cuts;
    for (std::size_t k = kLeast; k + kLeast <= order_.size(); ++k) {
      const Observation& before = problem_.observations[order_[k - 1]];
      const Observation& after = problem_.observations[order_[k]];
      const bool same_pose = before.pose == after.pose && before.utime_us == after.utime_us &&
                             before.reading.pan.counts == after.reading.pan.counts &&
                             before.reading.tilt.counts == after.reading.tilt.counts;
      const bool is_reading =
          before.kind == Kind::kInclinometer || after.kind == Kind::kInclinometer;
      if (!same_pose && !is_reading) cuts.push_back(k);
    }
    return cuts;
  }
  Problem cut_at(std::size_t cut) const {
    Problem result = problem_;
    result.names.push_back(problem_.names[station_]);
    result.stations.push_back(problem_.stations[station_]);
    for (std::size_t k = cut; k < order_.size(); ++k) {
      result.observations[order_[k]].station = problem_.stations.size();
    }
    return result;
  }
  double misfit_of(std::size_t cut) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    try {
      const Adjustment adjustment(network_of(cut_at(cut)));
      const Start start = find_start(adjustment, levels_.mistaken);
      const std::vector<bool> all(adjustment.groups().size(), true);
      const Fit fit = adjustment.fit(start.state, all);
      return is_finite(fit) ? fit.misfit : kNone;
    } catch (const std::exception&) {
      return kNone;
    }
  }
  // By the directions of one reading: a heading alone is shared with the mounting. A unit that has
  // lost its counts looks the same as a turned tripod.
  std::string sentence(std::size_t cut, const Fit& found) const {
    const Observation& first = problem_.observations[order_[cut]];
    const auto direction = [&](std::size_t station) {
      const StationModel& model = found.state.stations[station].model;
      const auto seen = predict_direction(model, first.reading, first.pixel);
      return seen ? seen->direction : AzimuthElevation{};
    };
    const auto before = direction(station_), after = direction(problem_.stations.size());
    const double pan_rad = wrap_pi(after.azimuth_rad - before.azimuth_rad);
    const double tilt_rad = after.elevation_rad - before.elevation_rad;
    const bool is_tilt = std::abs(tilt_rad) > std::abs(pan_rad);
    const std::string text = printed(
        "all agree if the tripod of station '%s' was turned, or the unit lost its counts, "
        "by %+.3f deg of %s before the sighting of '%s' in line %u",
        problem_.names[station_].c_str(), degrees(is_tilt ? tilt_rad : pan_rad),
        is_tilt ? "tilt" : "pan", first.reference.c_str(), first.line);
    return text;
  }

  Problem problem_;
  std::size_t station_;
  Levels levels_;
  std::vector<std::size_t> order_;  // the station's observations
};

// What is enough to tell a mistake that all sightings show, each of which costs time at each try:
// no scenery, and of what thousands of sightings follow, some hundreds.
Problem lightened(const Problem& problem) {
  constexpr std::size_t kEnough = 200;  // of each followed object, by each station
  using Followed = std::pair<std::size_t, std::string>;
  const auto is_followed = [](const Observation& one) {
    return one.kind == Kind::kDrone || one.kind == Kind::kAircraft;
  };
  std::map<Followed, std::size_t> all, before;
  for (const Observation& one : problem.observations) {
    if (is_followed(one)) ++all[{one.station, one.reference}];
  }
  Problem light = problem;
  std::erase_if(light.observations, [&](const Observation& one) {
    if (one.kind == Kind::kScene) return true;
    if (!is_followed(one)) return false;
    const Followed key{one.station, one.reference};
    const std::size_t every = (all.at(key) + kEnough - 1) / kEnough;
    return before[key]++ % every != 0;
  });
  return light;
}

void add_turns(const Problem& problem, const Levels& levels, std::vector<std::string>& causes) {
  for (std::size_t s = 0; s < problem.stations.size(); ++s) {
    TurnSearch(problem, s, levels).run(causes);
  }
}

void add_mistakes_of_stations(const Problem& problem, const Levels& levels,
                              std::vector<std::string>& causes) {
  add_positions(problem, levels, causes);
  if (causes.empty()) add_turns(problem, levels, causes);
}

}  // namespace

std::vector<std::string> mistakes_of_stations(const Problem& problem, const Levels& levels) {
  const Problem light = lightened(problem);
  if (all_agree(light, levels)) return {};
  std::vector<std::string> causes;
  add_mistakes_of_stations(light, levels, causes);
  return causes;
}

std::vector<std::string> causes_of_contradiction(const Problem& problem, const Levels& levels) {
  const Problem light = lightened(problem);
  if (all_agree(light, levels)) return {};
  std::vector<std::string> causes;
  add_exchanged(light, levels, causes);
  add_reversed_axes(light, levels, causes);
  add_exchanged_pixels(light, levels, causes);
  add_exchanged_coordinates(light, levels, causes);
  const bool sees_sky = std::ranges::any_of(light.observations, [](const Observation& one) {
    return one.kind == Kind::kStar || one.kind == Kind::kSun;
  });
  // Without the sky the distance of a reference tells.
  if (sees_sky) add_hemispheres(light, levels, causes);
  // These have so many more unknowns that they explain other mistakes, too.
  if (causes.empty()) add_mistakes_of_stations(light, levels, causes);
  return causes;
}

}  // namespace ols::calibration
