#include "central/fusion/bearing_lines.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "central/measurement/activity.h"
#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr std::size_t kOfAStation = 4;

}  // namespace

// The newest bearing that counts; -1: none.
std::ptrdiff_t BearingLines::newest_look(const UnassociatedBearings::Station& own) const {
  auto i = std::ssize(own.looks) - 1;
  while (i >= 0 && !with_tracklets_ && own.looks[static_cast<std::size_t>(i)].is_tracklet) --i;
  return i;
}

const UnassociatedBearings::Station& BearingLines::bearings_of(const std::string& station) const {
  return tracks_.unassociated().stations().at(station);
}

std::vector<std::string> BearingLines::stations(std::int64_t epoch_us) const {
  std::vector<std::string> found;
  for (const auto& [name, own] : tracks_.unassociated().stations()) {
    const auto newest = newest_look(own);
    const bool lately =
        newest >= 0 &&
        std::abs(seconds(epoch_us - own.looks[static_cast<std::size_t>(newest)].utime_us)) <=
            config_.max_age_s;
    if (lately && pointing_.quarantine(name).empty()) found.push_back(name);
  }
  return found;
}

std::vector<const BearingMeasurement*> BearingLines::of(const std::string& station,
                                                        std::int64_t epoch_us) const {
  const UnassociatedBearings::Station& own = bearings_of(station);
  std::vector<const BearingMeasurement*> lines;
  std::vector<std::int64_t> names;
  for (std::size_t i = own.looks.size(); i-- > 0;) {
    const BearingSummary& look = own.looks[i];
    if (std::abs(seconds(epoch_us - look.utime_us)) > config_.max_age_s) break;
    if (look.track_id == 0 || (look.is_tracklet && !with_tracklets_) ||
        std::ranges::find(names, look.track_id) != names.end())
      continue;
    names.push_back(look.track_id);
    if (!is_taken(own.bearings[i], epoch_us)) {
      lines.push_back(&own.bearings[i]);
    }
  }
  std::ranges::sort(lines, {}, [](const BearingMeasurement* line) { return line->track_id; });
  if (!with_tracklets_ && lines.size() > kOfAStation) lines.resize(kOfAStation);
  return lines;
}

const BearingMeasurement* BearingLines::newest_of(const std::string& station) const {
  const UnassociatedBearings::Station& own = bearings_of(station);
  return &own.bearings[static_cast<std::size_t>(newest_look(own))];
}

bool BearingLines::is_taken(const BearingMeasurement& of, std::int64_t epoch_us) const {
  return tracks_.takes(of, epoch_us, Activity::kFollowsS);
}

std::optional<BearingOnly> BearingLines::at(const BearingMeasurement& newest,
                                            std::int64_t epoch_us) const {
  std::vector<BearingMeasurement> own;
  std::ranges::copy_if(bearings_of(newest.station).bearings, std::back_inserter(own),
                       [&](const BearingMeasurement& s) { return s.track_id == newest.track_id; });
  const auto ray = align(own, epoch_us, std::nullopt, config_);
  if (!ray) return std::nullopt;
  return BearingOnly{newest.station, newest.track_id, ray->sight, ray->rate_rad_s};
}

}  // namespace ols::fusion
