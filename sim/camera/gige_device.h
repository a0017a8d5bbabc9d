// The registers of a simulated GigE Vision camera, and the answers of its control channel.
//
// Aravis' fake camera is not sufficient: it has no time latch and no trigger line, all its cameras
// expose at the same instant, and its control channel blocks while it draws an image.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sim/camera/gige_description.h"
#include "sim/camera/gige_wire.h"

namespace ols::sim {

enum class Trigger { kFreerun, kFixedRate, kSoftware, kLine1, kLine2, kLine3, kLine4 };

struct StreamSettings {
  std::uint32_t address = 0;  // of the client, network byte order
  std::uint16_t port = 0;
  int packet_size = 0;          // [byte] IP packet
  double packet_delay_s = 0.0;  // between the starts of two successive packets
  std::uint32_t width = 0, height = 0;
  std::uint32_t format = 0;  // PFNC code
  double exposure_s = 0.0;
  double gain_dB = 0.0;
  double period_s = 0.0;
  Trigger trigger = Trigger::kFreerun;
  double trigger_delay_s = 0.0;
};

struct ResendRequest {
  std::uint16_t frame = 0;
  std::uint32_t first = 0, last = 0;  // packets
};

struct Answer {
  std::vector<std::uint8_t> acknowledgement;  // empty: none
  std::optional<ResendRequest> resend;
  bool trigger = false;  // the client has sent a software trigger
};

struct GigeDeviceConfig {
  std::string serial;
  std::uint32_t address = 0;  // network byte order
  int width_px = 0, height_px = 0;
  double exposure_s = 0.005;
  gige::FeatureNames names = gige::FeatureNames::kGt1290c;
  // False: the register with the clock's tick frequency reads 0, as with some firmware.
  bool tick_frequency = true;
};

class GigeDevice {
 public:
  explicit GigeDevice(const GigeDeviceConfig& config);

  // Handles a control packet from the client `peer` (address << 16 | port). `clock_ns` and
  // `time_s`: when it arrived, by the camera's clock and by the monotonic clock.
  Answer handle(gige::Bytes packet, std::uint64_t peer, std::int64_t clock_ns, double time_s);

  // The settings of the stream; nullopt while no client streams. If the client is silent for longer
  // than the heartbeat timeout, its stream ends.
  std::optional<StreamSettings> streaming(double time_s);

  // Whether the camera's clock already follows a PTP master.
  bool ptp_slave(double time_s);

  // The camera forgets the configured size, as after a reset.
  void set_size(int width_px, int height_px);
  // The camera forgets everything, as when switched off and on.
  void power_cycle();

  // can_resend: whether the camera claims to support packet resend. pixel_format: GenICam's name of
  // a format that the camera uses from the next connection on, whatever format a client writes;
  // empty: the camera uses the client's format. Throws std::invalid_argument for an unknown name.
  void set_faults(bool can_resend, const std::string& pixel_format);

 private:
  std::uint32_t read(std::uint32_t address) const;
  double read_real(std::uint32_t address) const;
  void write(std::uint32_t address, std::uint32_t value);
  void write_real(std::uint32_t address, double value);
  void write_text(std::uint32_t address, const std::string& text);
  void set_defaults();
  void update_ptp(double time_s);
  gige::Status write_register(std::uint32_t address, std::uint32_t value, std::int64_t clock_ns);
  std::vector<std::uint8_t> read_register(const gige::ControlPacket& asked) const;
  std::vector<std::uint8_t> read_memory(const gige::ControlPacket& asked) const;
  std::vector<std::uint8_t> write_registers(const gige::ControlPacket& asked,
                                            std::int64_t clock_ns);
  std::vector<std::uint8_t> write_memory(const gige::ControlPacket& asked, std::int64_t clock_ns);
  bool may_write(std::uint64_t peer, double time_s);
  void take_control(std::uint64_t peer, double time_s);
  void release();
  Trigger trigger() const;

  const GigeDeviceConfig config_;
  mutable std::mutex mutex_;
  std::vector<std::uint8_t> memory_;  // the registers, followed by the GenICam description
  std::optional<std::uint64_t> controller_;
  double heard_s_ = 0.0;  // when the controlling client last sent a packet
  bool can_resend_ = true;
  bool triggered_ = false;             // whether the packet being handled is a software trigger
  std::optional<double> ptp_since_s_;  // when PTP was switched on
  std::optional<std::uint32_t> kept_format_,
      kept_format_next_;  // PFNC codes of the enforced format: now, and from the next connection on
};

}  // namespace ols::sim
