// The registers of a simulated GigE Vision camera, and the answers of its control channel.
//
// Aravis' fake camera is not sufficient: it has no time latch and no trigger line, all its cameras
// expose at the same instant, and drawing an image blocks its control channel.
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
  double packet_delay_s = 0.0;  // between the starts of two packets
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
  bool tick_frequency = true;  // false: its register reads 0, as in some firmware
};

class GigeDevice {
 public:
  explicit GigeDevice(const GigeDeviceConfig& config);

  // Takes a control packet from the client `peer` (address << 16 | port), with its times by the
  // camera's clock and the monotonic clock.
  Answer handle(gige::Bytes packet, std::uint64_t peer, std::int64_t clock_ns, double time_s);

  // The stream that is due; nullopt while no client streams. A client silent for longer than the
  // heartbeat timeout is forgotten.
  std::optional<StreamSettings> streaming(double time_s);

  // Whether its clock already follows a PTP master.
  bool ptp_slave(double time_s);

  // The camera forgets the configured size, as after a reset.
  void set_size(int width_px, int height_px);
  // The camera forgets everything, as when switched off and on.
  void power_cycle();

  // can_resend: whether the camera claims to support packet resend. pixel_format: the format
  // (GenICam name) that it enforces from the next connection on, whatever a client writes; empty:
  // none. Throws std::invalid_argument for an unknown name.
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
  std::vector<std::uint8_t> memory_;  // registers and, behind them, the description
  std::optional<std::uint64_t> controller_;
  double heard_s_ = 0.0;  // last packet from the controller
  bool can_resend_ = true;
  bool triggered_ = false;             // by the current packet
  std::optional<double> ptp_since_s_;  // when PTP was switched on
  std::optional<std::uint32_t> kept_format_,
      kept_format_next_;  // PFNC; now, and after the next connection
};

}  // namespace ols::sim
