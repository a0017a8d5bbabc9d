// A station's calibrations on disk: each in a folder by its id, the one in use by the link
// `current`, what happened in history.jsonl. Nothing is overwritten; going back is one rename.
//
//   FOLDER/current -> 4711            switched by one rename
//   FOLDER/instrument -> 4712         an instrument without a setup, accepted later; none: that of
//                                     the calibration in use
//   FOLDER/4711/                      instrument.toml, setup.toml, covariance.csv, reports; raw
//                                     observations, references, frames: all can be computed again
//   FOLDER/<UTC>-field.running/       a procedure at work
//   FOLDER/<UTC>-field.interrupted/   one that lost its power or was aborted: what it had is kept
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
  std::string id;         // of the calibration that the event is about
  std::string procedure;  // that made it
  std::string previous;   // that was in use before; empty: none
};

class CalibrationStore {
 public:
  // The folder is made if it is missing. Throws std::system_error.
  explicit CalibrationStore(std::filesystem::path folder);
  ~CalibrationStore();
  CalibrationStore(const CalibrationStore&) = delete;
  CalibrationStore& operator=(const CalibrationStore&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  // One procedure at a time. std::runtime_error if another one is at work. Folders of procedures
  // that have died are set aside; returns their new names. A decision that a loss of power has cut
  // short is carried out.
  std::vector<std::filesystem::path> lock();

  // A new folder of a procedure at work.
  std::filesystem::path begin(const std::string& procedure, std::int64_t utime_us);
  // Sets it aside with all it has; returns its new name.
  std::filesystem::path interrupt(const std::filesystem::path& running);
  // Folders that were set aside, the oldest first.
  std::vector<std::filesystem::path> interrupted() const;
  // One of them is at work again; returns its new name.
  std::filesystem::path resume(const std::filesystem::path& interrupted);
  // Gives it its id, when all of it is on the disk. std::runtime_error if that exists.
  std::filesystem::path keep(const std::filesystem::path& running, const std::string& id);

  std::optional<std::string> current() const;
  bool has(const std::string& id) const;
  // The calibration of this id is in use from now on. std::runtime_error without one.
  void use(const std::string& id, HistoryLine line);
  // The next setups begin with the instrument of this calibration; the one in use stays.
  void use_instrument(const std::string& id, HistoryLine line);
  // Of the instrument that was accepted last; nothing: there is none.
  std::optional<std::filesystem::path> instrument_file() const;
  void note(const HistoryLine& line);
  // Oldest first; lines that are damaged are left out.
  std::vector<HistoryLine> history() const;
  // That was in use when the current one was accepted.
  std::optional<std::string> previous() const;

 private:
  void link(const char* name, const std::string& id) const;
  void complete() const;
  void switch_to(const std::string& id) const;

  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace ols::calibration
