// Reports the progress of long work: a line on standard error every few seconds.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

namespace ols {

// Receives the number of steps done and the total number; `all` is 0 if the total is unknown.
using TellSteps = std::function<void(std::size_t done, std::size_t all)>;

// Can be used as a TellSteps.
class Progress {
 public:
  // Prints "program: 120 of 900 frames after 10 s". Here `steps` is "frames".
  Progress(std::string program, std::string steps);
  // For tests: the output stream and the clock.
  Progress(std::string program, std::string steps, std::ostream& out,
           std::function<double()> now_s);

  // Call often; prints only every few seconds.
  void operator()(std::size_t done, std::size_t all);

 private:
  std::string program_;
  std::string steps_;
  std::ostream& out_;
  std::function<double()> now_s_;
  double start_s_;
  double next_s_;
};

}  // namespace ols
