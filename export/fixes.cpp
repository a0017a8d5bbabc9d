#include "export/fixes.h"

#include <cmath>
#include <cstdint>

#include "base/files/csv_rows.h"
#include "export/identity.h"

namespace ols::exports {
namespace {

constexpr std::int64_t kGreatestUtime = 9'000'000'000'000'000;

constexpr csv::Header<8> kFixes{{"utime_us", "target", "latitude_deg", "longitude_deg", "height_m",
                                 "east_sd_m", "north_sd_m", "up_sd_m"},
                                5};

Target target_of(const csv::Row<8>& row, const SiteContext& site) {
  Target target;
  target.utime_us = row.number<std::int64_t>(0, 0, kGreatestUtime);
  const std::string name = row.text(1);
  const char* const end = name.data() + name.size();
  // A name that is no number gives no id; the whole name identifies the target.
  if (std::from_chars(name.data(), end, target.id).ptr != end) target.id = 0;
  target.uid = site.site + ".target." + name;
  target.place.latitude_deg = row.number<double>(2, -90.0, 90.0);
  // From -180 to 180, as the fusion and areas have it.
  target.place.longitude_deg = std::remainder(row.number<double>(3, -180.0, 360.0), 360.0);
  target.place.height_m = row.number<double>(4, -1e5, 1e6);
  target.place.geoid_m = site.geoid_m(target.place.latitude_deg, target.place.longitude_deg);
  target.covariance_m2.fill(kUnknown);
  const std::array<std::size_t, 3> diagonal{0, 3, 5};
  if (row.has(5) && row.has(6) && row.has(7)) {
    target.covariance_m2.fill(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      const double sd_m = row.number<double>(5 + i, 0.0, 1e6);
      target.covariance_m2[diagonal[i]] = sd_m * sd_m;
    }
  }
  target.velocity_enu_m_s.fill(kUnknown);
  target.velocity_covariance_m2_s2.fill(kUnknown);
  return target;
}

}  // namespace

std::vector<Target> read_fixes(const std::string& path, const SiteContext& site) {
  std::vector<Target> targets;
  csv::for_each_row<8>(path, kFixes,
                       [&](const auto& row) { targets.push_back(target_of(row, site)); });
  return targets;
}

}  // namespace ols::exports
