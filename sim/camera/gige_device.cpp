#include "sim/camera/gige_device.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>

#include "sim/camera/gige_registers.h"

namespace ols::sim {
namespace {

constexpr std::uint32_t kMaxBlock = 512;  // of a memory command
constexpr std::uint32_t kTick_hz = 1'000'000'000;
constexpr std::uint32_t kFullRate = 124'000'000;  // [byte/s] of the link: no delay between packets
constexpr double kFastest_s = 1.0 / 33.0;         // between two frames of a GT1290C
constexpr double kPtpLock_s = 1.0;

gige::Bytes no_data() { return {}; }

std::uint32_t pfnc(const std::string& name) {
  static const std::map<std::string, std::uint32_t> kCodes = {
      {"Mono8", gige::kMono8},       {"BayerGR8", gige::kBayerGR8}, {"BayerRG8", gige::kBayerRG8},
      {"BayerGB8", gige::kBayerGB8}, {"BayerBG8", gige::kBayerBG8}, {"RGB8", gige::kRGB8},
      {"BGR8", gige::kBGR8}};
  const auto found = kCodes.find(name);
  if (found == kCodes.end()) throw std::invalid_argument("no such pixel format: " + name);
  return found->second;
}

}  // namespace

GigeDevice::GigeDevice(const GigeDeviceConfig& config) : config_(config) {
  const std::string text = gige::description(config.names);
  memory_.resize(gige::kMemory);
  memory_.insert(memory_.end(), text.begin(), text.end());
  set_defaults();
}

void GigeDevice::set_defaults() {
  std::fill_n(memory_.begin(), gige::kMemory, std::uint8_t{0});
  write(gige::kVersion, 0x00010002);
  write(gige::kDeviceMode, 0x80000000);  // big-endian
  std::memcpy(&memory_[gige::kAddress], &config_.address, sizeof config_.address);
  write_text(gige::kVendorName, "AVT");
  write_text(gige::kModelName, "GT1290C");
  write_text(gige::kDeviceVersion, "simulated");
  write_text(gige::kSerialNumber, config_.serial.substr(0, 15));
  std::ostringstream url;
  url << std::hex << "Local:camera.xml;" << gige::kMemory << ";" << memory_.size() - gige::kMemory;
  write_text(gige::kDescriptionUrl, url.str());
  write(gige::kNetworkInterfaces, 1);
  write(gige::kStreamChannels, 1);
  write(gige::kCapability, gige::kCanWriteMemory | (can_resend_ ? gige::kCanResend : 0U));
  write(gige::kHeartbeat_ms, 3000);
  write(gige::kTickHzLow, config_.tick_frequency ? kTick_hz : 0U);
  write(gige::kPacketSize, 1500);
  write(gige::kSensorWidth, static_cast<std::uint32_t>(config_.width_px));
  write(gige::kSensorHeight, static_cast<std::uint32_t>(config_.height_px));
  write(gige::kWidth, static_cast<std::uint32_t>(config_.width_px));
  write(gige::kHeight, static_cast<std::uint32_t>(config_.height_px));
  write(gige::kPixelFormat, gige::kMono8);
  write(gige::kAcquisitionMode, 1);
  write_real(gige::kFrameRate_hz, 15.0);
  write_real(gige::kExposure_us, 1e6 * config_.exposure_s);
  write_real(gige::kTemperature_degC, 41.0);
  write(gige::kTriggerMode, config_.names == gige::FeatureNames::kGt1290c ? 1 : 0);
  write(gige::kStreamBytesPerSecond, kFullRate);
}

std::uint32_t GigeDevice::read(std::uint32_t address) const {
  return gige::big_endian(gige::Bytes(memory_).subspan(address, 4));
}

double GigeDevice::read_real(std::uint32_t address) const {
  return double{std::bit_cast<float>(read(address))};
}

void GigeDevice::write(std::uint32_t address, std::uint32_t value) {
  std::ranges::copy(gige::big_endian(value), memory_.begin() + address);
}

void GigeDevice::write_real(std::uint32_t address, double value) {
  write(address, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

void GigeDevice::write_text(std::uint32_t address, const std::string& text) {
  std::ranges::copy(text, memory_.begin() + address);
}

void GigeDevice::set_size(int width_px, int height_px) {
  const std::lock_guard lock(mutex_);
  write(gige::kWidth, static_cast<std::uint32_t>(width_px));
  write(gige::kHeight, static_cast<std::uint32_t>(height_px));
}

void GigeDevice::power_cycle() {
  const std::lock_guard lock(mutex_);
  release();
  ptp_since_s_.reset();
  set_defaults();
}

void GigeDevice::set_faults(bool can_resend, const std::string& pixel_format) {
  const std::lock_guard lock(mutex_);
  can_resend_ = can_resend;
  write(gige::kCapability, gige::kCanWriteMemory | (can_resend ? gige::kCanResend : 0U));
  kept_format_next_.reset();
  if (!pixel_format.empty()) kept_format_next_ = pfnc(pixel_format);
}

void GigeDevice::take_control(std::uint64_t peer, double time_s) {
  controller_ = peer;
  heard_s_ = time_s;
  kept_format_ = kept_format_next_;
  if (kept_format_) write(gige::kPixelFormat, *kept_format_);
}

void GigeDevice::release() {
  controller_.reset();
  write(gige::kPrivilege, 0);
  write(gige::kAcquisition, 0);
}

bool GigeDevice::may_write(std::uint64_t peer, double time_s) {
  if (controller_ && time_s - heard_s_ > 1e-3 * read(gige::kHeartbeat_ms)) release();
  if (controller_ == peer) heard_s_ = time_s;
  return !controller_ || controller_ == peer;
}

void GigeDevice::update_ptp(double time_s) {
  if (read(gige::kPtpMode) == 0) {
    ptp_since_s_.reset();
  } else if (!ptp_since_s_) {
    ptp_since_s_ = time_s;
  }
  const bool locked = ptp_since_s_ && time_s - *ptp_since_s_ > kPtpLock_s;
  write(gige::kPtpStatus, locked         ? gige::kPtpSlave
                          : ptp_since_s_ ? gige::kPtpSyncing
                                         : gige::kPtpOff);
}

bool GigeDevice::ptp_slave(double time_s) {
  const std::lock_guard lock(mutex_);
  update_ptp(time_s);
  return read(gige::kPtpStatus) == gige::kPtpSlave;
}

Answer GigeDevice::handle(gige::Bytes packet, std::uint64_t peer, std::int64_t clock_ns,
                          double time_s) {
  const auto asked = gige::parse(packet);
  if (!asked) return {};
  const std::lock_guard lock(mutex_);
  update_ptp(time_s);
  const bool allowed = may_write(peer, time_s);
  triggered_ = false;
  Answer answer;
  switch (asked->command) {
    case gige::Command::kDiscovery:
      answer.acknowledgement = gige::acknowledge(*asked, gige::Status::kSuccess,
                                                 gige::Bytes(memory_).first(gige::kDiscoveryBytes));
      break;
    case gige::Command::kReadRegister:
      answer.acknowledgement = read_register(*asked);
      break;
    case gige::Command::kReadMemory:
      answer.acknowledgement = read_memory(*asked);
      break;
    case gige::Command::kWriteRegister:
    case gige::Command::kWriteMemory:
      answer.acknowledgement =
          !allowed ? gige::acknowledge(*asked, gige::Status::kAccessDenied, no_data())
          : asked->command == gige::Command::kWriteRegister ? write_registers(*asked, clock_ns)
                                                            : write_memory(*asked, clock_ns);
      break;
    case gige::Command::kResend:
      // It comes from the client's stream socket: the same host, another port.
      if (controller_ && *controller_ >> 16 == peer >> 16 && asked->data.size() >= 12)
        answer.resend =
            ResendRequest{.frame = static_cast<std::uint16_t>(gige::big_endian(asked->data)),
                          .first = gige::big_endian(asked->data.subspan(4)) & 0xffffffU,
                          .last = gige::big_endian(asked->data.subspan(8)) & 0xffffffU};
      break;
    default:
      answer.acknowledgement = gige::acknowledge(*asked, gige::Status::kNotImplemented, {});
  }
  answer.trigger = triggered_;
  const bool controlled = read(gige::kPrivilege) != 0;
  if (controlled && !controller_) {
    take_control(peer, time_s);
  } else if (!controlled && controller_) {
    release();
  }
  return answer;
}

std::vector<std::uint8_t> GigeDevice::read_register(const gige::ControlPacket& asked) const {
  if (asked.data.size() != 4)
    return gige::acknowledge(asked, gige::Status::kInvalidParameter, no_data());
  const std::uint32_t address = gige::big_endian(asked.data);
  if (address > gige::kMemory - 4)
    return gige::acknowledge(asked, gige::Status::kInvalidAddress, no_data());
  return gige::acknowledge(asked, gige::Status::kSuccess, gige::big_endian(read(address)));
}

std::vector<std::uint8_t> GigeDevice::read_memory(const gige::ControlPacket& asked) const {
  if (asked.data.size() != 8)
    return gige::acknowledge(asked, gige::Status::kInvalidParameter, no_data());
  const std::size_t address = gige::big_endian(asked.data);
  const std::size_t count = gige::big_endian(asked.data.subspan(4)) & 0xffffU;
  if (count == 0 || count > kMaxBlock || address >= memory_.size())
    return gige::acknowledge(asked, gige::Status::kInvalidAddress, no_data());
  // Beyond the end of the description it reads zeros.
  std::vector<std::uint8_t> data(4 + count);
  std::copy_n(asked.data.begin(), 4, data.begin());
  std::copy_n(&memory_[address], std::min(count, memory_.size() - address), data.begin() + 4);
  return gige::acknowledge(asked, gige::Status::kSuccess, data);
}

gige::Status GigeDevice::write_register(std::uint32_t address, std::uint32_t value,
                                        std::int64_t clock_ns) {
  if (address > gige::kMemory - 4) return gige::Status::kInvalidAddress;
  if (address == gige::kTimestampControl && (value & gige::kLatch) != 0) {
    write(gige::kTimestampHigh, static_cast<std::uint32_t>(clock_ns >> 32));
    write(gige::kTimestampLow, static_cast<std::uint32_t>(clock_ns));
    return gige::Status::kSuccess;
  }
  if (address == gige::kTriggerSoftware) {
    triggered_ = true;
    return gige::Status::kSuccess;
  }
  if ((address == gige::kWidth && value > read(gige::kSensorWidth)) ||
      (address == gige::kHeight && value > read(gige::kSensorHeight)))
    return gige::Status::kInvalidParameter;
  if (address == gige::kPixelFormat && kept_format_) value = *kept_format_;
  write(address, value);
  return gige::Status::kSuccess;
}

std::vector<std::uint8_t> GigeDevice::write_registers(const gige::ControlPacket& asked,
                                                      std::int64_t clock_ns) {
  std::uint32_t written = 0;
  gige::Status status = gige::Status::kSuccess;
  for (gige::Bytes rest = asked.data; rest.size() >= 8 && status == gige::Status::kSuccess;
       rest = rest.subspan(8)) {
    status = write_register(gige::big_endian(rest), gige::big_endian(rest.subspan(4)), clock_ns);
    ++written;
  }
  return gige::acknowledge(asked, status, gige::big_endian(written));
}

std::vector<std::uint8_t> GigeDevice::write_memory(const gige::ControlPacket& asked,
                                                   std::int64_t clock_ns) {
  if (asked.data.size() < 8)
    return gige::acknowledge(asked, gige::Status::kInvalidParameter, no_data());
  gige::Status status = gige::Status::kSuccess;
  std::uint32_t address = gige::big_endian(asked.data);
  for (gige::Bytes rest = asked.data.subspan(4);
       rest.size() >= 4 && status == gige::Status::kSuccess; rest = rest.subspan(4)) {
    status = write_register(address, gige::big_endian(rest), clock_ns);
    address += 4;
  }
  return gige::acknowledge(asked, status, asked.data.first(4));
}

Trigger GigeDevice::trigger() const {
  if (read(gige::kTriggerMode) == 0)
    return read(gige::kFrameRateEnable) != 0 ? Trigger::kFixedRate : Trigger::kFreerun;
  switch (read(gige::kTriggerSource)) {
    case gige::kFreerun:
      return Trigger::kFreerun;
    case gige::kSoftware:
      return Trigger::kSoftware;
    case 1:
      return Trigger::kLine1;
    case 2:
      return Trigger::kLine2;
    case 3:
      return Trigger::kLine3;
    case 4:
      return Trigger::kLine4;
    default:
      return Trigger::kFixedRate;
  }
}

std::optional<StreamSettings> GigeDevice::streaming(double time_s) {
  const std::lock_guard lock(mutex_);
  if (controller_ && time_s - heard_s_ > 1e-3 * read(gige::kHeartbeat_ms)) release();
  if (!controller_ || read(gige::kAcquisition) == 0) return std::nullopt;
  StreamSettings s;
  std::memcpy(&s.address, &memory_[gige::kStreamAddress], sizeof s.address);
  s.port = static_cast<std::uint16_t>(read(gige::kStreamPort));
  s.packet_size = static_cast<int>(read(gige::kPacketSize) & 0xffffU);
  s.packet_delay_s = static_cast<double>(read(gige::kPacketDelay)) / kTick_hz;
  const std::uint32_t rate = read(gige::kStreamBytesPerSecond);
  if (rate > 0 && rate < kFullRate)
    s.packet_delay_s = std::max(s.packet_delay_s, double{s.packet_size + 0.0} / rate);
  s.width = read(gige::kWidth);
  s.height = read(gige::kHeight);
  s.format = read(gige::kPixelFormat);
  s.exposure_s = 1e-6 * read_real(gige::kExposure_us);
  s.gain_dB = read_real(gige::kGain_dB);
  s.trigger = trigger();
  s.trigger_delay_s = 1e-6 * read_real(gige::kTriggerDelay_us);
  s.period_s = std::max(kFastest_s, s.exposure_s);
  if (s.trigger == Trigger::kFixedRate)
    s.period_s = std::max(s.exposure_s, 1.0 / read_real(gige::kFrameRate_hz));
  const bool sensible = s.port != 0 && s.packet_size > gige::kUdpOverhead + gige::kHeader &&
                        s.width > 0 && s.height > 0 && s.period_s > 0.0 && s.period_s < 1e3;
  return sensible ? std::optional(s) : std::nullopt;
}

}  // namespace ols::sim
