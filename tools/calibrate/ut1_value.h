// UT1 - UTC as a person states it: a value of one day, which ages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols::calibration {

struct Ut1Value {
  std::optional<double> minus_utc_s;
  std::string date;  // YYYY-MM-DD in UTC, the day that the value is of; empty: not stated
};

// Why this is no day; empty if it is one, or is not stated.
std::string date_problem(const std::string& date);

// [days] between the value's day (its noon) and a time, either way; 0 if the day is not stated.
// std::invalid_argument if it is no day.
double age_days(const Ut1Value& value, std::int64_t utime_us);

// [s] The standard deviation of the value at a time: UT1 runs away from UTC by the excess length
// of day, which has stayed within some 1 ms a day since 2000 (IERS Bulletin A and B). Never more
// than the 0.3 s of no value at all.
double ut1_sd_s(const Ut1Value& value, std::int64_t utime_us);

// What a person should know of the value at that time; empty if nothing.
std::string ut1_remark(const Ut1Value& value, std::int64_t utime_us);

}  // namespace ols::calibration
