// What comes out of the fusion when a period has gone by: targets, lines, slews. A share of it with
// each bearing, so that no bearing waits for long behind a thousand stations' slews.
#include <algorithm>
#include <set>

#include "central/estimators/alignment.h"
#include "central/fusion/fusion.h"
#include "central/measurement/time_span.h"

namespace ols {
namespace {

constexpr int kLines = 16;              // of what is no target, told an epoch,
constexpr std::size_t kOfAStation = 4;  // and of one station
constexpr double kFollowsS = 1.0;       // a station that saw a target longer ago does not see it
// With one bearing: so many targets (the paper's estimate of one costs as much as several), and the
// slews of so many stations.
constexpr int kTargetsABearing = 8, kPaperIsWorth = 4, kSlewsABearing = 16;

bool due(const std::optional<std::int64_t>& last_us, std::int64_t now_us, double rate_hz) {
  // A tenth of tolerance: frames of the same rate must not be missed every other time.
  return !last_us || static_cast<double>(now_us - *last_us) >= 0.9e6 / rate_hz;
}

FusedTarget target_of(std::int64_t epoch_us, const Track& track, const char* estimator,
                      Located located) {
  FusedTarget target;
  target.utime_us = epoch_us;
  target.target_id = track.id;
  target.state = track.state;
  target.estimator = estimator;
  target.estimate = std::move(located.estimate);
  target.stations = std::move(located.stations);
  return target;
}

}  // namespace

void Fusion::begin_epoch(std::int64_t now_us) {
  epoch_ = {.utime_us = now_us, .lines_told = false};
  keeper_.advance(now_us);
  for (const Track& track : keeper_.tracks()) {
    if (is_sure(track)) epoch_.targets.push_back(track.id);
  }
  std::ranges::sort(epoch_.targets);
  std::erase_if(objects_, [this](const auto& object) {
    return !std::ranges::binary_search(epoch_.targets, object.first);
  });
  const auto papers =
      std::min(epoch_.targets.size(), static_cast<std::size_t>(config_.paper_targets));
  epoch_.papers.assign(epoch_.targets.begin(),
                       epoch_.targets.begin() + static_cast<std::ptrdiff_t>(papers));
}

const Track* Fusion::next_of(std::deque<std::int64_t>& waiting) const {
  const std::int64_t id = waiting.front();
  waiting.pop_front();
  const auto track = std::ranges::find(keeper_.tracks(), id, &Track::id);
  return track == keeper_.tracks().end() || !is_sure(*track) ? nullptr : &*track;
}

// After a silence, what was not told yet is told no more: by now it may be dropped.
void Fusion::give_up_what_is_old(std::int64_t now_us) {
  const auto is_old = [&](std::int64_t begun_us) {
    return seconds(now_us - begun_us) > config_.keeper.drop_s;
  };
  if (!epoch_.is_over() && is_old(*epoch_.utime_us)) epoch_ = {.utime_us = epoch_.utime_us};
  if (slew_next_ && is_old(*slewed_us_)) slew_next_.reset();
}

void Fusion::locate(std::int64_t now_us, FusionOutput& output) {
  give_up_what_is_old(now_us);
  if (epoch_.is_over() && due(epoch_.utime_us, now_us, config_.rate_hz)) begin_epoch(now_us);
  if (epoch_.is_over()) return;
  int work = 0;
  for (; work < kTargetsABearing && !epoch_.targets.empty(); ++work) {
    if (const Track* track = next_of(epoch_.targets))
      output.targets.push_back(locate(*track, false));
  }
  if (epoch_.targets.empty() && !epoch_.lines_told) tell_lines(output);
  for (; work < kTargetsABearing && epoch_.lines_told && !epoch_.papers.empty();
       work += kPaperIsWorth) {
    const Track* track = next_of(epoch_.papers);
    if (track != nullptr) output.targets_paper.push_back(locate(*track, true));
  }
  for (const FusedTarget& target : output.targets) {
    const bool located = target.estimate.solution == Solution::kOk;
    ++counters_[located ? "targets" : "targets_without_position"];
  }
}

FusedTarget Fusion::locate(const Track& track, bool by_paper) {
  Object& object = objects_[track.id];
  if (!object.main) {
    object.main = make_estimator(config_.estimator, config_.estimators);
    object.paper = make_estimator("paper", config_.estimators);
  }
  Estimator& estimator = by_paper ? *object.paper : *object.main;
  const std::int64_t epoch_us = *epoch_.utime_us;
  Located located = estimator.locate({track.bearings, keeper_.errors(), &track.filter}, epoch_us);
  if (!by_paper) {
    std::erase_if(located.stations, [this](const ContributingStation& station) {
      return !clocks_.quarantine(station.station).empty();
    });
  }
  return target_of(epoch_us, track, estimator.name(), std::move(located));
}

// No object: why there is none, or the one line that there is. And the line of each station that
// follows what is no target.
void Fusion::tell_lines(FusionOutput& output) {
  epoch_.lines_told = true;
  const std::int64_t epoch_us = *epoch_.utime_us;
  const bool located = std::ranges::any_of(keeper_.tracks(), is_sure);
  const std::vector<std::string> stations = on_a_line(epoch_us);
  FusedTarget target;
  target.utime_us = epoch_us;
  target.estimator = config_.estimator;
  if (!located && stations.size() != 1) {
    target.estimate.solution =
        stations.empty() ? Solution::kTooFewRays : keeper_.births().last_failure();
    for (const std::string& station : stations)
      target.stations.push_back({station, true, 1.0, 0.0});
    output.targets.push_back(target);
  }
  target.estimate.solution = Solution::kBearingOnly;
  const bool alone = !located && stations.size() == 1;
  std::set<std::int64_t> told;
  int lines = 0;
  for (const std::string& station : stations) {
    auto newest = lines_of(station, epoch_us);
    if (newest.empty() && alone) {
      newest.push_back(&keeper_.births().pool().stations().at(station).bearings.back());
    }
    for (const Sighting* const sighting : newest) {
      const auto line = line_of(*sighting, epoch_us);
      if (!line) continue;
      if (++lines > kLines) return;
      target.target_id = keeper_.identify(*sighting, told);
      target.stations = {{station, true, 1.0, 0.0}};
      target.bearing_only = line;
      output.targets.push_back(target);
    }
  }
}

// Stations that have lately sent what no track explains.
std::vector<std::string> Fusion::on_a_line(std::int64_t epoch_us) const {
  std::vector<std::string> found;
  for (const auto& [name, own] : keeper_.births().pool().stations()) {
    const double age_s = std::abs(seconds(epoch_us - own.looks.back().utime_us));
    const bool lately = age_s <= config_.estimators.alignment.max_age_s;
    if (lately && pointing_.quarantine(name).empty()) found.push_back(name);
  }
  return found;
}

// What a station follows by a name of its own and no track takes: the newest bearing of each, the
// smallest names first, which most trackers gave first.
std::vector<const Sighting*> Fusion::lines_of(const std::string& station,
                                              std::int64_t epoch_us) const {
  const BearingPool::Station& own = keeper_.births().pool().stations().at(station);
  std::vector<const Sighting*> lines;
  std::vector<std::int64_t> names;
  for (std::size_t i = own.looks.size(); i-- > 0;) {
    const Look& look = own.looks[i];
    if (std::abs(seconds(epoch_us - look.utime_us)) > config_.estimators.alignment.max_age_s) break;
    if (look.track_id == 0 || std::ranges::find(names, look.track_id) != names.end()) continue;
    names.push_back(look.track_id);
    if (!keeper_.takes(own.bearings[i], epoch_us, kFollowsS)) lines.push_back(&own.bearings[i]);
  }
  std::ranges::sort(lines, {}, [](const Sighting* line) { return line->track_id; });
  if (lines.size() > kOfAStation) lines.resize(kOfAStation);
  return lines;
}

std::optional<BearingOnly> Fusion::line_of(const Sighting& newest, std::int64_t epoch_us) const {
  std::vector<Sighting> own;
  std::ranges::copy_if(keeper_.births().pool().stations().at(newest.station).bearings,
                       std::back_inserter(own),
                       [&](const Sighting& s) { return s.track_id == newest.track_id; });
  const auto ray = align(own, epoch_us, std::nullopt, config_.estimators.alignment);
  if (!ray) return std::nullopt;
  return BearingOnly{newest.station, newest.track_id, ray->sight, ray->rate_rad_s};
}

// A target that it follows, or did a moment ago.
bool Fusion::sees(const Station& station, std::int64_t now) {
  return station.follows != 0 && seconds(now - station.followed_us) < kFollowsS;
}

void Fusion::begin_slews(std::int64_t now_us) {
  slewed_us_ = now_us;
  slew_next_ = "";
  slew_round_ = {.now_us = now_us};
  for (const auto& [name, station] : stations_) {
    if (sees(station, now_us)) ++slew_round_.seen_by[station.follows];
  }
  for (const std::string& station : on_a_line(now_us)) {
    const auto lines = lines_of(station, now_us);
    if (lines.empty()) continue;  // many detections, not an object that it follows
    slew_round_.on_a_line.insert(station);
    if (slew_round_.ray) continue;
    const auto line = line_of(*lines.front(), now_us);
    if (!line) continue;
    slew_round_.ray = CueRay{station, line->sight.origin_ecef, direction_ecef(line->sight)};
  }
}

void Fusion::plan(std::int64_t now_us, FusionOutput& output) {
  if (!slew_next_ && due(slewed_us_, now_us, config_.slew.rate_hz)) begin_slews(now_us);
  if (!slew_next_) return;
  slew_round_.now_us = now_us;  // a round may take a while; each slew is for when it is made
  std::vector<SlewStation> some;
  auto station = stations_.lower_bound(*slew_next_);
  for (; station != stations_.end() && some.size() < kSlewsABearing; ++station) {
    const bool follows = sees(station->second, now_us);
    some.push_back({station->first, station->second.traits, follows ? station->second.follows : 0});
  }
  slew_next_.reset();
  if (station != stations_.end()) slew_next_ = station->first;
  output.slews = planner_.plan(slew_round_, some, keeper_.tracks());
  counters_["slews"] += static_cast<double>(output.slews.size());
}

}  // namespace ols
