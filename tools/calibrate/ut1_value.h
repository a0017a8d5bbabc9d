// UT1 - UTC as a person states it: the value of one day, whose accuracy decays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols::calibration {

struct Ut1Value {
  std::optional<double> minus_utc_s;
  std::string date;  // YYYY-MM-DD in UTC, the day of the value; empty: not stated
};

// Why this is no valid day; empty if it is one, or is not stated.
std::string date_problem(const std::string& date);

// [days] Time between the value's day (its noon) and `utime_us`, either way; 0 if the day is not
// stated. Throws std::invalid_argument if it is no day.
double age_days(const Ut1Value& value, std::int64_t utime_us);

// [s] 1-sigma of the value at a time. UT1 drifts from UTC by the excess length of day, which has
// stayed within about 1 ms a day since 2000 (IERS Bulletin A and B). At most 0.3 s, as without any
// value.
double ut1_sd_s(const Ut1Value& value, std::int64_t utime_us);

// A remark on the value at that time, for a person; empty: none.
std::string ut1_remark(const Ut1Value& value, std::int64_t utime_us);

}  // namespace ols::calibration
