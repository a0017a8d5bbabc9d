#include "tools/setup/finders.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/config/toml_text.h"
#include "base/text/plain_text.h"
#include "tools/doctor/probe.h"
#include "tools/setup/find_devices.h"
#include "tools/setup/find_heads.h"
#include "tools/setup/find_indi.h"
#include "tools/setup/find_onvif.h"
#include "tools/setup/find_v4l2.h"

namespace ols::setup {
namespace {

std::vector<Found> gige_cameras(const Search& /*search*/) {
  std::vector<Found> found;
  for (const auto& camera : doctor::cameras_that_answer())
    found.push_back({plain_text(camera.id), {{"station.camera.device", toml_text(camera.id)}}});
  return found;
}

std::vector<Found> onvif_cameras(const Search& /*search*/) {
  std::vector<Found> found;
  for (const auto& camera : find_onvif()) found.push_back({words_of(camera), {}, camera.url});
  return found;
}

std::vector<Found> flir_units(const Search& search) {
  std::vector<Found> found;
  for (const auto& unit : find_ptus(search.lines))
    found.push_back(
        {fmt::format("PTU {} on {} at {} baud", plain_text(unit.version), unit.device, unit.baud),
         {{"station.mount.device", toml_text(unit.device)}}});
  return found;
}

Finder heads(const char* kind, const char* called, serial_mount::Language language) {
  return {kind, called, [language](const Search& search) {
            std::vector<Found> found;
            for (const auto& head : find_heads(search.lines, language, search.pelco_address))
              found.push_back(found_head(head));
            return found;
          }};
}

}  // namespace

const std::vector<Finder>& camera_finders() {
  static const std::vector<Finder> finders{
      {"aravis", "camera", gige_cameras},
      {"onvif", "ONVIF camera", onvif_cameras},
      {"v4l2", "V4L2 camera", [](const Search&) { return find_v4l2(v4l2_devices()); }}};
  return finders;
}

const std::vector<Finder>& mount_finders() {
  static const std::vector<Finder> finders{
      {"flir", "PTU", flir_units},
      heads("visca", "VISCA head", serial_mount::Language::kVisca),
      heads("pelco-d", "Pelco-D head", serial_mount::Language::kPelcoD),
      {"indi", "INDI mount",
       [](const Search& search) { return find_indi(search.indi_host, search.indi_port); }}};
  return finders;
}

std::vector<Found> find_all(const std::vector<Finder>& finders, Search search) {
  std::vector<Found> all;
  for (const Finder& finder : finders) {
    const std::vector<Found> found = finder.find(search);
    std::erase_if(search.lines, [&](const std::string& line) {
      return std::ranges::any_of(found, [&](const Found& one) {
        const std::string* device = value_of(one, "station.mount.device");
        return device != nullptr && *device == toml_text(line);
      });
    });
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

const std::string* value_of(const Found& found, const std::string& key) {
  return find(found.values, key);
}

}  // namespace ols::setup
