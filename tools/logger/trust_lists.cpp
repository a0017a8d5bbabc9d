#include "tools/logger/trust_lists.h"

#include <algorithm>
#include <utility>

namespace ols::logger {

std::int64_t TrustLists::newest() const {
  const std::lock_guard lock(mutex_);
  return lists_.empty() ? 0 : lists_.back().number;
}

void TrustLists::add(ReceivedList list) {
  const std::lock_guard lock(mutex_);
  if (lists_.empty() || list.number > lists_.back().number) lists_.push_back(std::move(list));
}

std::vector<ReceivedList> TrustLists::due(std::int64_t judged_by, std::int64_t written) {
  const std::lock_guard lock(mutex_);
  const auto later = std::ranges::find_if(
      lists_, [judged_by](const ReceivedList& list) { return list.number > judged_by; });
  if (later == lists_.begin()) return {};
  const auto last = later - 1;
  auto first = written == 0 ? last : lists_.begin();
  while (first != later && first->number <= written) ++first;
  const std::vector<ReceivedList> due(first, later);
  lists_.erase(lists_.begin(), last);  // the last one begins the next file
  return due;
}

}  // namespace ols::logger
