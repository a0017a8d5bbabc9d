#include "calibration/followed_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "calibration/trajectory.h"
#include "geometry/angles.h"
#include "geometry/pixel_prediction.h"

namespace ols::calibration {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

AxisReading between(const AxisReading& a, const AxisReading& b, double share) {
  return {a.counts + share * (b.counts - a.counts),
          a.counts_per_s + share * (b.counts_per_s - a.counts_per_s), a.approach};
}

bool same_approach(const AxisReading& a, const AxisReading& b) {
  return a.approach != 0 && a.approach == b.approach;
}

std::optional<AzimuthElevation> direction(const StationPrior& station, const UnitReading& reading,
                                          const Eigen::Vector2d& pixel) {
  const auto seen = predict_direction(station.model, reading, pixel);
  return seen ? std::optional(seen->direction) : std::nullopt;
}

// At the whole second between two exposures. A clock that is off shows the target where it was.
Instant instant_of(const FollowedSighting& before, const FollowedSighting& after,
                   std::int64_t utime_us, const StationPrior& station) {
  const auto span_us = static_cast<double>(after.utime_us - before.utime_us);
  const double share = static_cast<double>(utime_us - before.utime_us) / span_us;
  Instant one = before;
  one.utime_us = utime_us;
  one.reading.pan = between(before.reading.pan, after.reading.pan, share);
  one.reading.tilt = between(before.reading.tilt, after.reading.tilt, share);
  one.pixel = before.pixel + share * (after.pixel - before.pixel);
  const auto from = direction(station, before.reading, before.pixel);
  const auto to = direction(station, after.reading, after.pixel);
  const double moved_rad =
      from && to ? angle_between(enu_from_azimuth_elevation(*from), enu_from_azimuth_elevation(*to))
                 : 0.0;
  const double moved_px = moved_rad * station.model.geometry.camera.fx_px;
  one.sd_px =
      std::hypot(std::max(before.sd_px, after.sd_px),
                 moved_px / (1e-6 * span_us) * std::max(before.clock_sd_s, after.clock_sd_s));
  one.clock_sd_s = 0.0;
  return one;
}

// What one station followed in one go.
using OwnTrack = std::tuple<std::size_t, std::int64_t, std::int64_t>;
OwnTrack own_track(const Instant& one) { return {one.station, one.boot_id, one.track_id}; }

Observation observation_of(Kind kind, const Instant& one, const std::string& reference) {
  Observation result;
  result.kind = kind;
  result.station = one.station;
  result.utime_us = one.utime_us;
  result.reading = one.reading;
  result.pixel = one.pixel;
  result.sd_px = one.sd_px;
  result.reference = reference;
  return result;
}

// How well a trajectory fits to what a station followed: [rad] RMS of an axis, once the best
// azimuth, elevation and latency are taken out; infinite where it does not.
class AircraftFit {
 public:
  AircraftFit(const std::vector<Instant>& track, const StationPrior& station)
      : track_(track), ground_(station.model.geometry.position) {
    for (const Instant& one : track) {
      seen_.push_back(direction(station, one.reading, one.pixel).value_or(AzimuthElevation{}));
    }
  }
  // How far its directions lie apart [rad].
  double span_rad() const {
    double span = 0.0;
    for (const AzimuthElevation& one : seen_) {
      span = std::max(span, angle_between(enu_from_azimuth_elevation(seen_.front()),
                                          enu_from_azimuth_elevation(one)));
    }
    return span;
  }
  double misfit_rad(const Trajectory& trajectory) const {
    constexpr double kLatest_s = 2.5, kStep_s = 0.25;
    double least = std::numeric_limits<double>::infinity();
    for (double latency_s = -kLatest_s; latency_s <= kLatest_s; latency_s += kStep_s) {
      least = std::min(least, misfit_rad(trajectory, latency_s));
    }
    return least;
  }

 private:
  // The heading may be anything; the tilts and the mounting are not.
  double misfit_rad(const Trajectory& trajectory, double latency_s) const {
    constexpr double kMostLift_rad = 0.02;
    std::vector<Eigen::Vector2d> off;
    double sine = 0.0, cosine = 0.0, lift = 0.0;
    for (std::size_t i = 0; i < track_.size(); ++i) {
      const double utime_us = static_cast<double>(track_[i].utime_us) + 1e6 * latency_s;
      const Motion motion = motion_at(trajectory, utime_us);
      const auto there = azimuth_elevation_from_enu(ground_.to_enu(motion.ecef));
      const double turn = there.azimuth_rad - seen_[i].azimuth_rad;
      off.emplace_back(turn, there.elevation_rad - seen_[i].elevation_rad);
      sine += std::sin(turn);
      cosine += std::cos(turn);
      lift += off.back().y();
    }
    const double turn = std::atan2(sine, cosine);
    lift /= static_cast<double>(track_.size());
    if (std::abs(lift) > kMostLift_rad) return std::numeric_limits<double>::infinity();
    double squares = 0.0;
    for (std::size_t i = 0; i < off.size(); ++i) {
      const double across = wrap_pi(off[i].x() - turn) * std::cos(seen_[i].elevation_rad);
      squares += across * across + std::pow(off[i].y() - lift, 2);
    }
    return std::sqrt(0.5 * squares / static_cast<double>(off.size()));
  }

  const std::vector<Instant>& track_;
  LocalFrame ground_;
  std::vector<AzimuthElevation> seen_;
};

constexpr std::size_t kLeastInstants = 5;

// The instants of which a trajectory has positions around.
std::vector<Instant> covered(const std::vector<Instant>& track, const Trajectory& trajectory) {
  std::vector<Instant> within;
  for (const Instant& one : track) {
    if (one.utime_us < trajectory.points.front().utime_us ||
        one.utime_us > trajectory.points.back().utime_us) {
      continue;
    }
    const Motion motion = motion_at(trajectory, static_cast<double>(one.utime_us));
    if (motion.gap_s <= kLongestGap_s) within.push_back(one);
  }
  return within;
}

struct Match {
  std::string aircraft;  // empty: none
  std::vector<Instant> instants;
};

// The one aircraft that flies as the track does, and no other nearly as well.
Match aircraft_of(const std::vector<Instant>& track, const StationPrior& station,
                  const References& references) {
  constexpr double kLeastSpan_rad = 0.05, kMostMisfit_rad = 0.0035, kClear = 3.0;
  Match best;
  double least = std::numeric_limits<double>::infinity(), next = least;
  for (const auto& [name, reference] : references) {
    const auto* trajectory = std::get_if<Trajectory>(&reference);
    if (!trajectory) continue;
    std::vector<Instant> within = covered(track, *trajectory);
    if (within.size() < kLeastInstants) continue;
    const AircraftFit fit(within, station);
    if (fit.span_rad() < kLeastSpan_rad) continue;
    const double misfit = fit.misfit_rad(*trajectory);
    next = std::min(next, std::max(misfit, least));
    if (misfit >= least) continue;
    least = misfit;
    best = {name, std::move(within)};
  }
  return least < kMostMisfit_rad && next > kClear * least ? best : Match{};
}

class TrackFinder {
 public:
  TrackFinder(const std::vector<StationPrior>& stations, const std::vector<std::string>& names,
              const References& references)
      : stations_(stations), names_(names), references_(references) {}

  FollowedObservations build(const std::vector<Instant>& instants, const TellTracks& tell) {
    std::map<OwnTrack, std::vector<Instant>> tracks;
    for (const Instant& one : instants) tracks[own_track(one)].push_back(one);
    std::size_t done = 0;
    for (const auto& [own, track] : tracks) {
      add_aircraft(track);
      if (tell) tell(++done, tracks.size());
    }
    add_joint(instants);
    return std::move(result_);
  }

 private:
  std::string label(const Instant& one) const {
    return names_[one.station] + ":" + std::to_string(one.track_id);
  }

  void add_aircraft(const std::vector<Instant>& track) {
    const Match match = aircraft_of(track, stations_[track.front().station], references_);
    if (match.aircraft.empty()) return;
    known_.insert(own_track(track.front()));
    for (const Instant& one : match.instants) {
      result_.observations.push_back(observation_of(Kind::kAircraft, one, match.aircraft));
    }
    result_.remarks.push_back("aircraft '" + match.aircraft + "': " + label(track.front()) + ", " +
                              std::to_string(match.instants.size()) + " instants");
  }

  // A name for each set of stations' own tracks: where one of them changes over to another object,
  // the name changes with it.
  void add_joint(const std::vector<Instant>& instants) {
    std::map<std::int64_t, std::vector<const Instant*>> by_time;
    for (const Instant& one : instants) {
      if (!known_.contains(own_track(one))) by_time[one.utime_us].push_back(&one);
    }
    std::map<std::vector<OwnTrack>, std::vector<const Instant*>> joint;
    for (const auto& [utime_us, all] : by_time) {
      std::vector<OwnTrack> set;
      for (const Instant* one : all) set.push_back(own_track(*one));
      std::ranges::sort(set);
      if (set.size() < 2) continue;
      auto& members = joint[set];
      members.insert(members.end(), all.begin(), all.end());
    }
    for (const auto& [set, members] : joint) add_track(set.size(), members);
  }

  void add_track(std::size_t stations, const std::vector<const Instant*>& members) {
    std::string name;
    for (std::size_t i = 0; i < stations; ++i) {
      if (i > 0) name += '+';
      name += label(*members[i]);
    }
    const std::size_t count = members.size() / stations;
    const bool enough = count >= kLeastInstants;
    result_.remarks.push_back("track '" + name + "': " + std::to_string(count) + " instants" +
                              (enough ? "" : ", too few: left out"));
    if (!enough) return;
    for (const Instant* one : members) {
      result_.observations.push_back(observation_of(Kind::kTrack, *one, name));
    }
  }

  const std::vector<StationPrior>& stations_;
  const std::vector<std::string>& names_;
  const References& references_;
  std::set<OwnTrack> known_;  // that are aircraft
  FollowedObservations result_;
};

}  // namespace

Instants instants_of(std::vector<FollowedSighting> sightings,
                     const std::vector<StationPrior>& stations) {
  constexpr std::int64_t kApart_us = 250'000;
  std::ranges::stable_sort(sightings, {}, [](const FollowedSighting& one) {
    return std::tuple(one.station, one.boot_id, one.track_id, one.utime_us);
  });
  Instants result;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const FollowedSighting& here = sightings[i];
    const FollowedSighting* next = i + 1 < sightings.size() ? &sightings[i + 1] : nullptr;
    // The log may have it twice.
    const bool pair = next && next->station == here.station && next->boot_id == here.boot_id &&
                      next->track_id == here.track_id && next->utime_us > here.utime_us &&
                      next->utime_us - here.utime_us <= kApart_us &&
                      next->utime_us / kSecond_us > here.utime_us / kSecond_us;
    if (!pair) {
      ++result.lonely;
      continue;
    }
    ++i;
    if (!same_approach(here.reading.pan, next->reading.pan) ||
        !same_approach(here.reading.tilt, next->reading.tilt)) {
      ++result.unsure;
      continue;
    }
    const std::int64_t second_us = next->utime_us / kSecond_us * kSecond_us;
    result.instants.push_back(instant_of(here, *next, second_us, stations[here.station]));
  }
  return result;
}

FollowedObservations followed(const std::vector<Instant>& instants,
                              const std::vector<StationPrior>& stations,
                              const std::vector<std::string>& names, const References& references,
                              const TellTracks& tell) {
  return TrackFinder(stations, names, references).build(instants, tell);
}

}  // namespace ols::calibration
