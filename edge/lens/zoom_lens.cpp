#include "edge/lens/zoom_lens.h"

#include <algorithm>
#include <cmath>

namespace ols::lens {

void ZoomLens::add(const ZoomSample& sample) {
  if (!samples_.empty() && sample.time_s <= samples_.back().time_s) return;
  samples_.push_back(sample);
  while (samples_.back().time_s - samples_.front().time_s > kMemory_s) samples_.pop_front();
}

std::optional<ZoomPoint> ZoomLens::newest() const {
  if (samples_.empty()) return std::nullopt;
  return at(samples_.back().time_s);
}

std::optional<ZoomPoint> ZoomLens::at(double time_s) const {
  if (samples_.empty() || time_s < samples_.front().time_s - kSilent_s ||
      time_s > samples_.back().time_s + kSilent_s) {
    return std::nullopt;
  }
  const auto after = std::ranges::find_if(
      samples_, [time_s](const ZoomSample& sample) { return sample.time_s >= time_s; });
  const bool outside = after == samples_.begin() || after == samples_.end();
  const ZoomSample& to = after == samples_.end() ? samples_.back() : *after;
  const auto here = after == samples_.end() ? samples_.end() - 1 : after;
  const ZoomSample& from = here == samples_.begin() ? *here : *(here - 1);
  const double span_s = to.time_s - from.time_s;
  const double rate = span_s > 0.0 ? (to.position - from.position) / span_s : 0.0;
  const double share = outside || span_s <= 0.0 ? 1.0 : (time_s - from.time_s) / span_s;
  const double position = from.position + share * (to.position - from.position);
  const double away_s = outside ? std::abs(time_s - to.time_s) : 0.0;
  return table_.at(position, std::hypot(position_sd_, rate * std::hypot(to.time_sd_s, away_s)));
}

std::optional<bool> ZoomLens::rests_at(double time_s) const {
  const auto after = std::ranges::find_if(
      samples_, [time_s](const ZoomSample& sample) { return sample.time_s >= time_s; });
  if (after == samples_.begin() || after == samples_.end()) return std::nullopt;
  const ZoomSample& before = *(after - 1);
  if (after->time_s - before.time_s > kSilent_s) return std::nullopt;
  return std::abs(after->position - before.position) <= position_sd_;
}

}  // namespace ols::lens
