#include "base/trouble_log.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace ols {

TroubleLog::TroubleLog(std::string kind) : kind_(std::move(kind)) {}

void TroubleLog::look(const std::string& name, const std::string& trouble) {
  std::string& last = last_[name];
  if (trouble == last) return;
  if (trouble.empty()) {
    spdlog::info("{} {}: works again", kind_, name);
  } else {
    spdlog::warn("{} {}: {}", kind_, name, trouble);
  }
  last = trouble;
}

}  // namespace ols
