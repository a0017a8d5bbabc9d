// A station's calibrations on disk. Each calibration has a folder named by its id. The link
// `current` points to the calibration in use. history.jsonl records the events. No calibration is
// ever overwritten; a single rename of the link returns to an earlier one.
//
//   FOLDER/current -> 4711            switched by one rename
//   FOLDER/instrument -> 4712         an instrument that was accepted without a setup; new setups
//                                     begin with it. Without this link, they begin with the
//                                     instrument of the calibration in use
//   FOLDER/4711/                      instrument.toml, setup.toml, covariance.csv, reports; raw
//                                     observations, references, frames, to repeat the computation
//   FOLDER/<UTC>-field.running/       a running procedure
//   FOLDER/<UTC>-field.interrupted/   a procedure that was aborted or lost power, with its data
//   FOLDER/history.jsonl
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ols::calibration {

struct HistoryLine {
  std::int64_t utime_us = 0;
  std::string event;      // "accepted", "instrument", "kept", "reverted"
  std::string id;         // the calibration's id
  std::string procedure;  // the procedure that made the calibration
  std::string previous;   // the calibration that was in use before; empty: none
};

class CalibrationStore {
 public:
  // Creates the folder if it is missing. Throws std::system_error.
  explicit CalibrationStore(std::filesystem::path folder);
  ~CalibrationStore();
  CalibrationStore(const CalibrationStore&) = delete;
  CalibrationStore& operator=(const CalibrationStore&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  // Allows only one procedure at a time. Throws std::runtime_error if another one is running. If
  // procedures have died, renames their folders to interrupted ones and returns the new names. If a
  // loss of power has interrupted a decision, completes it.
  std::vector<std::filesystem::path> lock();

  // Creates the folder of a running procedure.
  std::filesystem::path begin(const std::string& procedure, std::int64_t utime_us);
  // Renames the folder, with all its data, as interrupted; returns the new name.
  std::filesystem::path interrupt(const std::filesystem::path& running);
  // The folders of interrupted procedures, oldest first.
  std::vector<std::filesystem::path> interrupted() const;
  // Makes an interrupted procedure a running one again; returns the folder's new name.
  std::filesystem::path resume(const std::filesystem::path& interrupted);
  // Renames the folder to its calibration's id, after everything is on disk. Throws
  // std::runtime_error if the id exists.
  std::filesystem::path keep(const std::filesystem::path& running, const std::string& id);

  std::optional<std::string> current() const;
  bool has(const std::string& id) const;
  // Puts the calibration of this id into use. Throws std::runtime_error if there is none.
  void use(const std::string& id, HistoryLine line);
  // From now on, new setups begin with the instrument of this calibration. The calibration in use
  // does not change.
  void use_instrument(const std::string& id, HistoryLine line);
  // The file of the instrument that was accepted last; nullopt: there is none.
  std::optional<std::filesystem::path> instrument_file() const;
  void note(const HistoryLine& line);
  // The lines of the history, oldest first; damaged lines are left out.
  std::vector<HistoryLine> history() const;
  // The calibration that was in use before the current one was accepted.
  std::optional<std::string> previous() const;

 private:
  void link(const char* name, const std::string& id) const;
  void complete() const;
  void switch_to(const std::string& id) const;

  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace ols::calibration
