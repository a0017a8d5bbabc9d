#include "edge/recorder/event_store.h"

#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "edge/recorder/event_folder.h"

namespace ols {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPattern = "dddddddd?dddddd.ddd?_";  // d: a digit, ?: whatever stands there

// Whatever else lies in the folder is not ours to count or to remove.
bool is_event(const std::string& name) {
  const std::string pattern = kPattern;
  if (name.size() <= pattern.size() || name[8] != 'T' || name[19] != 'Z') return false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(name[i])) != 0;
    if (pattern[i] == 'd' ? !digit : pattern[i] != '?' && name[i] != pattern[i]) return false;
  }
  return true;
}

double size_of(const fs::path& event) {
  double bytes = 0.0;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(event, error)) {
    const auto size = file.file_size(error);
    if (!error) bytes += static_cast<double>(size);
  }
  return bytes;
}

}  // namespace

std::string utc_name(std::int64_t utime_us) {
  const std::int64_t ms = utime_us / 1000;
  const std::time_t seconds = ms / 1000;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char date[32], name[48];
  std::strftime(date, sizeof date, "%Y%m%dT%H%M%S", &utc);
  std::snprintf(name, sizeof name, "%s.%03dZ", date, static_cast<int>(ms % 1000));
  return name;
}

EventStore::EventStore(const std::string& folder, double quota_bytes, double reserve_bytes)
    : folder_(folder), quota_bytes_(quota_bytes), reserve_bytes_(reserve_bytes) {}

void EventStore::survey() {
  fs::create_directories(folder_);
  if (::access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw std::system_error(errno, std::generic_category(), folder_);
  }
  std::map<std::string, double> found;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    std::error_code ignored;
    const std::string name = entry.path().filename().string();
    if (is_event(name) && entry.is_directory(ignored)) found[name] = size_of(entry.path());
  }
  events_ = std::move(found);
  measure_room();
}

void EventStore::try_writing() {
  survey();
  if (full()) return;
  const std::string path = folder_ + "/.probe";
  errno = 0;
  std::ofstream probe(path);
  probe << std::string(4096, '.');
  probe.close();
  const int error = errno;
  ::unlink(path.c_str());
  if (!probe) throw std::system_error(error == 0 ? EIO : error, std::generic_category(), folder_);
}

void EventStore::measure_room() {
  struct statvfs disk {};
  if (::statvfs(folder_.c_str(), &disk) != 0) {
    throw std::system_error(errno, std::generic_category(), folder_);
  }
  free_bytes_ = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

std::string EventStore::free_name(std::int64_t utime_us, const std::string& label) const {
  const std::string name = utc_name(utime_us) + "_" + (label.empty() ? "event" : label);
  std::string candidate = name;
  for (int i = 2; events_.contains(candidate) || events_.contains(candidate + kPartial); ++i) {
    candidate = name + "_" + std::to_string(i);
  }
  return candidate;
}

void EventStore::make_room(double bytes, const std::set<std::string>& open) {
  while (this->bytes() + bytes > quota_bytes_) {
    if (!remove_oldest(open)) throw DiskFull("what is being recorded is greater than the quota");
  }
  measure_room();
  if (free_bytes_ - bytes < reserve_bytes_) throw DiskFull(full_text());
}

bool EventStore::remove_oldest(const std::set<std::string>& open) {
  for (auto event = events_.begin(); event != events_.end(); ++event) {
    const auto is_this = [&](const std::string& name) { return event->first == name + kPartial; };
    if (std::ranges::any_of(open, is_this)) continue;
    fs::remove_all(folder_ + "/" + event->first);
    events_.erase(event);
    ++removed_;
    return true;
  }
  return false;
}

void EventStore::finished(const std::string& name) {
  const auto partial = events_.extract(name + kPartial);
  if (!partial.empty()) events_[name] = partial.mapped();
}

std::string EventStore::full_text() const {
  char text[64];
  std::snprintf(text, sizeof text, "disk full (%.1f GB free)", free_bytes_ * 1e-9);
  return text;
}

double EventStore::bytes() const {
  double sum = 0.0;
  for (const auto& [name, bytes] : events_) sum += bytes;
  return sum;
}

}  // namespace ols
