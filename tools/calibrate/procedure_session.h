// What a procedure leaves on disk while it works: every picture with its counts, the observations,
// and what was reported to it. Written as it comes, so that a loss of power costs one picture at
// most, and the procedure can be gone on with.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/calibrate/procedure_journal.h"
#include "tools/calibrate/station_link.h"

namespace ols::calibration {

class ProcedureSession {
 public:
  // `folder` exists; `station`: its id.
  ProcedureSession(std::filesystem::path folder, std::string station)
      : folder_(std::move(folder)), station_(std::move(station)) {}

  // Takes up what the folder holds: what was reported is replayed. std::runtime_error naming file
  // and line.
  void resume();
  bool is_replaying() const { return !replay_.empty(); }
  // The next thing that happened was that it was gone on with; takes it.
  bool take_resumed();
  // [us] When the order was given then whose outcome is replayed next; nothing: none is, or the
  // journal does not say.
  std::optional<std::int64_t> replayed_utime_us() const;
  // What came of this order then; only while replaying. std::runtime_error where the journal is of
  // another procedure.
  JournalEntry replayed(const Order& order);
  Taken stored(std::int64_t pose) const;
  void note(const JournalEntry& entry) const;
  // A file of this name in the folder.
  void write(const std::string& name, const std::string& text) const;

  const std::filesystem::path& folder() const { return folder_; }
  // Numbers the picture and stores it; returns it with its number. `is_view`: as in Shot.
  Taken add(FrameFile frame, bool is_view);
  void write_observations(const std::vector<Observation>& observations) const;
  std::filesystem::path observations_path() const { return folder_ / "observations.jsonl"; }
  // Of an adjustment: a new one each time.
  std::filesystem::path next_result();
  // Everything of the last adjustment into the folder itself.
  void take_result() const;

 private:
  void read_frames();

  std::filesystem::path folder_;
  std::string station_;
  std::int64_t poses_ = 0;
  int results_ = 0;
  std::deque<JournalEntry> replay_;
  struct Frame {
    std::filesystem::path file;
    Taken taken;  // without its picture
  };
  std::map<std::int64_t, Frame> frames_;  // by pose, of before
};

}  // namespace ols::calibration
