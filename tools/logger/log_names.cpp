#include "tools/logger/log_names.h"

#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "conditions/printed.h"

namespace ols::logger {
namespace {

std::string time_text(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%dT%H%M%SZ", &utc);
  return text;
}

}  // namespace

LogNames::LogNames(std::string folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {}

// Numbers of removed files are not reused, so that names sort by age.
std::string LogNames::next(std::int64_t utime_us) {
  using std::filesystem::file_type;
  if (std::string now = time_text(utime_us); now != time_) {
    time_ = std::move(now);
    number_ = 0;
  }
  while (true) {
    const std::string end = printed(".lcmlog.%02d", number_++);
    const auto path = std::filesystem::path(folder_) / (name_ + "-" + time_ + end);
    std::error_code failure;
    const file_type there = std::filesystem::symlink_status(path, failure).type();
    if (there == file_type::not_found) return path.string();
    if (there == file_type::none) throw std::system_error(failure, path.string());
  }
}

}  // namespace ols::logger
