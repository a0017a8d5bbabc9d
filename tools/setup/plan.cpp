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

// The kind of the camera or the mount, which the section may leave to the default.
std::string kind_of(const Values& values, const std::string& device, const auto& kinds) {
  const std::string* stated = find(values, device + ".kind");
  return stated == nullptr ? kinds.front().name : text_in(*stated).value_or("");
}

// The key with which a kind states where its device is; empty: it has none.
std::string address_key(const std::string& kind) {
  if (kind == "fixed") return {};
  return kind == "rtsp" || kind == "onvif" ? "url" : "device";
}

// A kind that is found by ONVIF, without its address.
bool lacks_url(const Values& values, const std::string& device, const std::string& kind) {
  const std::string* stated = find(values, device + ".kind");
  return stated != nullptr && *stated == toml_text(kind) &&
         find(values, device + ".url") == nullptr;
}

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
  const std::string key = address_key(kind_of(values, "station.camera", station::camera_kinds()));
  return find(values, "station.camera." + key) != nullptr;
}

bool has_mount(const Values& values) {
  const std::string key = address_key(kind_of(values, "station.mount", station::mount_kinds()));
  return key.empty() || (key == "device" ? !mount_device(values).empty()
                                         : find(values, "station.mount." + key) != nullptr);
}

bool wants_onvif(const Values& values) {
  return lacks_url(values, "station.camera", "rtsp") || lacks_url(values, "station.mount", "onvif");
}

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
