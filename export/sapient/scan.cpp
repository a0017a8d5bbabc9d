#include "export/sapient/scan.h"

namespace ols::exports {
namespace {

// A target that is older than the scan by more than this shows that the scan's instant was wrong.
constexpr double kBack_s = 1.0;

}  // namespace

// In floating point: the difference from an absurd stamp must not overflow.
bool Scan::begins_at(std::int64_t utime_us) const {
  if (!instant_us_) return true;
  const double after_s = 1e-6 * (static_cast<double>(utime_us) - static_cast<double>(*instant_us_));
  return after_s >= kGap_s || after_s < -kBack_s;
}

std::optional<std::int64_t> Scan::instant_of(const Target& target) {
  if (begins_at(target.utime_us)) {
    instant_us_ = target.utime_us;
    told_.clear();
  }
  const auto [told, is_new] = told_.try_emplace(target.uid, target.state);
  if (!is_new && told->second == target.state) return std::nullopt;
  told->second = target.state;
  return instant_us_;
}

}  // namespace ols::exports
