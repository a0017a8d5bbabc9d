#include "base/journal/trouble_log.h"

#include <utility>

#include "base/journal/journal.h"

namespace ols {

TroubleLog::TroubleLog(std::string kind) : kind_(std::move(kind)) {}

void TroubleLog::look(const std::string& name, const std::string& trouble, double now_s) {
  Known& known = known_[name];
  if (trouble != known.seen) {
    known.seen = trouble;
    known.since_s = now_s;
  }
  if (trouble == known.logged) return;
  if (!known.logged.empty() && now_s - known.since_s < kSettled_s) return;
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
  known.logged = trouble;
}

}  // namespace ols
