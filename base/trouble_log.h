// Logs the troubles of a program's inputs or outputs: each when it begins, and when it has ended.
// One that comes and goes is one trouble. Pure, but for the journal.
#pragma once

#include <map>
#include <string>

namespace ols {

class TroubleLog {
 public:
  // kind: "input", "output".
  explicit TroubleLog(std::string kind);

  // Call regularly; trouble: empty: none. `now_s`: monotonic.
  void look(const std::string& name, const std::string& trouble, double now_s);

  // A trouble's end, or another in its place, is logged when it has lasted so long.
  static constexpr double kSettled_s = 10.0;

 private:
  struct Known {
    std::string logged, seen;
    double since_s = 0.0;  // of `seen`
  };
  const std::string kind_;
  std::map<std::string, Known> known_;
};

}  // namespace ols
