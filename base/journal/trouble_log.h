// Logs the beginning and end of each trouble of a program's inputs or outputs. A trouble that comes
// and goes counts as one. Pure except for the journal.
#pragma once

#include <map>
#include <string>

namespace ols {

class TroubleLog {
 public:
  // kind: "input" or "output".
  explicit TroubleLog(std::string kind);

  // Call regularly. `trouble` empty: none. `now_s`: monotonic.
  void look(const std::string& name, const std::string& trouble, double now_s);

  // The end of a trouble, or a change to another one, is logged only after this time.
  static constexpr double kSettled_s = 10.0;

 private:
  struct Known {
    std::string logged, seen;
    double since_s = 0.0;  // since when `seen` holds
  };
  const std::string kind_;
  std::map<std::string, Known> known_;
};

}  // namespace ols
