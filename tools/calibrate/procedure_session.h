// A procedure's data on disk while it runs: every picture with its counts, the observations, and
// the results reported to it. All of it is written immediately: a loss of power costs at most one
// picture, and the procedure can be resumed.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/calibrate/procedure_journal.h"
#include "tools/calibrate/station_link.h"
#include "tools/calibrate/stored_pictures.h"

namespace ols::calibration {

class ProcedureSession {
 public:
  // `folder` must exist. `station`: the station's id.
  ProcedureSession(std::filesystem::path folder, std::string station)
      : folder_(std::move(folder)), station_(std::move(station)) {}

  // Loads the folder, in order to replay the results stored there. Throws std::runtime_error naming
  // file and line.
  void resume();
  bool is_replaying() const { return !replay_.empty(); }
  // Returns true, once, if the next recorded event is a resumption.
  bool take_resumed();
  // The time [us] of the order whose result is replayed next. nullopt: there is no such order, or
  // the journal states no time.
  std::optional<std::int64_t> replayed_utime_us() const;
  // The recorded result of this order; call only while replaying. Throws std::runtime_error if the
  // journal belongs to another procedure.
  JournalEntry replayed(const Order& order);
  Taken stored(std::int64_t pose) const;
  void note(const JournalEntry& entry) const;
  // Writes a file of this name into the folder.
  void write(const std::string& name, const std::string& text) const;

  const std::filesystem::path& folder() const { return folder_; }
  // Gives the picture a number and stores it; returns it with the number. `is_view`: as in Shot.
  Taken add(FrameFile frame, bool is_view);
  void write_observations(const std::vector<Observation>& observations) const;
  std::filesystem::path observations_path() const { return folder_ / "observations.jsonl"; }
  // A new folder for the files of an adjustment.
  std::filesystem::path next_result();
  // Copies the last adjustment's results into the folder itself.
  void take_result() const;

 private:
  void read_frames();

  std::filesystem::path folder_;
  std::string station_;
  std::int64_t poses_ = 0;
  int results_ = 0;
  std::deque<JournalEntry> replay_;
  // By the picture's number; only pictures from before the interruption.
  std::map<std::int64_t, StoredPicture> frames_;
};

}  // namespace ols::calibration
