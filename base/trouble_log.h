// Logs the troubles of a program's inputs or outputs: each when it begins, and when it has ended.
#pragma once

#include <map>
#include <string>

namespace ols {

class TroubleLog {
 public:
  // kind: "input", "output".
  explicit TroubleLog(std::string kind);

  // Call regularly; trouble: empty: none.
  void look(const std::string& name, const std::string& trouble);

 private:
  const std::string kind_;
  std::map<std::string, std::string> last_;
};

}  // namespace ols
