// The results that were reported to a procedure, in order. With them, an interrupted procedure can
// be resumed. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

struct JournalEntry {
  enum class Kind { kTaken, kNotTaken, kAnswered, kResumed };
  Kind kind = Kind::kTaken;
  std::string step;                   // the step of the order
  std::int64_t pose = 0;              // kTaken: the picture's number
  std::string why;                    // kNotTaken
  Answer answer;                      // kAnswered
  std::int64_t ordered_utime_us = 0;  // when the order was given; 0: unknown
};

// The entry as one line of JSON, without a line end.
std::string journal_line(const JournalEntry& entry);
// Reads all lines of a file's text. A last line without a line end is due to a loss of power; it is
// left out. Throws std::runtime_error naming `path` and line.
std::vector<JournalEntry> journal_entries(const std::string& text, const std::string& path);

// Whether the entry is the result of this order. Compares the texts of both steps up to the first
// ';', after which there are only figures.
bool answers(const JournalEntry& entry, const Order& order);

}  // namespace ols::calibration
