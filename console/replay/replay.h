// Shows a recorded log on the console as if everything happened now; can play, pause and jump.
// Meanwhile it reads the whole log once, a little in each turn, to make the timeline and snapshots
// of the state. A jump rebuilds the state from the nearest earlier snapshot, and shows the state
// when it is complete. Replay reads no clock.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/bus/log_reader.h"
#include "console/console.h"
#include "console/replay/recorded_frames.h"
#include "console/replay/timeline.h"

namespace ols::console {

class Replay {
 public:
  // Throws std::invalid_argument naming the file if it contains no message of a site.
  Replay(const std::string& log, RecordedFrames frames, Console& console);

  // Call often: reads the log, plays, and carries out viewers' requests.
  void turn(double monotonic_s);
  std::string in_one_line() const;
  bool is_read() const { return is_scanned_; }  // whether the whole log was read once
  // What is wrong with the log and the frames so far, in words for a person; empty: no problem.
  std::string problem() const;

  static constexpr int kScannedAtOnce = 1500;  // messages per turn; each takes about 20 us
  static constexpr int kPlayedAtOnce = 1500;

 private:
  struct Playback {
    bool is_playing = true;
    double speed = 1.0, at_us = 0.0;
  };
  struct Told {
    bool is_urgent = true;                      // viewers should receive it at once
    std::uint64_t changes = ~std::uint64_t{0};  // Timeline::changes() when viewers were last sent
                                                // the timeline
    double timeline_s = -1e9;
  };
  void obey();
  void scan();
  void seek(std::int64_t at_us);
  void play(double elapsed_s);
  void show_frames();
  void tell();
  void tell_timeline();
  // Plays the log up to a time. False: there are more messages up to that time than one turn may
  // process.
  bool catch_up(Console& console, std::int64_t until_us);

  const std::string log_;
  Console& console_;
  LogReader scanner_, player_;
  RecordedFrames frames_;
  Timeline timeline_;
  std::unique_ptr<Console> scanned_;   // the scanner's state
  std::unique_ptr<Console> ahead_;     // the state that a jump is rebuilding; null: no jump is
                                       // under way
  std::optional<BusMessage> waiting_;  // the player's next message
  bool is_scanned_ = false;
  double turned_s_ = -1.0;
  Playback playback_;
  Told told_;
};

}  // namespace ols::console
