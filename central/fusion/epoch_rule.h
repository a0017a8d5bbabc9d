// Chooses the epochs: the instants for which targets are published. An epoch is the newest stamp,
// so that targets are as recent as the bearings allow. The filter predicts every target to the
// epoch, so most stations need not have bearings later than it. Pure.
//
// A station is delivering if it has sent a bearing lately. It is due if its next frame, one frame
// interval after its newest, is older than the epoch, because that bearing is still on its way. An
// epoch is published as soon as fewer than half of the delivering stations are due. So all stations
// that expose together are included, and stations that expose in turn cause no wait. After a
// station has missed a frame, no epoch waits for it until it delivers again. No epoch waits longer
// than 20 ms of message time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace ols::fusion {

class EpochRule {
 public:
  // Takes an admitted bearing. now_us: the median of the stations' newest stamps. A stamp that is
  // ahead of now_us by more than the station's frame interval is no epoch: that clock is wrong.
  void hear(const std::string& station, std::int64_t utime_us, std::int64_t now_us);
  // The epoch that is to be published now, or nullopt: before the first stamp, within a period of
  // the last epoch, and while half of the stations or more are due. With more than 32 stations this
  // is checked only every few bearings, because each check passes through all stations.
  std::optional<std::int64_t> after(const std::optional<std::int64_t>& last_us, double rate_hz);
  void forget(const std::string& station) {
    stations_.erase(station);
    ++changes_;
  }
  void clear() { *this = EpochRule(); }

 private:
  struct Station {
    std::int64_t newest_us = 0;
    // The smaller of the last two intervals between frames, so that a lost frame or a step of the
    // clock does not count. 0: there was only one frame so far.
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
