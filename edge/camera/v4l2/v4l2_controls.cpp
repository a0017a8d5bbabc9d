#include "edge/camera/v4l2/v4l2_controls.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "conditions/alarms.h"

namespace ols::camera {

std::string v4l2_control_name(std::string_view of_driver) {
  std::string name;
  bool apart = false;
  for (const char c : of_driver) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      apart = !name.empty();
      continue;
    }
    if (std::exchange(apart, false)) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

void check_v4l2_controls(const std::string& configured, const std::vector<V4l2Control>& camera) {
  std::istringstream pairs(configured);
  for (std::string pair; std::getline(pairs, pair, ',');) {
    const std::string name = pair.substr(0, pair.find('='));
    const auto found = std::ranges::find(camera, name, &V4l2Control::name);
    if (found == camera.end()) {
      std::string all;
      for (const V4l2Control& control : camera) all += (all.empty() ? "" : ", ") + control.name;
      throw CameraUnfit(alarm::camera_has_no("control " + name + " (controls: " + all + ")"));
    }
    const std::string value = pair.substr(name.size() + 1);
    const long long number = std::strtoll(value.c_str(), nullptr, 10);
    if (number < found->least || number > found->greatest)
      throw CameraUnfit(alarm::camera_refuses_value(
          "controls: " + name, value + " (" + std::to_string(found->least) + "..." +
                                   std::to_string(found->greatest) + ")"));
  }
}

}  // namespace ols::camera
