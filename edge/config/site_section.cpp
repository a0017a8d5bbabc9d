// Which keys of a station the settings of the whole site may set.
#include <algorithm>

#include "base/config/config_section.h"
#include "edge/config/config.h"

namespace ols::station {

config::Section site_section(StationSettings& settings) {
  config::Section section = config::picked(
      station_section(settings),
      {"camera.tai_minus_utc_s", "mount.servo.max_speed_deg_s", "logic.slew_lease_max_s",
       "logic.max_age_s", "clock.distrust_s", "watchdog.disk_alarm_bytes",
       "watchdog.cpu_alarm_degC", "trust.clock_tolerance_s"});
  section.name = "station";
  section.sentence = "Of all stations.";
  return section;
}

// First the site's, then the station's own file, which wins where it states the same key: what a
// person has set on a tripod stays.
StationSettings load_station_settings(const std::string& path, const trust::SiteSettings& site) {
  StationSettings settings;
  ConfigFile own(path);
  settings.site.file = path;
  settings.site.number = site.number;
  if (site.number > 0) {
    ConfigFile file(site.body, "site settings " + std::to_string(site.number));
    ConfigTable& table = file.root().table("station");
    const config::Section section = site_section(settings);
    config::read(section, table);
    for (const std::string& key : config::stated(section, own.root())) {
      const auto given = config::stated(section, table);
      if (std::ranges::find(given, key) != given.end()) settings.site.own.push_back(key);
    }
  }
  config::read(station_section(settings), own.root());
  return settings;
}

trust::SettingsCheck site_check(const std::string& path) {
  if (path.empty()) return {};
  return [path](const trust::SiteSettings& site, const std::string&) {
    static_cast<void>(load_station_settings(path, site));
  };
}

}  // namespace ols::station
