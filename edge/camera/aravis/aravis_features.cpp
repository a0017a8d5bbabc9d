#include "edge/camera/aravis/aravis_features.h"

#include <cmath>

#include "conditions/alarms.h"
#include "edge/camera/aravis/aravis_error.h"

namespace ols::camera {
namespace {

std::string text_of(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

bool is_real(ArvCamera* camera, const char* name) {
  return ARV_IS_GC_FLOAT(arv_device_get_feature(arv_camera_get_device(camera), name));
}

}  // namespace

bool AravisFeatures::has(const char* name) const {
  AravisError error;
  return arv_camera_is_feature_available(camera_, name, error.out()) != 0;
}

const char* AravisFeatures::name_of(const Feature& feature) const {
  for (const char* name : feature.names)
    if (name != nullptr && has(name)) return name;
  return nullptr;
}

void AravisFeatures::set_number(const Feature& feature, double value) const {
  const char* name = name_of(feature);
  if (name == nullptr) throw CameraUnfit(alarm::camera_has_no(feature.what));
  AravisError error;
  if (is_real(camera_, name)) {
    arv_camera_set_float(camera_, name, value, error.out());
  } else {
    arv_camera_set_integer(camera_, name, std::llround(value), error.out());
  }
  error.check<CameraUnfit>(alarm::camera_refuses_value(name, text_of(value)));
}

std::optional<double> AravisFeatures::number(const Feature& feature) const {
  const char* name = name_of(feature);
  if (name == nullptr) return std::nullopt;
  AravisError error;
  const double value =
      is_real(camera_, name)
          ? arv_camera_get_float(camera_, name, error.out())
          : static_cast<double>(arv_camera_get_integer(camera_, name, error.out()));
  return error ? std::nullopt : std::optional(value);
}

std::optional<std::pair<double, double>> AravisFeatures::bounds(const Feature& feature) const {
  const char* name = name_of(feature);
  if (name == nullptr) return std::nullopt;
  AravisError error;
  std::pair<double, double> bounds;
  if (is_real(camera_, name)) {
    arv_camera_get_float_bounds(camera_, name, &bounds.first, &bounds.second, error.out());
  } else {
    gint64 least = 0, greatest = 0;
    arv_camera_get_integer_bounds(camera_, name, &least, &greatest, error.out());
    bounds = {static_cast<double>(least), static_cast<double>(greatest)};
  }
  return error ? std::nullopt : std::optional(bounds);
}

void AravisFeatures::set_flag(const Feature& feature, bool value) const {
  const char* name = name_of(feature);
  if (name == nullptr) throw CameraUnfit(alarm::camera_has_no(feature.what));
  AravisError error;
  arv_camera_set_boolean(camera_, name, value ? 1 : 0, error.out());
  error.check<CameraUnfit>(alarm::camera_refuses(name));
}

bool AravisFeatures::offers(const char* choice, const char* entry) const {
  AravisError error;
  return has(choice) &&
         arv_camera_is_enumeration_entry_available(camera_, choice, entry, error.out()) != 0;
}

void AravisFeatures::choose(const char* choice, const char* entry) const {
  AravisError error;
  arv_camera_set_string(camera_, choice, entry, error.out());
  error.check<CameraUnfit>(alarm::camera_refuses_value(choice, entry));
}

std::optional<std::string> AravisFeatures::chosen(const Feature& choice) const {
  const char* name = name_of(choice);
  if (name == nullptr) return std::nullopt;
  AravisError error;
  const char* entry = arv_camera_get_string(camera_, name, error.out());
  if (error || entry == nullptr) return std::nullopt;
  return std::string(entry);
}

bool AravisFeatures::execute(const char* command) const {
  AravisError error;
  arv_camera_execute_command(camera_, command, error.out());
  return !error;
}

bool AravisFeatures::execute(const Feature& command) const {
  const char* name = name_of(command);
  return name != nullptr && execute(name);
}

}  // namespace ols::camera
