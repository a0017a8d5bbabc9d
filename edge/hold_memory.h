// Remembers over a restart, or a loss of power, that somebody has taken the PTU's leave to move.
#pragma once

#include <string>

#include "edge/station_types.h"

namespace ols {

enum class Hold { kNone, kStopped, kEmergency };

// A station that an operator has in hand begins again stopped.
Hold hold_of(StationState state);

class HoldMemory {
 public:
  // `file` is there as long as there is a hold; empty: nothing is remembered.
  explicit HoldMemory(std::string file);

  // What there was when this was made, or is now. A file that cannot be read, or says something
  // else, is an emergency: who cannot know whether he was stopped is stopped.
  Hold hold() const { return hold_; }
  // Writes only when it changes.
  void set(Hold hold);

  // Why the file cannot be read or written; empty when all is well.
  const std::string& trouble() const { return trouble_; }

 private:
  void read();
  void write() const;

  std::string file_;
  Hold hold_ = Hold::kNone;
  std::string trouble_;
};

}  // namespace ols
