#include "calibration/procedure/sighting_planner.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "calibration/guidance.h"
#include "calibration/name_stars.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr double kSight_px = 0.2;  // of a sighting that a person has confirmed

std::string arcsec(double rad) { return printed("%.1f″", 3600.0 * degrees(rad)); }

bool is_unnamed(const Observation& one) { return one.kind == Kind::kStar && one.reference.empty(); }

}  // namespace

std::string in_words(const std::vector<Foretold>& ranked) {
  constexpr std::size_t kShown = 4;
  if (ranked.empty()) return {};
  std::string words = ranked[0].name + " would leave " + arcsec(ranked[0].rms_rad);
  std::string others;
  for (std::size_t i = 1; i < std::min(kShown, ranked.size()); ++i) {
    others += (others.empty() ? "" : ", ") + ranked[i].name + " " + arcsec(ranked[i].rms_rad);
  }
  return others.empty() ? words : words + " (" + others + ")";
}

// Stars have no names yet: they are found once, and left out where they cannot be.
void SightingPlanner::take_observed() {
  std::vector<Observation> all = observed_(), stars;
  std::ranges::copy_if(all, std::back_inserter(stars), is_unnamed);
  std::erase_if(all, is_unnamed);
  if (stars.size() != unnamed_) {
    unnamed_ = stars.size();
    Problem sky = problem_;
    sky.observations = stars;
    named_.clear();
    try {
      name_stars(sky);
      problem_.references = sky.references;
      named_ = sky.observations;
      std::erase_if(named_, is_unnamed);
    } catch (const StarsUnidentified&) {
      named_.clear();
    }
  }
  all.insert(all.end(), named_.begin(), named_.end());
  problem_.observations = std::move(all);
}

std::vector<Foretold> SightingPlanner::rank(const StationModel& model,
                                            const std::vector<Place>& places) {
  take_observed();
  const LocalFrame ground(model.geometry.position);
  const CameraIntrinsics& camera = model.geometry.camera;
  const Eigen::Vector2d middle(0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1));
  Problem problem = problem_;
  std::vector<Candidate> candidates;
  for (const Place& place : places) {
    problem.references[place.name] = FixedPoint{place.ecef, place.sd_m};
    Candidate candidate{place.name, {}};
    for (int i = 0; i < times_; ++i) {
      const int side = i % 2 == 0 ? 1 : -1;
      const auto reading =
          reading_towards(model, {ground.to_enu(place.ecef), 1.0}, middle, side, side);
      if (!reading) break;
      Observation one;
      one.kind = Kind::kLandmark;
      one.reading = *reading;
      one.pixel = middle;
      one.sd_px = kSight_px;
      one.reference = place.name;
      candidate.sightings.push_back(std::move(one));
    }
    if (!candidate.sightings.empty()) candidates.push_back(std::move(candidate));
  }
  std::vector<Foretold> ranked;
  for (const Advice& one : rank_sightings(problem, 0, model, candidates)) {
    ranked.push_back({candidates[one.candidate].name, one.rms_rad});
  }
  return ranked;
}

}  // namespace ols::calibration
