#include "central/admission/message_time.h"

#include <algorithm>
#include <vector>

namespace ols::fusion {
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
  // One jump of one clock must not make all others look silent.
  const double most_s = silence_s_ / 2.0;
  const double step_s = static_cast<double>(utime_us - station.newest_us) * 1e-6;
  station.progress_s += std::clamp(step_s, 0.0, most_s);
  elapsed_s_ = std::max(elapsed_s_, station.progress_s);
  station.heard_s = elapsed_s_;
  station.older = utime_us < station.newest_us - kStepBackUs ? station.older + 1 : 0;
  const bool stepped_back = station.older >= kStampsForStepBack;
  if (stepped_back) station.older = 0;
  if (stepped_back || utime_us > station.newest_us) station.newest_us = utime_us;
  if (is_new || stepped_back || ++heard_ > delivering_ / kMany) take_medians();
  return stepped_back;
}

bool MessageTime::delivers(const Station& station) const {
  return elapsed_s_ - station.heard_s <= silence_s_;
}

void MessageTime::take_medians() {
  heard_ = 0;
  std::vector<std::int64_t> all, trusted;
  for (const auto& [name, station] : stations_) {
    if (!delivers(station)) continue;
    all.push_back(station.newest_us);
    if (station.trusted) trusted.push_back(station.newest_us);
  }
  delivering_ = all.size();
  middle_us_ = all.empty() ? 0 : lower_median(all);
  now_us_ = trusted.empty() ? middle_us_ : lower_median(trusted);
}

void MessageTime::forget(const std::string& station) {
  stations_.erase(station);
  take_medians();
}

void MessageTime::trust(const std::string& station, bool trusted) {
  const auto found = stations_.find(station);
  if (found == stations_.end() || found->second.trusted == trusted) return;
  found->second.trusted = trusted;
  take_medians();
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

}  // namespace ols::fusion
