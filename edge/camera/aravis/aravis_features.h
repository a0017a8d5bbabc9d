// Accesses the features of an opened camera by their purpose. The names of features differ between
// cameras: the GT1290C is older than GenICam's naming convention (SFNC), and SFNC itself has
// renamed some features. Each purpose therefore has several names; the first name that the camera
// knows is used.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

using ArvCamera = struct _ArvCamera;

namespace ols::camera {

struct Feature {
  const char* what;                  // for messages
  std::array<const char*, 3> names;  // nullptr after the last name
};

// Features with a number as value, float or integer. The first name is that of SFNC 2.x. The second
// one is that of the GT1290C ("GigE Camera and Driver Features", AVT) and of SFNC 1.x.
inline constexpr Feature kExposureTime{"exposure", {"ExposureTime", "ExposureTimeAbs", nullptr}};
inline constexpr Feature kGain{"gain", {"Gain", "GainRaw", nullptr}};
inline constexpr Feature kFrameRate{"frame rate",
                                    {"AcquisitionFrameRate", "AcquisitionFrameRateAbs", nullptr}};
inline constexpr Feature kTriggerDelay{"trigger delay",
                                       {"TriggerDelay", "TriggerDelayAbs", nullptr}};
inline constexpr Feature kTemperature{"temperature", {"DeviceTemperature", nullptr, nullptr}};
inline constexpr Feature kStreamRate{"stream rate", {"StreamBytesPerSecond", nullptr, nullptr}};
// Features with a word as value.
inline constexpr Feature kPtpStatus{"PTP status", {"PtpStatus", "GevIEEE1588Status", nullptr}};
inline constexpr Feature kPtpMode{"PTP mode", {"PtpMode", nullptr, nullptr}};
// Features with true or false as value.
inline constexpr Feature kPtpEnable{"PTP", {"PtpEnable", "GevIEEE1588", nullptr}};
inline constexpr Feature kFrameRateEnable{
    "frame rate control", {"AcquisitionFrameRateEnable", "AcquisitionFrameRateEnabled", nullptr}};
// Features that are commands.
inline constexpr Feature kPtpLatch{"PTP latch",
                                   {"PtpDataSetLatch", "GevIEEE1588DataSetLatch", nullptr}};

// Setters throw CameraUnfit with the feature and the camera's error message.
class AravisFeatures {
 public:
  explicit AravisFeatures(ArvCamera* camera) : camera_(camera) {}

  bool has(const char* name) const;
  bool has(const Feature& feature) const { return name_of(feature) != nullptr; }

  void set_number(const Feature& feature, double value) const;
  std::optional<double> number(const Feature& feature) const;
  std::optional<std::pair<double, double>> bounds(const Feature& feature) const;

  void set_flag(const Feature& feature, bool value) const;

  bool offers(const char* choice, const char* entry) const;
  void choose(const char* choice, const char* entry) const;
  std::optional<std::string> chosen(const Feature& choice) const;

  bool execute(const char* command) const;
  bool execute(const Feature& command) const;

 private:
  const char* name_of(const Feature& feature) const;  // nullptr if the camera has none of the names

  ArvCamera* camera_;
};

}  // namespace ols::camera
