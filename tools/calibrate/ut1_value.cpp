#include "tools/calibrate/ut1_value.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace ols::calibration {
namespace {

constexpr double kUnstated_s = 0.3;          // most that UT1 has been off UTC for years
constexpr double kStated_s = 1e-3;           // as it is printed, and within its day
constexpr double kLengthOfDay_s_day = 1e-3;  // excess length of day
constexpr double kOld_days = 30.0;           // from here on its age costs more than 0.4 arc seconds

std::optional<std::chrono::sys_days> day_of(const std::string& date) {
  std::istringstream text(date);
  std::tm read{};
  if (!(text >> std::get_time(&read, "%Y-%m-%d")) || text.peek() != EOF) return std::nullopt;
  const std::chrono::year_month_day day{std::chrono::year(read.tm_year + 1900),
                                        std::chrono::month(static_cast<unsigned>(read.tm_mon + 1)),
                                        std::chrono::day(static_cast<unsigned>(read.tm_mday))};
  return day.ok() ? std::optional(std::chrono::sys_days(day)) : std::nullopt;
}

}  // namespace

std::string date_problem(const std::string& date) {
  if (date.empty() || day_of(date)) return {};
  return "'" + date + "' is no day: it is written YYYY-MM-DD";
}

double age_days(const Ut1Value& value, std::int64_t utime_us) {
  if (value.date.empty()) return 0.0;
  const auto day = day_of(value.date);
  if (!day) throw std::invalid_argument(date_problem(value.date));
  const auto noon = *day + std::chrono::hours(12);
  const std::chrono::sys_time<std::chrono::microseconds> at{std::chrono::microseconds(utime_us)};
  return std::abs(std::chrono::duration<double, std::ratio<86400>>(at - noon).count());
}

double ut1_sd_s(const Ut1Value& value, std::int64_t utime_us) {
  if (!value.minus_utc_s) return kUnstated_s;
  return std::min(kUnstated_s,
                  std::hypot(kStated_s, kLengthOfDay_s_day * age_days(value, utime_us)));
}

std::string ut1_remark(const Ut1Value& value, std::int64_t utime_us) {
  if (!value.minus_utc_s) {
    return "UT1 - UTC is not stated (--ut1-utc): taken as 0 with a deviation of 0.3 s, 4.5 arc "
           "seconds of heading";
  }
  if (value.date.empty()) {
    return "the day of UT1 - UTC is not stated (--ut1-date): it is taken as of the day";
  }
  const double age = age_days(value, utime_us);
  if (age <= kOld_days) return {};
  constexpr double kArcsecPerSecond = 15.0;
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << "UT1 - UTC is old: its day, " << value.date
       << ", is " << age << " days from the observations', which adds " << std::setprecision(1)
       << ut1_sd_s(value, utime_us) * kArcsecPerSecond << " arc seconds of heading";
  return text.str();
}

}  // namespace ols::calibration
