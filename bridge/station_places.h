// The region and site of each station. A station's name belongs to the place (region and site) from
// which its messages come, until the station falls silent. Without this rule, a fusion would take
// two stations of the same name for one, and messages that came in would go out again. Pure.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace ols::bridge {

class StationPlaces {
 public:
  static constexpr double kSettled_s = 60.0;  // after this much silence, a station's name is free
                                              // again
  // Limits of the number of stations, per site and for all sites together: invented names of one
  // site leave room for the other sites.
  static constexpr std::size_t kMostOfSite = 2'000, kMost = 20'000;

  struct Place {
    std::string region, site;
    double heard_s = 0.0;
  };

  // The place from which the station's last message came; null: none is known.
  const Place* find(const std::string& station) const;
  // Whether the station's name now belongs to a place other than this one.
  bool is_elsewhere(const std::string& station, const std::string& region, const std::string& site,
                    double now_s) const;
  // Notes that a message of the station came from this place. False: the name belongs to another
  // place, or there is no room.
  bool settle(const std::string& station, const std::string& region, const std::string& site,
              double now_s);
  std::size_t size() const { return places_.size(); }
  // By site: the time since the last message of any of its stations.
  std::map<std::string, double> sites_ago_s(double now_s) const;

 private:
  // Shortest time between two searches for silent stations, even if new names arrive faster.
  static constexpr double kSweep_s = 1.0;

  using Site = std::pair<std::string, std::string>;  // region, site
  bool has_room(const Site& site, double now_s);
  void forget_silent(double now_s);

  std::map<std::string, Place> places_;
  std::map<Site, std::size_t> counts_;
  double swept_s_ = -1e9;
};

}  // namespace ols::bridge
