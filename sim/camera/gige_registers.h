// The registers of the simulated GigE Vision camera: the bootstrap registers of the standard, and
// the camera's own registers.
#pragma once

#include <cstdint>

namespace ols::sim::gige {

constexpr std::uint32_t kMemory = 0x10000;  // [byte] of registers; the GenICam description follows

// GigE Vision 1.x, bootstrap registers.
constexpr std::uint32_t kVersion = 0x0000, kDeviceMode = 0x0004;
constexpr std::uint32_t kAddress = 0x0024;
constexpr std::uint32_t kVendorName = 0x0048, kModelName = 0x0068, kDeviceVersion = 0x0088;
constexpr std::uint32_t kManufacturerInfo = 0x00a8, kSerialNumber = 0x00d8;
constexpr std::uint32_t kDiscoveryBytes = 0x00f8;
constexpr std::uint32_t kDescriptionUrl = 0x0200;
constexpr std::uint32_t kNetworkInterfaces = 0x0600, kStreamChannels = 0x0904;
constexpr std::uint32_t kCapability = 0x0934;
constexpr std::uint32_t kCanWriteMemory = 1U << 1, kCanResend = 1U << 2;
constexpr std::uint32_t kHeartbeat_ms = 0x0938;
constexpr std::uint32_t kTickHzHigh = 0x093c, kTickHzLow = 0x0940;
constexpr std::uint32_t kTimestampControl = 0x0944;
constexpr std::uint32_t kTimestampHigh = 0x0948, kTimestampLow = 0x094c;
constexpr std::uint32_t kLatch = 2;
constexpr std::uint32_t kPrivilege = 0x0a00;
constexpr std::uint32_t kStreamPort = 0x0d00, kPacketSize = 0x0d04, kPacketDelay = 0x0d08;
constexpr std::uint32_t kStreamAddress = 0x0d18;

// Registers of this camera. Floats are IEEE 754 in 32 bits.
constexpr std::uint32_t kSensorWidth = 0xa000, kSensorHeight = 0xa004;
constexpr std::uint32_t kWidth = 0xa008, kHeight = 0xa00c, kOffsetX = 0xa010, kOffsetY = 0xa014;
constexpr std::uint32_t kPixelFormat = 0xa018;
constexpr std::uint32_t kAcquisition = 0xa020, kAcquisitionMode = 0xa024;
constexpr std::uint32_t kFrameRate_hz = 0xa028, kFrameRateEnable = 0xa02c;
constexpr std::uint32_t kExposure_us = 0xa030, kGain_dB = 0xa034;
constexpr std::uint32_t kExposureAuto = 0xa038, kGainAuto = 0xa03c;
constexpr std::uint32_t kTriggerSelector = 0xa040, kTriggerMode = 0xa044, kTriggerSource = 0xa048;
constexpr std::uint32_t kTriggerActivation = 0xa04c, kTriggerDelay_us = 0xa050;
constexpr std::uint32_t kTriggerSoftware = 0xa054;
constexpr std::uint32_t kPtpMode = 0xa060, kPtpStatus = 0xa064;
constexpr std::uint32_t kTemperature_degC = 0xa070;
constexpr std::uint32_t kStreamBytesPerSecond = 0xa080;

// Values of kTriggerSource. The values 1 to 4 are the trigger lines.
constexpr std::uint32_t kFreerun = 0, kFixedRate = 5, kSoftware = 6;
// Values of kPtpStatus. kPtpMode is 0 if PTP is off.
constexpr std::uint32_t kPtpOff = 0, kPtpSyncing = 1, kPtpSlave = 2;

// GenICam's codes (PFNC) of the available pixel formats.
constexpr std::uint32_t kMono8 = 0x01080001;
constexpr std::uint32_t kBayerGR8 = 0x01080008, kBayerRG8 = 0x01080009;
constexpr std::uint32_t kBayerGB8 = 0x0108000a, kBayerBG8 = 0x0108000b;
constexpr std::uint32_t kRGB8 = 0x02180014, kBGR8 = 0x02180015;

constexpr std::uint32_t bytes_per_pixel(std::uint32_t pixel_format) {
  return (pixel_format >> 16 & 0xffU) / 8;
}

}  // namespace ols::sim::gige
