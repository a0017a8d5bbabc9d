#include "export/readiness.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "base/files/small_file.h"
#include "land/geoid.h"

namespace ols::exports {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;

}  // namespace

std::vector<Format> formats_of(const ExportConfig& config) {
  std::vector<Format> formats;
  for (const OutputConfig& output : config.outputs) formats.push_back(output.format);
  return formats;
}

SiteContext site_context(const ExportConfig& config, const std::vector<Format>& formats) {
  SiteContext site{config.site};
  try {
    const auto geoid = std::make_shared<const land::Geoid>(config.geoid);
    site.geoid_m = [geoid](double latitude_deg, double longitude_deg) {
      return geoid->height_m(latitude_deg, longitude_deg);
    };
  } catch (const std::invalid_argument& missing) {
    const auto needy = std::ranges::find_if(formats, needs_geoid);
    if (needy == formats.end()) return site;
    throw std::invalid_argument(std::string("heights of ") + to_string(*needy) +
                                " are above sea level: geoid " + missing.what());
  }
  return site;
}

void check_files(const ExportConfig& config) {
  for (const OutputConfig& output : config.outputs) {
    for (const std::string& file :
         {output.ca, output.certificate, output.key, output.password_file}) {
      try {
        if (!file.empty()) static_cast<void>(read_small_file(file, kLargestFile));
      } catch (const std::exception& failure) {
        throw std::invalid_argument("output " + output.name + ": " + failure.what());
      }
    }
  }
}

}  // namespace ols::exports
