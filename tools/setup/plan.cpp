#include "tools/setup/plan.h"

#include "base/config/toml_text.h"
#include "edge/config/device_kinds.h"
#include "tools/setup/site_time.h"

namespace ols::setup {
namespace {

PlannedFile bus_file(const Answers& answers) {
  return {"/etc/ols/bus.env",
          "# The interface that leads to the other hosts of the site.\nOLS_BUS_INTERFACE=" +
              (answers.interface.empty() ? "lo" : answers.interface) + "\n",
          false};
}

// A fixed device: gpsd's search for one may not find the fix. -n: read it before anyone asks.
PlannedFile gpsd_file(const std::string& device) {
  return {"/etc/default/gpsd",
          "DEVICES=\"" + device + "\"\nGPSD_OPTIONS=\"-n\"\nUSBAUTO=\"false\"\n", false,
          "DEVICES=\"\"\n"};
}

// Another kind than the first one, whose device has to be found.
bool is_other(const Values& values, const std::string& key, const auto& kinds) {
  const std::string* stated = find(values, key);
  return stated != nullptr && *stated != toml_text(kinds.front().name);
}

// A kind that is found by its address, which is not stated.
bool lacks_url(const Values& values, const std::string& device, const std::string& kind) {
  const std::string* stated = find(values, device + ".kind");
  return stated != nullptr && *stated == toml_text(kind) &&
         find(values, device + ".url") == nullptr;
}

bool lacks_stream(const Values& values) { return lacks_url(values, "station.camera", "rtsp"); }
bool lacks_service(const Values& values) { return lacks_url(values, "station.mount", "onvif"); }

PlannedFile time_file(const Answers& answers) {
  return {"/etc/chrony/conf.d/ols-site.conf", chrony_file(answers.neighbours), false};
}

}  // namespace

void add(Values& values, const std::string& key, const std::string& text) {
  if (find(values, key) == nullptr) values.emplace_back(key, toml_text(text));
}

std::string mount_device(const Values& values) {
  for (const char* key : {"station.mount.device", "station.ptu.device"}) {
    if (const std::string* device = find(values, key)) return *device;
  }
  return {};
}

bool has_camera(const Values& values) {
  return find(values, "station.camera.device") != nullptr ||
         (is_other(values, "station.camera.kind", station::camera_kinds()) &&
          !lacks_stream(values));
}

bool has_mount(const Values& values) {
  return !mount_device(values).empty() ||
         (is_other(values, "station.mount.kind", station::mount_kinds()) && !lacks_service(values));
}

bool wants_onvif(const Values& values) { return lacks_stream(values) || lacks_service(values); }

Plan plan_station(const Answers& answers) {
  Plan plan;
  const std::string path = "/etc/ols/" + answers.station + ".toml";
  plan.files.push_back({path, station_file(of_table(answers.values, "station"), path)});
  plan.files.push_back(bus_file(answers));
  plan.files.push_back(time_file(answers));
  plan.units = {"ols-bus.service", "ols-time.service"};
  if (!answers.gnss.empty()) {
    plan.files.push_back(gpsd_file(answers.gnss));
    plan.files.push_back({"/etc/chrony/conf.d/ols-gnss.conf", receiver_chrony_file(), false});
    plan.units.emplace_back("gpsd.service");
  }
  plan.units.push_back("ols-station@" + answers.station + ".service");
  return plan;
}

Plan plan_centre(const Answers& answers, Installed installed) {
  Plan plan;
  plan.files.push_back(bus_file(answers));
  plan.files.push_back(time_file(answers));
  plan.units = {"ols-bus.service", "ols-time.service"};
  const auto file = [&](const std::string& name, auto text_of) {
    const std::string path = "/etc/ols/" + name + ".toml";
    plan.files.push_back({path, text_of(of_table(answers.values, name), path)});
    plan.units.push_back("ols-" + name + ".service");
  };
  if (installed.fusion) {
    file("fusion", fusion_file);
    file("logger", logger_file);
    file("exporter", exporter_file);
  }
  if (installed.console) file("console", console_file);
  return plan;
}

}  // namespace ols::setup
