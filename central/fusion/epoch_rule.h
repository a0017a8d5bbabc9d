// Chooses the epochs: the instants for which targets are published. An epoch is the newest time
// stamp of all bearings: the targets are then as recent as possible. Most stations' newest bearings
// may be older than the epoch, because the filter predicts every target to the epoch. Pure.
//
// A station is delivering if it has sent a bearing recently. A delivering station is due if its
// frame of this instant is probably on its way. Its next frame is expected one frame interval after
// its newest frame. The station is due if the time of this frame is between 20 ms before the epoch
// and 5 ms after it (a quarter of the interval, if that is shorter). An epoch is published as soon
// as fewer than half of the delivering stations are due. Stations that expose together are
// therefore published together, and stations that expose in turn cause no delay. If a station
// misses a frame, no epoch waits for that station until it delivers again. No epoch waits for more
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
  // Takes the time stamp of an admitted bearing. now_us: the median of the stations' newest stamps.
  // If the stamp is ahead of now_us by more than the station's frame interval, it is not used as an
  // epoch: the station's clock is wrong.
  void hear(const std::string& station, std::int64_t utime_us, std::int64_t now_us);
  // The epoch that is to be published now. nullopt before the first stamp, within a period of the
  // last epoch, and while half or more of the stations are due. Each check passes through all
  // stations. With more than 32 stations, it is therefore made only every few bearings.
  std::optional<std::int64_t> after(const std::optional<std::int64_t>& last_us, double rate_hz);
  void forget(const std::string& station) {
    stations_.erase(station);
    ++changes_;
  }
  void clear() { *this = EpochRule(); }

 private:
  struct Station {
    std::int64_t newest_us = 0;
    // The smaller of the last two intervals between frames. Using the smaller one removes the
    // effect of a lost frame or a step of the clock. 0 until the second frame.
    std::int64_t interval_us = 0;
    std::int64_t last_interval_us = 0;

    bool is_due(std::int64_t by_us) const;
  };
  bool most_have_arrived() const;

  std::map<std::string, Station> stations_;
  std::int64_t newest_us_ = 0;
  std::size_t changes_ = 0;  // number of bearings since all stations were last checked
};

}  // namespace ols::fusion
