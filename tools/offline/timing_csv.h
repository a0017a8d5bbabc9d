// Writes timing.csv, with the columns frame, total_ms and the milliseconds of each stage.
#pragma once

#include <string>

#include "base/files/atomic_file.h"
#include "edge/tracker/tracker.h"

namespace ols::offline {

// The processor time of this thread [s]. Other programs do not affect it.
double thread_time_s();

class TimingFile {
 public:
  // Gives `tracker` a clock for its stages. Throws if the file cannot be written.
  TimingFile(const std::string& path, tracker::Tracker& tracker);

  void write(long frame, double total_s, const tracker::StageTimes& stages);
  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
};

}  // namespace ols::offline
