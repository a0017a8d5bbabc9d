#include "tools/sim/gige_device.h"

#include <arv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace ols::sim {
namespace {

// GigE Vision bootstrap registers.
constexpr std::uint32_t kAddress = 0x0024;
constexpr std::uint32_t kDiscoveryBytes = 0xf8;
constexpr std::uint32_t kCapability = 0x0934;
constexpr std::uint32_t kCanWriteMemory = 1U << 1, kCanResend = 1U << 2;
constexpr std::uint32_t kHeartbeat_ms = 0x0938;
constexpr std::uint32_t kTimestampControl = 0x0944;
constexpr std::uint32_t kTimestampHigh = 0x0948, kTimestampLow = 0x094c;
constexpr std::uint32_t kLatch = 2;
constexpr std::uint32_t kPrivilege = 0x0a00;
constexpr std::uint32_t kStreamPort = 0x0d00, kPacketSize = 0x0d04, kStreamAddress = 0x0d18;

constexpr std::uint32_t kMaxBlock = 512;  // of a memory command

gige::Bytes no_data() { return {}; }

std::uint32_t pfnc(const std::string& name) {
  static const std::map<std::string, std::uint32_t> kCodes = {
      {"Mono8", ARV_PIXEL_FORMAT_MONO_8},
      {"BayerGR8", ARV_PIXEL_FORMAT_BAYER_GR_8},
      {"BayerRG8", ARV_PIXEL_FORMAT_BAYER_RG_8},
      {"BayerGB8", ARV_PIXEL_FORMAT_BAYER_GB_8},
      {"BayerBG8", ARV_PIXEL_FORMAT_BAYER_BG_8}};
  const auto found = kCodes.find(name);
  if (found == kCodes.end()) throw std::invalid_argument("no such pixel format: " + name);
  return found->second;
}

}  // namespace

GigeDevice::GigeDevice(const std::string& serial, std::uint32_t address, int width_px,
                       int height_px, double exposure_s)
    : registers_(arv_fake_camera_new(serial.c_str()),
                 [](ArvFakeCamera* camera) { g_object_unref(camera); }) {
  arv_fake_camera_write_memory(registers_.get(), kAddress, sizeof address, &address);
  write(ARV_FAKE_CAMERA_REGISTER_SENSOR_WIDTH, static_cast<std::uint32_t>(width_px));
  write(ARV_FAKE_CAMERA_REGISTER_SENSOR_HEIGHT, static_cast<std::uint32_t>(height_px));
  write(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US,
        static_cast<std::uint32_t>(std::lround(1e6 * exposure_s)));
  write(kCapability, kCanWriteMemory | kCanResend);
  set_size(width_px, height_px);
}

GigeDevice::~GigeDevice() = default;

std::uint32_t GigeDevice::read(std::uint32_t address) const {
  guint32 value = 0;
  arv_fake_camera_read_register(registers_.get(), address, &value);
  return value;
}

void GigeDevice::write(std::uint32_t address, std::uint32_t value) {
  arv_fake_camera_write_register(registers_.get(), address, value);
}

void GigeDevice::set_size(int width_px, int height_px) {
  const std::lock_guard lock(mutex_);
  write(ARV_FAKE_CAMERA_REGISTER_WIDTH, static_cast<std::uint32_t>(width_px));
  write(ARV_FAKE_CAMERA_REGISTER_HEIGHT, static_cast<std::uint32_t>(height_px));
}

void GigeDevice::set_faults(bool can_resend, const std::string& pixel_format) {
  const std::lock_guard lock(mutex_);
  write(kCapability, kCanWriteMemory | (can_resend ? kCanResend : 0U));
  kept_format_next_.reset();
  if (!pixel_format.empty()) kept_format_next_ = pfnc(pixel_format);
}

void GigeDevice::take_control(std::uint64_t peer, double time_s) {
  controller_ = peer;
  heard_s_ = time_s;
  kept_format_ = kept_format_next_;
  if (kept_format_) write(ARV_FAKE_CAMERA_REGISTER_PIXEL_FORMAT, *kept_format_);
}

void GigeDevice::release() {
  controller_.reset();
  write(kPrivilege, 0);
  write(ARV_FAKE_CAMERA_REGISTER_ACQUISITION, 0);
}

bool GigeDevice::may_write(std::uint64_t peer, double time_s) {
  if (controller_ && time_s - heard_s_ > 1e-3 * read(kHeartbeat_ms)) release();
  if (controller_ == peer) heard_s_ = time_s;
  return !controller_ || controller_ == peer;
}

Answer GigeDevice::handle(gige::Bytes packet, std::uint64_t peer, std::int64_t clock_ns,
                          double time_s) {
  const auto asked = gige::parse(packet);
  if (!asked) return {};
  const std::lock_guard lock(mutex_);
  const bool allowed = may_write(peer, time_s);
  const auto denied = [&] {
    return Answer{.acknowledgement = gige::acknowledge(*asked, gige::Status::kAccessDenied, {}),
                  .resend = {}};
  };
  Answer answer;
  switch (asked->command) {
    case gige::Command::kDiscovery: {
      std::array<std::uint8_t, kDiscoveryBytes> data{};
      arv_fake_camera_read_memory(registers_.get(), 0, data.size(), data.data());
      answer.acknowledgement = gige::acknowledge(*asked, gige::Status::kSuccess, data);
      break;
    }
    case gige::Command::kReadRegister:
      answer.acknowledgement = read_register(*asked);
      break;
    case gige::Command::kReadMemory:
      answer.acknowledgement = read_memory(*asked);
      break;
    case gige::Command::kWriteRegister:
      if (!allowed) return denied();
      answer.acknowledgement = write_registers(*asked, clock_ns);
      break;
    case gige::Command::kWriteMemory:
      if (!allowed) return denied();
      answer.acknowledgement = write_memory(*asked, clock_ns);
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
  const bool controlled = read(kPrivilege) != 0;
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
  if (address > ARV_FAKE_CAMERA_MEMORY_SIZE - 4)
    return gige::acknowledge(asked, gige::Status::kInvalidAddress, no_data());
  return gige::acknowledge(asked, gige::Status::kSuccess, gige::big_endian(read(address)));
}

std::vector<std::uint8_t> GigeDevice::read_memory(const gige::ControlPacket& asked) const {
  if (asked.data.size() != 8)
    return gige::acknowledge(asked, gige::Status::kInvalidParameter, no_data());
  const std::uint32_t address = gige::big_endian(asked.data);
  const std::uint32_t count = gige::big_endian(asked.data.subspan(4)) & 0xffffU;
  std::size_t description = 0;  // lies behind the registers; read past its end it is zeros
  arv_fake_camera_get_genicam_xml(registers_.get(), &description);
  if (count == 0 || count > kMaxBlock || address >= ARV_FAKE_CAMERA_MEMORY_SIZE + description)
    return gige::acknowledge(asked, gige::Status::kInvalidAddress, no_data());
  std::vector<std::uint8_t> data(4 + count);
  std::copy_n(asked.data.begin(), 4, data.begin());
  arv_fake_camera_read_memory(registers_.get(), address, count, data.data() + 4);
  return gige::acknowledge(asked, gige::Status::kSuccess, data);
}

gige::Status GigeDevice::write_register(std::uint32_t address, std::uint32_t value,
                                        std::int64_t clock_ns) {
  if (address > ARV_FAKE_CAMERA_MEMORY_SIZE - 4) return gige::Status::kInvalidAddress;
  if (address == kTimestampControl && (value & kLatch) != 0) {
    write(kTimestampHigh, static_cast<std::uint32_t>(clock_ns >> 32));
    write(kTimestampLow, static_cast<std::uint32_t>(clock_ns));
    return gige::Status::kSuccess;
  }
  if ((address == ARV_FAKE_CAMERA_REGISTER_WIDTH &&
       value > read(ARV_FAKE_CAMERA_REGISTER_SENSOR_WIDTH)) ||
      (address == ARV_FAKE_CAMERA_REGISTER_HEIGHT &&
       value > read(ARV_FAKE_CAMERA_REGISTER_SENSOR_HEIGHT)))
    return gige::Status::kInvalidParameter;
  if (address == ARV_FAKE_CAMERA_REGISTER_PIXEL_FORMAT && kept_format_) value = *kept_format_;
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

std::optional<StreamSettings> GigeDevice::streaming(double time_s) {
  const std::lock_guard lock(mutex_);
  if (controller_ && time_s - heard_s_ > 1e-3 * read(kHeartbeat_ms)) release();
  if (!controller_ || read(ARV_FAKE_CAMERA_REGISTER_ACQUISITION) == 0) return std::nullopt;
  StreamSettings s;
  arv_fake_camera_read_memory(registers_.get(), kStreamAddress, sizeof s.address, &s.address);
  s.port = static_cast<std::uint16_t>(read(kStreamPort));
  s.packet_size = static_cast<int>(read(kPacketSize) & 0xffffU);
  s.width = read(ARV_FAKE_CAMERA_REGISTER_WIDTH);
  s.height = read(ARV_FAKE_CAMERA_REGISTER_HEIGHT);
  s.format = read(ARV_FAKE_CAMERA_REGISTER_PIXEL_FORMAT);
  s.exposure_s = 1e-6 * read(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US);
  s.period_s = 1e-6 * read(ARV_FAKE_CAMERA_REGISTER_ACQUISITION_FRAME_PERIOD_US);
  const bool sensible = s.port != 0 && s.packet_size > gige::kUdpOverhead + gige::kHeader &&
                        s.width > 0 && s.height > 0 && s.period_s > 0.0;
  return sensible ? std::optional(s) : std::nullopt;
}

}  // namespace ols::sim
