// Logs when a trouble of a program's input or output begins and ends. A trouble that comes and goes
// is logged as one trouble. Pure except for the journal.
#pragma once

#include <map>
#include <string>

namespace ols {

class TroubleLog {
 public:
  // kind: "input" or "output".
  explicit TroubleLog(std::string kind);

  // Call regularly. Empty `trouble`: the input or output works. `now_s`: monotonic.
  void look(const std::string& name, const std::string& trouble, double now_s);

  // The end of a trouble, or its change into another trouble, is logged only when the new state has
  // lasted this long.
  static constexpr double kSettled_s = 10.0;

 private:
  struct Known {
    std::string logged, seen;
    double since_s = 0.0;  // since when `seen` is the trouble
  };
  const std::string kind_;
  std::map<std::string, Known> known_;
};

}  // namespace ols
