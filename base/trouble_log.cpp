#include "base/trouble_log.h"

#include <utility>

#include "base/journal.h"

namespace ols {

TroubleLog::TroubleLog(std::string kind) : kind_(std::move(kind)) {}

void TroubleLog::look(const std::string& name, const std::string& trouble) {
  std::string& last = last_[name];
  if (trouble == last) return;
  if (trouble.empty()) {
    write_to_journal(
        {.text = kind_ + " " + name + ": works again", .id = event::kLineWorks, .device = name});
  } else {
    write_to_journal({.text = kind_ + " " + name + ": " + trouble,
                      .bad = true,
                      .id = event::kLineFails,
                      .device = name,
                      .reason = trouble});
  }
  last = trouble;
}

}  // namespace ols
