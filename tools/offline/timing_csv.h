// timing.csv: frame, total_ms and the milliseconds of each stage.
#pragma once

#include <string>

#include "base/files/atomic_file.h"
#include "edge/tracker/tracker.h"

namespace ols::offline {

// Processor time of this thread [s], unaffected by other programs.
double thread_time_s();

class TimingFile {
 public:
  // Gives the tracker a clock. Throws if the file cannot be written.
  TimingFile(const std::string& path, tracker::Tracker& tracker);

  void write(long frame, double total_s, const tracker::StageTimes& stages);
  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
};

}  // namespace ols::offline
