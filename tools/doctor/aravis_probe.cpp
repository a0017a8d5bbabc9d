// Looks for cameras, and at the one that is configured, for ols-doctor.
#include <arv.h>

#include "edge/camera/aravis/aravis_device.h"
#include "edge/camera/aravis/aravis_error.h"
#include "edge/camera/aravis/aravis_features.h"
#include "tools/doctor/probe.h"

namespace ols::doctor {
namespace {

std::string identity_of(ArvCamera* camera) {
  std::string words;
  camera::AravisError error;
  for (const auto get : {arv_camera_get_vendor_name, arv_camera_get_model_name,
                         arv_camera_get_device_serial_number}) {
    const char* word = get(camera, error.out());
    if (error || word == nullptr || *word == 0) continue;
    if (!words.empty()) words.push_back(' ');
    words += word;
  }
  return words;
}

// The address of an opened camera, for the route of its stream.
std::string address_of(ArvDevice* device) {
  GSocketAddress* socket = arv_gv_device_get_device_address(ARV_GV_DEVICE(device));
  if (socket == nullptr || !G_IS_INET_SOCKET_ADDRESS(socket)) return {};
  gchar* text =
      g_inet_address_to_string(g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(socket)));
  std::string address = text;
  g_free(text);
  return address;
}

void examine(ArvCamera* camera, CameraAnswers& answers) {
  ArvDevice* device = arv_camera_get_device(camera);
  answers.identity = identity_of(camera);
  if (!ARV_IS_GV_DEVICE(device)) {
    answers.trouble = answers.device + " is not a GigE Vision camera";
    return;
  }
  answers.controlled = arv_gv_device_is_controller(ARV_GV_DEVICE(device)) == 0;
  camera::AravisError error;
  const auto tick_hz =
      arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(device), error.out());
  answers.has_clock = !error && tick_hz != 0;
  answers.temperature_degC = camera::AravisFeatures(camera).number(camera::kTemperature);
  answers.link = look_at_link(address_of(device));
}

}  // namespace

std::vector<CameraSeen> cameras_that_answer() {
  std::vector<CameraSeen> seen;
  arv_update_device_list();
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    const char* address = arv_get_device_address(i);
    seen.push_back({arv_get_device_id(i), address == nullptr ? "" : address});
  }
  return seen;
}

CameraAnswers ask_camera(const camera::AravisConfig& config) {
  CameraAnswers answers;
  answers.device = config.device;
  answers.rate_bytes_s = config.width_px * config.height_px * config.frame_rate_hz;
  camera::AravisError error;
  const camera::Owned<ArvCamera> camera(arv_camera_new(config.device.c_str(), error.out()));
  if (camera == nullptr) {
    answers.trouble = config.device + " does not answer: " + error.text();
    for (const auto& [id, address] : cameras_that_answer()) {
      answers.others.push_back(address.empty() ? id : id + " at " + address);
    }
    return answers;
  }
  examine(camera.get(), answers);
  return answers;
}

}  // namespace ols::doctor
