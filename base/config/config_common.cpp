#include "base/config/config_common.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

#include "base/bus/lcm_url.h"

namespace ols::config {

Row bus_url(std::string& field) {
  return text("lcm_url", field,
              "The bus; ttl=0: only this host, ttl=1: also the other hosts of the site.",
              [](const std::string& url) { parse_lcm_url(url); });
}

Row status_file(std::string& field) {
  return text("status_file", field, "JSON file that is rewritten every second; empty: none.");
}

Check word_up_to(std::size_t longest) {
  return [longest](const std::string& word) {
    const bool is_good =
        !word.empty() && word.size() <= longest && std::ranges::all_of(word, [](unsigned char c) {
          return std::isalnum(c) != 0 || c == '-' || c == '_';
        });
    if (is_good) return;
    throw std::invalid_argument("must be 1 to " + std::to_string(longest) +
                                " letters, digits, - or _");
  };
}

void check_area(const std::array<double, 4>& area_deg, const char* key, const ConfigTable& table) {
  const auto& [south, west, north, east] = area_deg;
  if (south > north || std::abs(south) > 90.0 || std::abs(north) > 90.0) {
    throw table.error(key, "must be south, west, north, east within 90 and 180 degrees");
  }
}

void check_distinct(const std::vector<std::string>& names, const char* array,
                    const ConfigTable& root) {
  std::set<std::string> known;
  for (const std::string& name : names) {
    if (!known.insert(name).second) {
      throw root.error(array, "two have the name \"" + name + "\"");
    }
  }
}

}  // namespace ols::config
