#include "calibration/mistaken_sightings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "calibration/snooping.h"
#include "geometry/chi_square.h"

namespace ols::calibration {
namespace {

// What is rejected as one: a sighting of a drone or an aircraft, an instant of a track.
struct Part {
  std::size_t group = 0, block = 0;
  std::optional<std::size_t> sighting;  // of the block; else all
  std::vector<std::size_t> observations;
  int degrees_of_freedom = 2;
};

std::vector<Part> parts_of(const Network& network) {
  std::vector<Part> parts;
  for (std::size_t g = 0; g < network.groups.size(); ++g) {
    const Group& group = network.groups[g];
    if (!group.is_followed()) continue;
    auto next = group.observations.begin();
    for (const std::size_t b : group.blocks) {
      const std::size_t count = network.blocks[b]->sighting_count();
      const auto end = next + static_cast<std::ptrdiff_t>(count);
      if (group.kind == Kind::kTrack) {
        const int free = std::max(1, network.blocks[b]->degrees_of_freedom());
        parts.push_back({g, b, std::nullopt, {next, end}, free});
      } else {
        for (std::size_t k = 0; k < count; ++k) parts.push_back({g, b, k, {next[k]}});
      }
      next = end;
    }
  }
  return parts;
}

// Each sighting of a drone or an aircraft as a group of its own, as if nothing joined them: a few
// that are grossly wrong must not make all the others disagree with every heading.
Network apart(const Network& network, const std::vector<Part>& parts) {
  Network result = network;
  std::erase_if(result.groups, &Group::is_followed);
  result.blocks.resize(network.priors_from);
  for (const Part& part : parts) {
    // Not a copy of the whole group: each would keep room for the observations of all.
    const Group& whole = network.groups[part.group];
    Group own{whole.kind,   whole.name,        whole.station,
              {part.block}, part.observations, whole.degrees_of_freedom};
    if (part.sighting) {
      own.blocks = {result.blocks.size()};
      result.blocks.push_back(network.blocks[part.block]->with_only({*part.sighting}));
      own.degrees_of_freedom = result.blocks.back()->degrees_of_freedom();
    }
    result.groups.push_back(std::move(own));
  }
  const auto priors = network.blocks.begin() + static_cast<std::ptrdiff_t>(network.priors_from);
  result.priors_from = result.blocks.size();
  result.blocks.insert(result.blocks.end(), priors, network.blocks.end());
  return result;
}

class SightingTests {
 public:
  SightingTests(const Network& whole, const Levels& levels, const TellAdjusted& tell)
      : whole_(whole),
        levels_(levels),
        tell_(tell),
        parts_(parts_of(whole)),
        out_(parts_.size(), false) {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].sighting) sighted_[parts_[p].block].push_back(p);
    }
  }

  std::set<std::size_t> run() {
    if (parts_.empty()) return {};
    Fit fit = begin();
    while (usable(fit) && tried_.insert({fit.kept, out_}).second) {
      if (tell_) tell_();
      const auto change = next_change(fit);
      if (!change) break;
      std::vector<bool> kept = fit.kept;
      if (change->group) kept[*change->group].flip();
      for (const std::size_t p : change->parts) out_[p].flip();
      fit = Adjustment(without(whole_, left_out())).fit(fit.state, kept);
    }
    // A group that is rejected is rejected with all that it has.
    std::set<std::size_t> result;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!out_[p] || !fit.kept[parts_[p].group] || !may_go(parts_[p].group, 0)) continue;
      result.insert(parts_[p].observations.begin(), parts_[p].observations.end());
    }
    return result;
  }

 private:
  struct Change {
    std::optional<std::size_t> group;
    std::vector<std::size_t> parts;
    double over = 1.0;  // the statistic over its critical value
  };
  using Worst = std::optional<Change>;

  static bool usable(const Fit& fit) {
    return std::isfinite(fit.misfit) && fit.covariance.allFinite();
  }

  Fit begin() {
    const Start start = find_start(Adjustment(apart(whole_, parts_)), levels_.mistaken);
    std::vector<bool> kept(whole_.groups.size(), true);
    // In `apart` the other groups come first, in their order.
    std::size_t next = 0;
    for (std::size_t g = 0; g < kept.size(); ++g) {
      if (!whole_.groups[g].is_followed()) kept[g] = start.kept[next++];
    }
    std::vector<double> headings_rad;
    for (const StationState& station : start.state.stations) {
      headings_rad.push_back(station.model.geometry.chain.heading_rad);
    }
    const State state = Adjustment(whole_).start(headings_rad);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      // Lines of sight that meet behind a camera would stop the adjustment.
      const std::size_t b = parts_[p].block;
      out_[p] = parts_[p].sighting ? !start.kept[next + p]
                                   : !whole_.blocks[b]->equations(state, b, 0.0).valid;
    }
    for (std::size_t g = 0; g < kept.size(); ++g) {
      if (whole_.groups[g].is_followed() && !may_go(g, 0)) kept[g] = false;
    }
    return Adjustment(without(whole_, left_out())).fit(state, kept);
  }

  std::set<std::size_t> left_out() const {
    std::set<std::size_t> observations;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (out_[p])
        observations.insert(parts_[p].observations.begin(), parts_[p].observations.end());
    }
    return observations;
  }
  // Whether so many more of a group's parts may be mistaken before the group itself is.
  bool may_go(std::size_t group, std::size_t more) const {
    std::size_t all = 0, out = more;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].group != group) continue;
      ++all;
      out += out_[p] ? 1 : 0;
    }
    return 3 * out <= all;
  }

  double critical(const Part& part) const {
    return chi_square_critical(levels_.mistaken / static_cast<double>(parts_.size()),
                               part.degrees_of_freedom);
  }

  // By how much the misfit falls without a part that is kept, or grows with one that is not; over
  // its critical value, by part.
  std::vector<double> parts_over_critical(const Adjustment& adjustment, const Fit& fit) const {
    std::vector<double> over(parts_.size(), 0.0);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Part& part = parts_[p];
      if (!fit.kept[part.group]) continue;
      if (!part.sighting) over[p] = over_critical(part, statistic_of_block(fit, p));
      if (part.sighting && out_[p]) over[p] = over_critical(part, statistic_with(fit, p));
    }
    for (const auto& [block, parts] : sighted_) {
      if (!fit.kept[parts_[parts.front()].group]) continue;
      std::vector<std::size_t> kept;
      std::ranges::copy_if(parts, std::back_inserter(kept),
                           [this](std::size_t p) { return !out_[p]; });
      const auto test = [&](std::size_t k, const BlockEquations& without) {
        const Part& part = parts_[kept[k]];
        over[kept[k]] =
            over_critical(part, replacement_statistic(fit, fit.equations[part.block], without));
      };
      adjustment.network().blocks[block]->without_each(fit.state, block, test);
    }
    return over;
  }
  // What cannot be computed does not pass.
  double over_critical(const Part& part, double statistic) const {
    return std::isnan(statistic) ? std::numeric_limits<double>::infinity()
                                 : statistic / critical(part);
  }
  // An instant of a track is a block, in the adjustment or not.
  double statistic_of_block(const Fit& fit, std::size_t p) const {
    const BlockEquations& equations = fit.equations[parts_[p].block];
    if (!equations.valid) return std::numeric_limits<double>::infinity();
    BlockEquations nothing = equations;
    nothing.information.setZero();
    nothing.gradient.setZero();
    nothing.squares = 0.0;
    return out_[p] ? -replacement_statistic(fit, nothing, equations)
                   : replacement_statistic(fit, equations, nothing);
  }
  // Of a sighting that was rejected, if it came back.
  double statistic_with(const Fit& fit, std::size_t p) const {
    const std::size_t block = parts_[p].block;
    std::vector<std::size_t> which;
    std::size_t here = 0;
    for (const std::size_t q : sighted_.at(block)) {
      if (out_[q] && q != p) continue;
      if (q == p) here = which.size();
      which.push_back(*parts_[q].sighting);
    }
    const BlockPtr with = whole_.blocks[block]->with_only(which);
    const BlockEquations equations = with->equations(fit.state, block, 0.0);
    if (!equations.valid) return std::numeric_limits<double>::infinity();
    double statistic = 0.0;
    with->without_each(fit.state, block, [&](std::size_t k, const BlockEquations& without) {
      if (k == here) statistic = -replacement_statistic(fit, without, equations);
    });
    return statistic;
  }

  // As calibrate() does: first what passes is taken back, the best first; else the worst goes.
  Worst next_change(const Fit& fit) const {
    const Adjustment adjustment(without(whole_, left_out()));
    const std::vector<double> over = parts_over_critical(adjustment, fit);
    Worst best, worst;
    const auto consider = [&](const Change& change, bool is_kept) {
      if (is_kept && change.over > (worst ? worst->over : 1.0)) worst = change;
      if (!is_kept && change.over < (best ? best->over : 1.0)) best = change;
    };
    for (std::size_t g = 0; g < whole_.groups.size(); ++g) {
      const Group& group = whole_.groups[g];
      if (!group.is_tested()) continue;
      const std::vector<std::size_t> failing = failing_parts(g, fit, over);
      if (!failing.empty() && may_go(g, failing.size())) {
        consider({std::nullopt, failing, over[failing.front()]}, true);
        continue;
      }
      const double statistic = test_statistic(adjustment, fit, g);
      const double limit =
          critical_value(adjustment.groups()[g], whole_.groups.size(), levels_.mistaken);
      // Where too many of its sightings fail, all fail.
      const double worst_part = failing.empty() ? 0.0 : over[failing.front()];
      consider({g, {}, std::max(worst_part, statistic / limit)}, fit.kept[g]);
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (out_[p] && fit.kept[parts_[p].group]) consider({std::nullopt, {p}, over[p]}, false);
    }
    if (best && !was_tried(fit, *best)) return best;
    return worst;
  }
  // Of a kept group the worst first: one, of many a fiftieth at once; what is good is taken back.
  std::vector<std::size_t> failing_parts(std::size_t group, const Fit& fit,
                                         const std::vector<double>& over) const {
    constexpr std::size_t kAtOnce = 50;
    std::vector<std::size_t> failing;
    std::size_t all = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].group != group) continue;
      ++all;
      if (fit.kept[group] && !out_[p] && over[p] > 1.0) failing.push_back(p);
    }
    std::ranges::sort(failing, std::ranges::greater(), [&over](std::size_t p) { return over[p]; });
    failing.resize(std::min(failing.size(), std::max<std::size_t>(1, all / kAtOnce)));
    return failing;
  }
  bool was_tried(const Fit& fit, const Change& change) const {
    auto after = std::pair(fit.kept, out_);
    if (change.group) after.first[*change.group].flip();
    for (const std::size_t p : change.parts) after.second[p].flip();
    return tried_.contains(after);
  }

  const Network& whole_;
  Levels levels_;
  const TellAdjusted& tell_;
  std::vector<Part> parts_;
  std::map<std::size_t, std::vector<std::size_t>>
      sighted_;            // parts of blocks with several, by block
  std::vector<bool> out_;  // by part
  std::set<std::pair<std::vector<bool>, std::vector<bool>>> tried_;
};

}  // namespace

std::set<std::size_t> mistaken_sightings(const Network& network, const Levels& levels,
                                         const TellAdjusted& tell) {
  return SightingTests(network, levels, tell).run();
}

Network without(const Network& network, const std::set<std::size_t>& observations) {
  Network result = network;
  if (observations.empty()) return result;
  for (Group& group : result.groups) {
    if (!group.is_followed()) continue;
    const Group before = group;
    group.blocks.clear();
    group.observations.clear();
    group.degrees_of_freedom = 0;
    std::size_t first = 0;
    for (const std::size_t b : before.blocks) {
      std::vector<std::size_t> kept;
      for (std::size_t k = 0; k < network.blocks[b]->sighting_count(); ++k) {
        const std::size_t observation = before.observations[first + k];
        if (observations.contains(observation)) continue;
        kept.push_back(k);
        group.observations.push_back(observation);
      }
      first += network.blocks[b]->sighting_count();
      if (kept.empty()) continue;
      if (kept.size() < network.blocks[b]->sighting_count())
        result.blocks[b] = network.blocks[b]->with_only(kept);
      group.blocks.push_back(b);
      group.degrees_of_freedom += result.blocks[b]->degrees_of_freedom();
    }
  }
  return result;
}

}  // namespace ols::calibration
