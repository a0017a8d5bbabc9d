// The results that were reported to a procedure, in order. An interrupted procedure is resumed from
// them.
// Pure.
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
  std::int64_t pose = 0;              // kTaken: number of the picture
  std::string why;                    // kNotTaken
  Answer answer;                      // kAnswered
  std::int64_t ordered_utime_us = 0;  // when the order was given; 0: unknown
};

// A line of JSON, without a line end.
std::string journal_line(const JournalEntry& entry);
// All lines of a file's text. An unended last line is due to a loss of power, and is left out.
// Throws std::runtime_error naming `path` and line.
std::vector<JournalEntry> journal_entries(const std::string& text, const std::string& path);

// Whether the entry is the result of this order; numbers in its words are ignored.
bool answers(const JournalEntry& entry, const Order& order);

}  // namespace ols::calibration
