#include "export/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/bus/message_code.h"
#include "conditions/printed.h"

namespace ols::exports {
namespace {

constexpr std::int64_t kDay_us = 86'400'000'000;

struct Date {
  int year, month, day;
};

// Days since 1970 in the Gregorian calendar, by H. Hinnant's algorithm (civil_from_days): the year
// begins in March, so that the day of February comes last.
Date date_of(std::int64_t days) {
  days += 719'468;
  const std::int64_t era = days / 146'097;
  const std::int64_t of_era = days - era * 146'097;
  const std::int64_t year = (of_era - of_era / 1460 + of_era / 36'524 - of_era / 146'096) / 365;
  const std::int64_t of_year = of_era - (365 * year + year / 4 - year / 100);
  const std::int64_t month = (5 * of_year + 2) / 153;
  const auto day = static_cast<int>(of_year - (153 * month + 2) / 5 + 1);
  const auto calendar_month = static_cast<int>(month < 10 ? month + 3 : month - 9);
  return {static_cast<int>(year + era * 400 + (calendar_month <= 2 ? 1 : 0)), calendar_month, day};
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return {};
  char text[352];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr;
  return {text, end};
}

std::string iso_time(std::int64_t utime_us) {
  constexpr std::int64_t kLast_us = 253'402'300'799'999'999;  // of the year 9999
  utime_us = std::clamp<std::int64_t>(utime_us, 0, kLast_us);
  const Date date = date_of(utime_us / kDay_us);
  const auto of_day_ms = static_cast<int>(utime_us % kDay_us / 1000);
  return printed("%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", date.year, date.month, date.day,
                 of_day_ms / 3'600'000, of_day_ms / 60'000 % 60, of_day_ms / 1000 % 60,
                 of_day_ms % 1000);
}

std::string xml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return escaped;
}

const char* to_string(TrackState state) {
  return word_of_code(code(state), std::array{"tentative", "confirmed", "coasted", "ended"});
}

const char* standard_class(ObjectClass object_class) {
  return word_of_code(code(object_class),
                      std::array{"Unknown", "UAV", "Bird", "Aircraft", "Other"});
}

std::string callsign(const Target& target) { return "OLS " + std::to_string(target.id); }

}  // namespace ols::exports
