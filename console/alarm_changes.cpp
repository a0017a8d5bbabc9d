#include "console/alarm_changes.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace ols::console {
namespace {

std::string without_numbers(std::string text) {
  std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
  return text;
}

std::vector<std::string> only_in(const std::vector<std::string>& these,
                                 const std::vector<std::string>& those) {
  std::set<std::string> keys;
  for (const std::string& other : those) keys.insert(without_numbers(other));
  std::vector<std::string> result;
  std::ranges::copy_if(these, std::back_inserter(result), [&](const std::string& one) {
    return !keys.contains(without_numbers(one));
  });
  return result;
}

}  // namespace

AlarmChanges alarm_changes(const std::vector<std::string>& before,
                           const std::vector<std::string>& now) {
  return {only_in(now, before), only_in(before, now)};
}

}  // namespace ols::console
