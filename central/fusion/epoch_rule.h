// Chooses the epochs: the instants for which targets are published. An epoch is the newest stamp,
// as recent as the bearings allow. The filter predicts every target to it, so most stations need
// not have passed it. Pure.
//
// A station is delivering if it has sent a bearing lately. It is due if its next frame, one frame
// interval after its newest, is older than the epoch: that bearing is on its way. An epoch is
// published as soon as fewer than half of the delivering stations are due. Stations that expose
// together are thus all included, and stations that expose in turn keep nobody waiting. A station
// that misses a frame is not waited for until it delivers again. No epoch waits longer than 20 ms
// of message time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace ols::fusion {

class EpochRule {
 public:
  // Takes an admitted bearing. now_us: the median of the stations' newest stamps. A stamp ahead of
  // it by more than the station's frame interval is no epoch: that clock is wrong.
  void hear(const std::string& station, std::int64_t utime_us, std::int64_t now_us);
  // The epoch that is to be published now, or nullopt: before the first stamp, within a period of
  // the last epoch, and while half of the stations or more are due. With more than 32 stations it
  // is looked up only every few bearings, because a look passes through all stations.
  std::optional<std::int64_t> after(const std::optional<std::int64_t>& last_us, double rate_hz);
  void forget(const std::string& station) {
    stations_.erase(station);
    ++changes_;
  }
  void clear() { *this = EpochRule(); }

 private:
  struct Station {
    std::int64_t newest_us = 0;
    // The smaller one of the last two intervals between frames, so that a lost frame or a step of
    // the clock does not count. 0: only one frame yet.
    std::int64_t interval_us = 0;
    std::int64_t last_interval_us = 0;

    bool is_due(std::int64_t by_us) const;
  };
  bool most_are_heard() const;

  std::map<std::string, Station> stations_;
  std::int64_t newest_us_ = 0;
  std::size_t changes_ = 0;  // bearings since the last look at all stations
};

}  // namespace ols::fusion
