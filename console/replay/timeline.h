// What a replay has learnt about a whole recording: snapshots, from which the state at any time can
// be rebuilt, and the events on the timeline. If all snapshots together become too large, every
// second snapshot is dropped. Pure.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "console/console.h"

namespace ols::console {

struct Snapshot {
  std::int64_t utime_us = 0;
  std::uint64_t offset = 0;  // position of the next message in the log
  std::size_t bytes = 0;     // size as text
  Moment moment;
};

class Timeline {
 public:
  // Call after each message: `console` has received everything up to this time and offset.
  void reach(std::int64_t utime_us, std::uint64_t offset, const Console& console);
  // Call at the end of the log.
  void end(const Console& console) { add_marks(console); }
  // Adds the beginning or the end of a target as an event.
  void receive(const ReceivedTarget& target, std::int64_t utime_us);

  // The last snapshot at or before this time; null if there is none.
  const Snapshot* before(std::int64_t utime_us) const;
  std::int64_t first_us() const { return first_us_; }
  std::int64_t last_us() const { return last_us_; }
  std::size_t snapshots() const { return snapshots_.size(); }
  // {first_us, last_us, marks, marks_left_out}. marks are the events in the order of their times,
  // each with utime_us, kind, station, who, text and outcome.
  Json json() const;
  std::uint64_t changes() const { return changes_; }  // grows with each new or changed mark

  static constexpr std::size_t kMostMarks = 5000;
  static constexpr std::size_t kMostTargets = 10'000;  // present at the same time; only a forged
                                                       // log has more
  static constexpr std::size_t kMostSnapshotBytes = 8'000'000;  // of all snapshots together, as
                                                                // text
  static constexpr std::int64_t kLook_us = 500'000;

 private:
  void add_marks(const Console& console);
  void add_mark(Json mark);
  void add_snapshot(std::uint64_t offset, const Console& console);
  void thin_out();

  std::vector<Snapshot> snapshots_;
  std::size_t snapshot_bytes_ = 0;
  std::int64_t interval_us_ = 5'000'000;
  std::int64_t first_us_ = 0, last_us_ = 0, looked_us_ = 0;
  Revision seen_ = 0;
  std::vector<Json> marks_;
  std::map<std::uint64_t, std::size_t> of_event_;  // by event number: index of the event's mark
  std::uint64_t left_out_ = 0, changes_ = 0;
  std::set<std::string> alive_;
  std::int64_t fusion_boot_ = 0;
};

}  // namespace ols::console
