#include "tools/offline/timing_csv.h"

#include <ctime>

namespace ols::offline {

double thread_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TimingFile::TimingFile(const std::string& path, tracker::Tracker& tracker) : file_(path) {
  tracker.set_stage_clock(thread_time_s);
  file_.stream() << "frame,total_ms";
  for (const char* name : tracker::kStageNames) file_.stream() << ',' << name << "_ms";
  file_.stream() << '\n';
}

void TimingFile::write(long frame, double total_s, const tracker::StageTimes& stages) {
  file_.stream() << frame << ',' << 1e3 * total_s;
  for (const double seconds : stages.seconds) file_.stream() << ',' << 1e3 * seconds;
  file_.stream() << '\n';
}

}  // namespace ols::offline
