#include "base/journal/journal_rate_limit.h"

namespace ols {

std::vector<JournalEvent> JournalRateLimit::pass(const std::vector<News>& news, double now_s) {
  std::vector<JournalEvent> lines;
  for (auto entry = told_.begin(); entry != told_.end();) {
    Told& told = entry->second;
    const bool is_over = now_s - told.since_s >= kWindow_s;
    if (is_over && !told.held) {
      entry = told_.erase(entry);
      continue;
    }
    if (is_over) {
      lines.push_back(told.held->event);
      if (told.left_out > 1) {
        lines.back().text += " (" + std::to_string(told.left_out - 1) + " more like it)";
      }
      told = {.since_s = now_s, .lines = 1, .held = std::nullopt, .left_out = 0};
    }
    ++entry;
  }
  for (const News& item : news) {
    const auto [entry, is_new] = told_.try_emplace(item.key);
    Told& told = entry->second;
    if (is_new) told.since_s = now_s;
    if (told.lines < kBurst) {
      ++told.lines;
      lines.push_back(item.event);
    } else {
      told.held = item;
      ++told.left_out;
    }
  }
  return lines;
}

}  // namespace ols
