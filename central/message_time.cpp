#include "central/message_time.h"

#include <algorithm>
#include <vector>

namespace ols {
namespace {

constexpr std::int64_t kStepBackUs = 1'000'000;
constexpr int kStampsForStepBack = 3;

std::int64_t lower_median(std::vector<std::int64_t>& stamps) {
  const auto middle = stamps.begin() + static_cast<std::ptrdiff_t>((stamps.size() - 1) / 2);
  std::ranges::nth_element(stamps, middle);
  return *middle;
}

}  // namespace

bool MessageTime::hear(const std::string& name, std::int64_t utime_us) {
  const auto [position, is_new] = stations_.try_emplace(name);
  Station& station = position->second;
  if (is_new) {
    station.newest_us = utime_us;
    station.progress_s = elapsed_s_;
  }
  // One leap of one clock must not make all others look silent.
  const double most_s = silence_s_ / 2.0;
  const double step_s = static_cast<double>(utime_us - station.newest_us) * 1e-6;
  station.progress_s += std::clamp(step_s, 0.0, most_s);
  elapsed_s_ = std::max(elapsed_s_, station.progress_s);
  station.heard_s = elapsed_s_;
  station.older = utime_us < station.newest_us - kStepBackUs ? station.older + 1 : 0;
  const bool stepped_back = station.older >= kStampsForStepBack;
  if (stepped_back) station.older = 0;
  if (stepped_back || utime_us > station.newest_us) station.newest_us = utime_us;
  return stepped_back;
}

bool MessageTime::delivers(const Station& station) const {
  return elapsed_s_ - station.heard_s <= silence_s_;
}

std::int64_t MessageTime::now_us() const {
  std::vector<std::int64_t> stamps;
  for (const auto& [name, station] : stations_) {
    if (delivers(station) && station.trusted) stamps.push_back(station.newest_us);
  }
  return stamps.empty() ? middle_us() : lower_median(stamps);
}

std::int64_t MessageTime::middle_us() const {
  std::vector<std::int64_t> stamps;
  for (const auto& [name, station] : stations_) {
    if (delivers(station)) stamps.push_back(station.newest_us);
  }
  return stamps.empty() ? 0 : lower_median(stamps);
}

void MessageTime::trust(const std::string& station, bool trusted) {
  const auto found = stations_.find(station);
  if (found != stations_.end()) found->second.trusted = trusted;
}

std::vector<std::string> MessageTime::delivering() const {
  std::vector<std::string> names;
  for (const auto& [name, station] : stations_) {
    if (delivers(station)) names.push_back(name);
  }
  return names;
}

std::int64_t MessageTime::newest_us(const std::string& station) const {
  const auto found = stations_.find(station);
  return found == stations_.end() ? 0 : found->second.newest_us;
}

double MessageTime::silent_s(const std::string& station) const {
  const auto found = stations_.find(station);
  return found == stations_.end() ? 0.0 : elapsed_s_ - found->second.heard_s;
}

}  // namespace ols
