#include "central/app/other_fusions.h"

#include <utility>

namespace ols {
namespace {

constexpr double kSilent_s = 5.0;  // some statuses may get lost

}  // namespace

bool OtherFusions::hear(std::int64_t boot_id, double now_s) {
  if (boot_id == own_boot_id_) return false;
  news_ = news_ || now_s - heard_s_ > kSilent_s;
  heard_s_ = now_s;
  return true;
}

std::string OtherFusions::alarm(double now_s) const {
  if (now_s - heard_s_ > kSilent_s) return {};
  return "another fusion is on the bus: end one of them";
}

bool OtherFusions::take_news() { return std::exchange(news_, false); }

}  // namespace ols
