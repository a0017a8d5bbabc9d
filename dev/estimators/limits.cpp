#include "dev/estimators/limits.h"

#include <cstdio>

namespace ols::bench {

void Limits::within(const std::string& what, double value, double least, double greatest) {
  const bool holds = value >= least && value <= greatest;  // not for NaN
  if (!holds) ++missed_;
  std::printf("  %-5s %s: %.4g", holds ? "holds" : "MISS", what.c_str(), value);
  if (least > -kNone) std::printf(", at least %.4g", least);
  if (greatest < kNone) std::printf(", at most %.4g", greatest);
  std::printf("\n");
}

}  // namespace ols::bench
