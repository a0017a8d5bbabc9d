// The fusion's "now": the median of the stations' newest stamps. No other clock is used. A replay
// therefore gives the same results as the live run, and a station's wrong clock affects only that
// station.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/measurement/activity.h"

namespace ols::fusion {

class MessageTime {
 public:
  // A station counts as delivering until the stamps of the others have advanced by silence_s since
  // its last message.
  explicit MessageTime(double silence_s = Activity::kDeliversS) : silence_s_(silence_s) {}

  // Takes every message's stamp, in order of arrival. Returns true if the station's clock has
  // stepped back: three stamps in a row are more than a second older than its newest one.
  bool hear(const std::string& station, std::int64_t utime_us);
  // The median of the newest stamps of the delivering stations; 0 before the first stamp. For an
  // even number of stations, the median is the lower of the two middle stamps: the higher one would
  // make targets due before most stations' bearings have arrived. Untrusted stations count only
  // while no station is trusted. With more than kMany stations, the median is recomputed only after
  // every few messages.
  std::int64_t now_us() const { return now_us_; }
  // The same median over all stations, trusted or not.
  std::int64_t middle_us() const { return middle_us_; }
  void trust(const std::string& station, bool trusted);
  // The station's newest stamp; 0 before the first.
  std::int64_t newest_us(const std::string& station) const;
  // How long the station has been silent: the progress of the other stations' stamps since its last
  // message. 0 before its first message.
  double silent_s(const std::string& station) const;
  // The delivering stations, and their number.
  std::vector<std::string> delivering() const;
  std::size_t delivering_count() const { return delivering_; }
  // The time that has passed since the start: the largest progress of any station's stamps. A step
  // of a clock counts as at most half of silence_s.
  double elapsed_s() const { return elapsed_s_; }
  void forget(const std::string& station);

 private:
  struct Station {
    std::int64_t newest_us = 0;
    bool trusted = true;
    int older = 0;            // number of consecutive stamps more than a second before newest_us
    double progress_s = 0.0;  // elapsed time by its own clock, with steps clipped
    double heard_s = 0.0;     // elapsed_s_ at its last message
  };
  static constexpr std::size_t kMany = 32;
  bool delivers(const Station& station) const;
  void take_medians();
  double silence_s_;
  double elapsed_s_ = 0.0;
  std::int64_t now_us_ = 0, middle_us_ = 0;
  std::size_t delivering_ = 0;
  std::size_t heard_ = 0;  // number of messages since the medians were last computed
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
