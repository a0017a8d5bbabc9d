#include "cue/text_time.h"

#include <cmath>
#include <cstdio>

namespace ols::cues {
namespace {

// Days since 1970 in the Gregorian calendar, by H. Hinnant's algorithm (days_from_civil): the year
// begins in March, so that the day of February comes last.
std::int64_t days_of(int year, int month, int day) {
  const std::int64_t shifted = month > 2 ? year : year - 1;
  const std::int64_t era = shifted / 400;
  const std::int64_t of_era = shifted - era * 400;
  const std::int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146'097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719'468;
}

}  // namespace

std::optional<std::int64_t> utime_of_iso(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, end = 0;
  double second = 0.0;
  const int found = std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%9lfZ%n", &year, &month, &day,
                                &hour, &minute, &second, &end);
  const bool is_whole = found == 6 && end > 0 && static_cast<std::size_t>(end) == text.size();
  const bool is_valid = is_whole && year >= 1970 && year <= 9999 && month >= 1 && month <= 12 &&
                        day >= 1 && day <= 31 && hour >= 0 && hour < 24 && minute >= 0 &&
                        minute < 60 && second >= 0.0 && second < 61.0;
  if (!is_valid) return std::nullopt;
  const std::int64_t minutes = (days_of(year, month, day) * 24 + hour) * 60 + minute;
  return minutes * 60'000'000 + std::llround(1e6 * second);
}

}  // namespace ols::cues
