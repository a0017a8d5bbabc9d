#include "calibration/name_stars.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "calibration/star_identification.h"

namespace ols::calibration {
namespace {

struct NamelessFrames {
  std::vector<StarFrame> frames;
  std::vector<std::vector<std::size_t>> observations;  // of each frame's pixels
  double sd_px = 0.0;                                  // of the worst
};

NamelessFrames nameless_of(const Problem& problem, std::size_t station) {
  using Key = std::tuple<std::int64_t, double, double, int, int>;
  std::map<Key, std::size_t> known;
  NamelessFrames result;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const Observation& one = problem.observations[i];
    if (one.kind != Kind::kStar || one.station != station || !one.reference.empty()) continue;
    const AxisReading &pan = one.reading.pan, &tilt = one.reading.tilt;
    const Key key{one.utime_us, pan.counts, tilt.counts, pan.approach, tilt.approach};
    const auto [frame, is_new] = known.try_emplace(key, result.frames.size());
    if (is_new) {
      result.frames.push_back({one.reading, one.utime_us, {}});
      result.observations.emplace_back();
    }
    result.frames[frame->second].pixels.push_back(one.pixel);
    result.observations[frame->second].push_back(i);
    result.sd_px = std::max(result.sd_px, one.sd_px);
  }
  return result;
}

void name_of_station(Problem& problem, std::size_t station, NamedStars& result) {
  const NamelessFrames nameless = nameless_of(problem, station);
  if (nameless.frames.empty()) return;
  const StationPrior& prior = problem.stations[station];
  const StarConditions conditions{
      problem.air.value_or(standard_air(prior.model.geometry.position.height_m)), problem.earth,
      nameless.sd_px};
  const StarIdentification found = identify_stars(prior, nameless.frames, conditions);
  const std::string start = "station '" + problem.names[station] + "': ";
  if (found.verdict != StarIdentification::Verdict::kIdentified) {
    const std::string why = explain_unidentified(prior, nameless.frames, conditions);
    throw StarsUnidentified(start + "its stars cannot be identified: " + found.finding +
                            (why.empty() ? "" : "; " + why));
  }
  result.remarks.push_back(start + found.finding);
  for (const IdentifiedStar& one : found.stars) {
    Observation& observation =
        problem.observations[nameless.observations[one.frame][one.detection]];
    observation.reference = name_of(one.star);
  }
  for (const auto& frame : nameless.observations) {
    std::ranges::copy_if(frame, std::back_inserter(result.false_ones),
                         [&](std::size_t i) { return problem.observations[i].reference.empty(); });
  }
}

}  // namespace

NamedStars name_stars(Problem& problem) {
  NamedStars result;
  for (std::size_t s = 0; s < problem.stations.size(); ++s) name_of_station(problem, s, result);
  for (const Observation& one : problem.observations) {
    if (one.kind != Kind::kStar || problem.references.contains(one.reference)) continue;
    if (const auto star = table_star(one.reference)) {
      problem.references[one.reference] = star_of(*star);
    }
  }
  std::ranges::sort(result.false_ones);
  return result;
}

}  // namespace ols::calibration
