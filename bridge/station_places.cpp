#include "bridge/station_places.h"

#include <algorithm>

namespace ols::bridge {

const StationPlaces::Place* StationPlaces::find(const std::string& station) const {
  const auto at = places_.find(station);
  return at == places_.end() ? nullptr : &at->second;
}

bool StationPlaces::is_elsewhere(const std::string& station, const std::string& region,
                                 const std::string& site, double now_s) const {
  const Place* const place = find(station);
  return place != nullptr && (place->region != region || place->site != site) &&
         now_s - place->heard_s < kSettled_s;
}

bool StationPlaces::settle(const std::string& station, const std::string& region,
                           const std::string& site, double now_s) {
  if (is_elsewhere(station, region, site, now_s)) return false;
  const Site there{region, site};
  const auto at = places_.find(station);
  const bool is_there =
      at != places_.end() && at->second.region == region && at->second.site == site;
  if (!is_there && !has_room(there, now_s)) return false;
  // has_room() may have forgotten its old place.
  const auto [place, is_new] = places_.try_emplace(station);
  if (!is_there) {
    if (!is_new) --counts_[{place->second.region, place->second.site}];
    ++counts_[there];
  }
  place->second = {region, site, now_s};
  return true;
}

bool StationPlaces::has_room(const Site& site, double now_s) {
  const auto fits = [this, &site] {
    const auto count = counts_.find(site);
    return places_.size() < kMost && (count == counts_.end() || count->second < kMostOfSite);
  };
  if (fits()) return true;
  if (now_s - swept_s_ < kSweep_s) return false;
  swept_s_ = now_s;
  forget_silent(now_s);
  return fits();
}

void StationPlaces::forget_silent(double now_s) {
  std::erase_if(places_,
                [now_s](const auto& one) { return now_s - one.second.heard_s >= kSettled_s; });
  counts_.clear();
  for (const auto& [station, place] : places_) ++counts_[{place.region, place.site}];
}

std::map<std::string, double> StationPlaces::sites_ago_s(double now_s) const {
  std::map<std::string, double> ago;
  for (const auto& [station, place] : places_) {
    const double here = now_s - place.heard_s;
    if (here > kSettled_s) continue;
    const auto [at, is_new] = ago.try_emplace(place.site, here);
    if (!is_new) at->second = std::min(at->second, here);
  }
  return ago;
}

}  // namespace ols::bridge
