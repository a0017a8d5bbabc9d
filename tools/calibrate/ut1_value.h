// UT1 - UTC as a person states it: the value of one day. The further from that day, the less
// accurate it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols::calibration {

struct Ut1Value {
  std::optional<double> minus_utc_s;
  std::string date;  // YYYY-MM-DD in UTC, the day of the value; empty: not stated
};

// Why `date` is not a valid day; empty if it is valid or empty.
std::string date_problem(const std::string& date);

// [days] Time between noon of the value's day and `utime_us`, always positive; 0 if the day is not
// stated. Throws std::invalid_argument if the day is not valid.
double age_days(const Ut1Value& value, std::int64_t utime_us);

// [s] 1-sigma of the value at a time. UT1 drifts from UTC by the excess length of day, which has
// stayed within about 1 ms a day since 2000 (IERS Bulletin A and B). At most 0.3 s, which is also
// the sigma if no value is stated.
double ut1_sd_s(const Ut1Value& value, std::int64_t utime_us);

// A remark on the value at that time, for a person; empty: none.
std::string ut1_remark(const Ut1Value& value, std::int64_t utime_us);

}  // namespace ols::calibration
