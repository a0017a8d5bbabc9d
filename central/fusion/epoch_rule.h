// Chooses the epochs: the instants for which targets are published. An epoch is the newest stamp,
// so that targets are as recent as possible. The filter predicts every target to the epoch. Most
// stations' newest bearings may therefore be older than the epoch. Pure.
//
// A station is delivering if it has sent a bearing recently. A delivering station is due if a frame
// of this instant must be on its way: its next frame (one frame interval after its newest) is at
// most 20 ms older than the epoch, or at most 5 ms (and a quarter of the interval) newer. An epoch
// is published as soon as fewer than half of the delivering stations are due. All stations that
// expose together are therefore included, and stations that expose in turn cause no delay. After a
// station has missed a frame, no epoch waits for it until it delivers again. No epoch waits for
// more than 20 ms of message time.
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
  // ahead of now_us by more than the station's frame interval is not used as an epoch, because that
  // clock is wrong.
  void hear(const std::string& station, std::int64_t utime_us, std::int64_t now_us);
  // The epoch that is to be published now. nullopt before the first stamp, within a period of the
  // last epoch, and while half of the stations or more are due. With more than 32 stations this is
  // checked only every few bearings, because each check passes through all stations.
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
    // clock has no effect. 0 while there was only one frame.
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
