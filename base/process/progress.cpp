#include "base/process/progress.h"

#include <cmath>
#include <iostream>
#include <utility>

#include "base/process/clocks.h"

namespace ols {
namespace {

constexpr double kInterval_s = 5.0;

}  // namespace

Progress::Progress(std::string program, std::string steps)
    : Progress(std::move(program), std::move(steps), std::cerr, clock_monotonic_s) {}

Progress::Progress(std::string program, std::string steps, std::ostream& out,
                   std::function<double()> now_s)
    : program_(std::move(program)),
      steps_(std::move(steps)),
      out_(out),
      now_s_(std::move(now_s)),
      start_s_(now_s_()),
      next_s_(start_s_ + kInterval_s) {}

void Progress::operator()(std::size_t done, std::size_t all) {
  const double now_s = now_s_();
  if (now_s < next_s_) return;
  next_s_ = now_s + kInterval_s;
  out_ << program_ << ": " << done << ' ';
  if (all > 0) out_ << "of " << all << ' ';
  out_ << steps_ << " after " << std::lround(now_s - start_s_) << " s" << std::endl;
}

}  // namespace ols
