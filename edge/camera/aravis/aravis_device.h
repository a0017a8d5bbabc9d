// One opened GigE Vision camera with its stream. Functions wait for the camera's answer and throw
// on errors.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "edge/camera/aravis/aravis_config.h"
#include "edge/camera/camera_errors.h"
#include "edge/camera/clock_map.h"
#include "edge/camera/picture.h"
#include "edge/camera/ptp.h"

using ArvBuffer = struct _ArvBuffer;
using ArvCamera = struct _ArvCamera;
using ArvDevice = struct _ArvDevice;
using ArvStream = struct _ArvStream;

namespace ols::camera {

struct Unref {
  void operator()(void* object) const;  // g_object_unref
};
template <typename T>
using Owned = std::unique_ptr<T, Unref>;

// One buffer of the stream. It is valid only during receive()'s call of `use`.
struct ReceivedFrame {
  std::uint64_t id = 0;  // the camera's frame number
  bool complete = false;
  bool overtaken = false;                 // a newer frame is already waiting
  RawPicture picture;                     // valid as long as the buffer is
  std::optional<std::int64_t> device_ns;  // the camera's own time stamp
  double arrival_s = 0.0;  // CLOCK_MONOTONIC at the arrival of the frame's first packet
};

class AravisDevice {
 public:
  // Opens and configures the camera, and starts its stream. Throws CameraAbsent or CameraUnfit.
  explicit AravisDevice(const AravisConfig& config);
  ~AravisDevice();
  AravisDevice(const AravisDevice&) = delete;
  AravisDevice& operator=(const AravisDevice&) = delete;

  // Waits for the next buffer and passes it to `use` as a ReceivedFrame. Returns false if no buffer
  // came in time.
  template <typename Use>
  bool receive(double timeout_s, Use use) {
    ArvBuffer* buffer = pop(timeout_s);
    if (buffer == nullptr) return false;
    const BufferReturn give_back{stream_.get(), buffer};
    use(describe(buffer));
    return true;
  }

  std::string identity() const;  // for example "AVT GT1290C 1234"
  std::string serial() const;    // empty if the camera does not state it

  // Reads the camera's clock by a latch (clock_map.h); nullopt if the camera cannot latch its
  // clock.
  std::optional<LatchSample> latch();
  // Whether the camera still answers.
  bool answers();
  void trigger();  // starts one exposure by a software command

  // The camera's current exposure and gain, and their limits.
  const ExposureSetting& exposure() const { return exposure_; }
  const ExposureLimits& limits() const { return limits_; }
  // Throws CameraUnfit if the camera refuses the setting.
  void set_exposure(const ExposureSetting& setting);

  std::optional<double> temperature_degC() const;  // nullopt if the camera does not report it
  std::optional<PtpState> ptp() const;

  bool control_lost() const { return control_lost_; }
  // Notes that the camera is lost; no more requests are sent to it. The destructor may still take
  // seconds, because Aravis sends the disconnection to the camera five times, 0.5 s apart.
  void give_up() { gone_ = true; }

 private:
  struct BufferReturn {
    ArvStream* stream;
    ArvBuffer* buffer;
    ~BufferReturn();
  };
  void start(const AravisConfig& config);
  ArvDevice* device() const;
  ArvBuffer* pop(double timeout_s);
  ReceivedFrame describe(ArvBuffer* buffer) const;
  bool command_latch();
  std::optional<std::uint64_t> latched_ticks();

  Owned<ArvCamera> camera_;
  Owned<ArvStream> stream_;
  std::atomic<bool> control_lost_ = false;
  bool gone_ = false;
  ExposureSetting exposure_;
  ExposureLimits limits_;
  std::uint64_t tick_hz_ = 0;  // 0 if the camera's clock is not available
  bool latch_by_feature_ = false;
  std::uint64_t last_latch_ticks_ = 0;
};

}  // namespace ols::camera
