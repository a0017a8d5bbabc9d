#include "tools/calibrate/adjust_command.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>

#include "calibration/contradiction_cause.h"
#include "calibration/exchange.h"
#include "calibration/procedure/sighting_planner.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "tools/calibrate/output_folder.h"

namespace ols::calibration {
namespace {

constexpr const char* kDetectable = "detectable ";

bool is_limit(const Finding& one) { return one.judgement == Finding::Judgement::kBad; }

// The rejected landmark that deviates most from the others; empty: none.
std::string rejected_landmark(const Adjusted& adjusted) {
  std::string worst;
  double highest = 0.0;
  for (const auto& [name, test] : adjusted.references) {
    const bool is_landmark =
        adjusted.what.problem.references.contains(name) &&
        std::holds_alternative<FixedPoint>(adjusted.what.problem.references.at(name));
    if (!is_landmark || !test.rejected || test.w / test.critical <= highest) continue;
    highest = test.w / test.critical;
    worst = name;
  }
  return worst;
}

// The landmarks that have been sighted, and those that could be.
std::vector<Place> landmarks(const Adjusted& adjusted) {
  std::vector<Place> places;
  for (const auto& [name, reference] : adjusted.what.problem.references) {
    const auto* point = std::get_if<FixedPoint>(&reference);
    if (point) places.push_back({name, point->ecef, point->sd_m});
  }
  return places;
}

// The landmarks whose sighting, once more from both sides, would leave the smallest error; and that
// error.
std::vector<Foretold> next_best(const Adjusted& adjusted) {
  constexpr int kBothSides = 2;
  const Problem& problem = adjusted.what.problem;
  std::set<std::string> rejected;
  for (const auto& [name, test] : adjusted.references) {
    if (test.rejected) rejected.insert(name);
  }
  std::vector<Observation> kept;
  std::ranges::copy_if(problem.observations, std::back_inserter(kept),
                       [&](const Observation& one) { return !rejected.contains(one.reference); });
  SightingPlanner planner(
      problem, [kept] { return kept; }, kBothSides);
  return planner.rank(adjusted.found.fit.state.stations[0].model, landmarks(adjusted));
}

constexpr double kArcsec = EIGEN_PI / 648000.0;

// What the paper's targets can reach.
constexpr double kMostOfAngle_arcsec = 40.0;

bool is_known(const RectifiedAngle& angle) { return angle.sd_rad <= kMostOfAngle_arcsec * kArcsec; }

std::string sentence_of(const RectifiedAngle& angle) {
  const char* what =
      angle.kind == RectifiedAngle::Kind::kRoll      ? "rolled against the horizon, clockwise"
      : angle.kind == RectifiedAngle::Kind::kAzimuth ? "turned on the unit, to the right"
                                                     : "tilted where the unit counts zero, up";
  return printed("%s: the camera is %s: %+.4f deg, 1-sigma %.0f\"", to_string(angle.kind), what,
                 degrees(angle.rad), angle.sd_rad / kArcsec);
}

// The result of the scenery: whether lens and gears agree with the calibration in use.
std::string scenery_for_person(const Adjusted& adjusted) {
  const bool is_new = adjusted.what.options.instruments.empty();
  std::string text = std::string("Lens and gears against ") +
                     (is_new ? "a new unit" : "the calibration in use") + ":\n";
  for (const Finding& one : adjusted.acceptance.findings) {
    text += (is_limit(one) ? "  BAD  " : "       ") + one.sentence + "\n";
  }
  return text;
}

std::string angles_for_person(const Adjusted& adjusted) {
  std::string text = "How the camera is mounted:\n";
  for (const RectifiedAngle& angle : adjusted.angles) {
    text += (is_known(angle) ? "       " : "  BAD  ") + sentence_of(angle) + "\n";
  }
  return text;
}

// They would contradict every cause.
Problem without_observations(const Problem& problem, const std::set<std::size_t>& left_out) {
  Problem result = problem;
  result.observations.clear();
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (!left_out.contains(i)) result.observations.push_back(problem.observations[i]);
  }
  return result;
}

Calibration calibrated(const Case& what, const Adjustment& adjustment, const TellAdjusted& tell) {
  try {
    return calibrate(adjustment, {}, tell);
  } catch (const std::invalid_argument& refused) {
    std::string text = refused.what();
    const Problem problem = without_observations(what.problem, what.mistaken);
    for (const std::string& cause : causes_of_contradiction(problem)) text += "; " + cause;
    throw std::invalid_argument(text);
  }
}

struct Rejected {
  std::vector<const Group*> groups;      // without a few stars: double stars are often among them
  std::set<std::size_t> of_a_few_stars;  // the observations of those
};

Rejected rejected_groups(const Network& network, const Calibration& found) {
  constexpr std::size_t kFew = 10;  // one in ten
  Rejected rejected;
  std::vector<const Group*> rejected_stars;
  std::size_t stars = 0;
  for (std::size_t g = 0; g < found.tests.size(); ++g) {
    const Group& group = network.groups[g];
    const bool is_star = group.kind == Kind::kStar;
    stars += is_star ? 1 : 0;
    if (found.tests[g].rejected) (is_star ? rejected_stars : rejected.groups).push_back(&group);
  }
  if (kFew * rejected_stars.size() > stars) {
    rejected.groups.insert(rejected.groups.end(), rejected_stars.begin(), rejected_stars.end());
    return rejected;
  }
  for (const Group* star : rejected_stars) {
    rejected.of_a_few_stars.insert(star->observations.begin(), star->observations.end());
  }
  return rejected;
}

// Several references that are rejected may be one mistake of their station: then the others are
// not right either.
void check_stations(const Case& what, const Adjustment& adjustment, Calibration& found) {
  const Rejected rejected = rejected_groups(adjustment.network(), found);
  if (rejected.groups.empty()) return;
  const auto exchanged = exchanged_landmarks(what.problem, adjustment, found);
  found.remarks.insert(found.remarks.end(), exchanged.begin(), exchanged.end());
  // Each names two.
  if (rejected.groups.size() <= 2 * exchanged.size()) return;
  std::set<std::size_t> left_out = rejected.of_a_few_stars;
  left_out.insert(what.mistaken.begin(), what.mistaken.end());
  std::string causes;
  for (const auto& cause : mistakes_of_stations(without_observations(what.problem, left_out))) {
    causes += "; " + cause;
  }
  if (causes.empty()) return;
  std::string names;
  for (const Group* group : rejected.groups) {
    names +=
        (names.empty() ? "" : ", ") + std::string(name(group->kind)) + " '" + group->name + "'";
  }
  // A single reference is as likely to be mistaken as its station.
  if (rejected.groups.size() > 1) {
    throw std::invalid_argument("the observations contradict each other: " + names +
                                " disagree with the others" + causes);
  }
  found.remarks.push_back(names + " disagrees with the others" + causes);
}

// The adjustment with its calibration. If the unit's angles scatter by more than was stated, their
// own deviation is enlarged. A common factor for everything would be too small: pixels are many
// more than poses.
Adjustment settled(Adjusted& adjusted, const TellAdjusted& tell) {
  Case& what = adjusted.what;
  Adjustment adjustment(network_of(what));
  adjusted.found = calibrated(what, adjustment, tell);
  const double factor = pose_scatter(adjustment, adjusted.found.fit);
  if (factor > 1.0) {
    for (std::size_t s = 0; s < what.problem.stations.size(); ++s) {
      what.problem.stations[s].pose_sd_rad *= factor;
      what.instruments[s].angle_sd_rad *= factor;
    }
    adjustment = Adjustment(network_of(what));
    adjusted.found = calibrated(what, adjustment, tell);
    const std::string text = printed(
        "the unit's angles scatter by more than was stated (angle_sd_deg): taken as "
        "%.1f arc seconds",
        what.instruments.front().angle_sd_rad / kArcsec);
    adjusted.found.remarks.emplace_back(text);
  }
  check_stations(what, adjustment, adjusted.found);
  return adjustment;
}

// Nothing determines a heading: the instrument alone is the result.
AdjustedResult instrument_for_person(const Adjusted& adjusted) {
  AdjustedResult result;
  const bool has_scenery =
      std::ranges::any_of(adjusted.what.problem.observations,
                          [](const Observation& one) { return one.kind == Kind::kScene; });
  if (has_scenery) result.text += scenery_for_person(adjusted);
  if (!adjusted.angles.empty() || !has_scenery) result.text += angles_for_person(adjusted);
  for (const std::string& note : adjusted.notes) result.text += "  note " + note + "\n";
  result.good = adjusted.found.scaled_by == 1.0 && std::ranges::all_of(adjusted.angles, is_known) &&
                (has_scenery ? adjusted.acceptance.acceptable() : !adjusted.angles.empty());
  result.text += result.good ? "Good." : "Not within the limits. Nothing is accepted by itself.";
  return result;
}

}  // namespace

Adjusted adjust_into(const CaseOptions& options, const std::filesystem::path& folder,
                     const TellAdjusted& tell) {
  Adjusted adjusted;
  adjusted.what = read_case(options);
  find_mistaken(adjusted.what, tell);
  const Case& what = adjusted.what;
  const Adjustment adjustment = settled(adjusted, tell);
  Calibration& found = adjusted.found;
  for (const std::string& line : mistaken_in_words(what)) found.remarks.push_back(line);
  const Network& network = adjustment.network();
  for (std::size_t g = 0; g < network.groups.size(); ++g) {
    const Group& group = network.groups[g];
    if (group.is_absolute() && group.kind != Kind::kStar) {
      adjusted.references.emplace_back(group.name, found.tests[g]);
    }
  }
  adjusted.angles = rectified_angles(what.problem, adjustment, found, 0);
  adjusted.results = station_results(what, adjustment, found);
  adjusted.acceptance = adjusted.results.front().acceptance;
  write_folder(folder, output_files(what, adjustment, found));
  adjusted.notes = found.remarks;
  adjusted.notes.insert(adjusted.notes.end(), what.warnings.begin(), what.warnings.end());
  return adjusted;
}

std::vector<std::string> bad_findings(const Adjusted& adjusted) {
  std::vector<std::string> bad;
  for (const StationResult& station : adjusted.results) {
    const std::string whose = adjusted.results.size() > 1 ? "station " + station.id + ": " : "";
    for (const Finding& one : station.acceptance.findings) {
      if (is_limit(one)) bad.push_back(whose + one.sentence);
    }
  }
  return bad;
}

AdjustedResult result_for_person(const Adjusted& adjusted) {
  if (!adjusted.found.headings_known) return instrument_for_person(adjusted);
  AdjustedResult result;
  result.good = adjusted.acceptance.acceptable();
  result.worst = rejected_landmark(adjusted);
  const std::vector<Foretold> next = next_best(adjusted);
  if (result.worst.empty() && !next.empty()) result.worst = next.front().name;
  std::string good, other;
  for (const Finding& one : adjusted.acceptance.findings) {
    // Good references are left out: one screen has room for the rest only.
    const bool is_minor = one.judgement == Finding::Judgement::kGood &&
                          (one.name.starts_with(kDetectable) || one.name.starts_with("without_"));
    if (is_minor) continue;
    std::string& list = is_limit(one) ? other : good;
    list += (is_limit(one) ? "  BAD  " : "       ") + one.sentence + "\n";
  }
  result.text = "What this calibration leaves:\n" + good + other;
  for (const RectifiedAngle& angle : adjusted.angles) {
    result.text += "       " + sentence_of(angle) + "\n";
  }
  for (const std::string& note : adjusted.notes) result.text += "  note " + note + "\n";
  if (adjusted.acceptance.volume_is_cut) {
    const WorkingVolume& volume = adjusted.acceptance.volume;
    const std::string text =
        printed("  good for pan within %.0f deg and tilt from %.0f to %.0f deg only\n",
                volume.pan_deg, volume.lowest_deg, volume.highest_deg);
    result.text += text;
  }
  if (!next.empty()) {
    result.text += "  which sighting helps most, twice more: " + in_words(next) + "\n";
  }
  if (!result.worst.empty()) result.text += "  redo sights " + result.worst + " again\n";
  result.text += result.good ? "Good." : "Not within the limits. Nothing is accepted by itself.";
  return result;
}

}  // namespace ols::calibration
