#include "edge/recorder/event_store.h"

#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "conditions/printed.h"
#include "edge/recorder/event_folder.h"

namespace ols::recorder {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoRoom =
    "no space: the quota is full of protected events; copy some away and delete them";
// The store's file: its modification time is that of the last removal, or of the store's creation.
constexpr const char* kRemoval = ".removal";
constexpr const char* kPattern = "dddddddd?dddddd.ddd?_";  // d: a digit, ?: any character

// Other files in the folder are neither counted nor removed.
bool is_event(const std::string& name) {
  const std::string pattern = kPattern;
  if (name.size() <= pattern.size() || name[8] != 'T' || name[19] != 'Z') return false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(name[i])) != 0;
    if (pattern[i] == 'd' ? !digit : pattern[i] != '?' && name[i] != pattern[i]) return false;
  }
  return true;
}

std::string label_of(const std::string& name) {
  std::string label = name.substr(std::string(kPattern).size());
  if (label.ends_with(kPartial)) label.resize(label.size() - std::string(kPartial).size());
  return label;
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
  char date[32];
  std::strftime(date, sizeof date, "%Y%m%dT%H%M%S", &utc);
  return printed("%s.%03dZ", date, static_cast<int>(ms % 1000));
}

void EventStore::survey() {
  fs::create_directories(config_.folder);
  if (::access(config_.folder.c_str(), W_OK | X_OK) != 0) {
    throw std::system_error(errno, std::generic_category(), config_.folder);
  }
  if (!fs::exists(config_.folder + "/" + kRemoval)) remember_removal();
  std::map<std::string, double> found;
  for (const auto& entry : fs::directory_iterator(config_.folder)) {
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
  const std::string path = config_.folder + "/.probe";
  errno = 0;
  std::ofstream probe(path);
  probe << std::string(4096, '.');
  probe.close();
  const int error = errno;
  ::unlink(path.c_str());
  if (!probe)
    throw std::system_error(error == 0 ? EIO : error, std::generic_category(), config_.folder);
}

void EventStore::measure_room() {
  struct statvfs disk {};
  if (::statvfs(config_.folder.c_str(), &disk) != 0) {
    throw std::system_error(errno, std::generic_category(), config_.folder);
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

void EventStore::make_room(double bytes, const Names& open, std::int64_t now_utime_us) {
  if (this->bytes() + bytes > config_.quota_bytes) {
    const auto event = removable(open, now_utime_us);
    // Nothing is removed if that would not suffice.
    if (this->bytes() + bytes - (event == events_.end() ? 0.0 : event->second) >
        config_.quota_bytes) {
      throw DiskFull(kNoRoom);
    }
    remember_removal();  // first: without this record nothing may be removed
    fs::remove_all(config_.folder + "/" + event->first);
    events_.erase(event);
    ++removed_;
  }
  measure_room();
  if (free_bytes_ - bytes < config_.reserve_bytes) throw DiskFull(full_text());
}

double EventStore::room_bytes(const Names& open, std::int64_t now_utime_us) const {
  const auto event = removable(open, now_utime_us);
  const double gained = event == events_.end() ? 0.0 : event->second;
  return std::max(0.0, config_.quota_bytes - bytes() + gained);
}

void EventStore::remember_removal() const {
  std::ofstream file(config_.folder + "/" + kRemoval);
  file << "when an event was last removed to free space\n";
  file.close();
  if (!file) throw std::system_error(EIO, std::generic_category(), config_.folder);
}

EventStore::Events::const_iterator EventStore::removable(const Names& open,
                                                         std::int64_t now_utime_us) const {
  const std::int64_t before_utime_us = now_utime_us - std::llround(config_.protect_s * 1e6);
  struct stat last {};
  if (::stat((config_.folder + "/" + kRemoval).c_str(), &last) != 0) return events_.end();
  if (last.st_mtim.tv_sec * 1'000'000LL + last.st_mtim.tv_nsec / 1000 > before_utime_us) {
    return events_.end();
  }
  std::map<std::string, double> labels;
  for (const auto& [name, bytes] : events_) labels[label_of(name)] += bytes;
  const std::string protected_from = utc_name(before_utime_us);
  auto found = events_.end();
  for (auto event = events_.begin(); event != events_.end(); ++event) {  // the oldest first
    if (event->first >= protected_from) break;
    const auto is_this = [&](const std::string& name) { return event->first == name + kPartial; };
    if (std::ranges::any_of(open, is_this)) continue;
    const double taken = labels[label_of(event->first)];
    if (found == events_.end() || taken > labels[label_of(found->first)]) found = event;
  }
  return found;
}

void EventStore::finished(const std::string& name) {
  const auto partial = events_.extract(name + kPartial);
  if (!partial.empty()) events_[name] = partial.mapped();
}

std::string EventStore::full_text() const {
  return printed("disk full (%.1f GB free)", free_bytes_ * 1e-9);
}

double EventStore::bytes() const {
  double sum = 0.0;
  for (const auto& [name, bytes] : events_) sum += bytes;
  return sum;
}

}  // namespace ols::recorder
