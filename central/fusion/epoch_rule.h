// The instant for which targets are published: as new as the bearings allow. The filter predicts
// every target to it, so it need not be one that most stations have passed. Pure.
//
// It is the newest stamp. A station is delivering if it has sent a bearing lately, and due if its
// next frame, a frame interval after its newest one, is older than that stamp: it is on its way.
// Published is as soon as fewer than half of the delivering stations are due. Stations that expose
// together are thus heard before it, and those that expose in turn keep nobody waiting. One that
// misses a frame is not waited for until it delivers again, and no epoch waits for longer than 20
// ms of message time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace ols::fusion {

class EpochRule {
 public:
  // An admitted bearing, at the time "now": the median of the stations' newest stamps. A stamp that
  // is ahead of it by more than the station's frame interval is no epoch: that clock is wrong.
  void hear(const std::string& station, std::int64_t utime_us, std::int64_t now_us);
  // The newest stamp; nullopt before the first, within a period of the last epoch, and while half
  // of the stations or more are due. Of more than 32 stations, some bearings later: each is not
  // worth a look at all stations.
  std::optional<std::int64_t> after(const std::optional<std::int64_t>& last_us, double rate_hz);
  void forget(const std::string& station) {
    stations_.erase(station);
    ++changes_;
  }
  void clear() { *this = EpochRule(); }

 private:
  struct Station {
    std::int64_t newest_us = 0;
    // Between its newest frames, the smaller one of two: a lost frame or a step of its clock is
    // none. 0: it has sent only one frame.
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
