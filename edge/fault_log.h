// The newest trouble of a station and when it came up. An alarm goes by itself; this stays. And the
// news, good and bad, for the journal. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "edge/journal.h"

namespace ols::station {

class FaultLog {
 public:
  // What a source has to say now, and a number that tells a new trouble in the same words. The same
  // words again and again (a device that is not there, tried each second) are one trouble, so that
  // they do not hide what else comes up.
  void note(const std::string& source, const std::string& what, std::uint64_t number,
            std::int64_t utime_us);
  // The same for what happens because somebody did something: each time is another trouble.
  void note_event(const std::string& source, const std::string& what, std::uint64_t number,
                  std::int64_t utime_us);
  // The alarms that hold now; one that did not hold a moment ago is a trouble. Its numbers may
  // change ("silent for 5 s") without it becoming another one.
  void note_alarms(const std::vector<std::string>& alarms, std::int64_t utime_us);

  // Of what is always in one state or another; another one is news, whatever the `details` are.
  void note_state(const std::string& source, const std::string& state, const std::string& details,
                  bool bad);

  // What came up or ended since the last call, in the order of its coming.
  std::vector<News> take_event() { return std::exchange(news_, {}); }

  const std::string& text() const { return text_; }  // empty: there was none
  std::int64_t utime_us() const { return utime_us_; }

 private:
  struct Noted {
    std::string what;
    std::uint64_t number = 0;
    std::int64_t utime_us = 0;  // when it was said last
  };
  void set(const std::string& source, const std::string& what, std::int64_t utime_us);

  std::map<std::string, Noted> noted_;
  std::map<std::string, std::string> alarms_;  // by their words without digits
  std::map<std::string, std::string> states_;  // by source
  std::vector<News> news_;
  std::string text_;
  std::int64_t utime_us_ = 0;
};

}  // namespace ols::station
