#include "sim/camera/gige_description.h"

#include <cstdint>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/camera/gige_registers.h"

namespace ols::sim::gige {
namespace {

using Entries = std::vector<std::pair<std::string_view, std::uint32_t>>;

constexpr std::string_view kHead = R"(<?xml version="1.0" encoding="utf-8"?>
<RegisterDescription ModelName="GT1290C" VendorName="AVT" StandardNameSpace="None"
  SchemaMajorVersion="1" SchemaMinorVersion="1" SchemaSubMinorVersion="0"
  MajorVersion="1" MinorVersion="0" SubMinorVersion="0" ToolTip="Simulated camera"
  ProductGuid="0" VersionGuid="0" xmlns="http://www.genicam.org/GenApi/Version_1_1">
)";

// Features that no table below describes.
constexpr std::string_view kTail = R"(
<IntSwissKnife Name="PayloadSize">
  <pVariable Name="WIDTH">Width</pVariable>
  <pVariable Name="HEIGHT">Height</pVariable>
  <pVariable Name="FORMAT">PixelFormat</pVariable>
  <Formula>WIDTH * HEIGHT * ((FORMAT &gt;&gt; 16) &amp; 0xff) / 8</Formula>
</IntSwissKnife>
<Integer Name="TLParamsLocked"><Value>0</Value><Min>0</Min><Max>1</Max></Integer>
<Port Name="Device"/>
</RegisterDescription>
)";

class Description {
 public:
  Description() { out_ << kHead; }

  void text(std::string_view name, std::uint32_t address, int length) {
    feature(name);
    out_ << "<StringReg Name=\"" << name << "\">";
    place(address, length, "RO");
    out_ << "</StringReg>\n";
  }

  void integer(std::string_view name, std::uint32_t address, std::string_view bounds,
               std::string_view access = "RW", int length = 4) {
    feature(name);
    out_ << "<Integer Name=\"" << name << "\"><pValue>" << name << "Reg</pValue>" << bounds
         << "</Integer>\n";
    int_register(name, address, access, length);
  }

  void real(std::string_view name, std::uint32_t address, double least, double greatest,
            std::string_view access = "RW") {
    feature(name);
    out_ << "<Float Name=\"" << name << "\"><pValue>" << name << "Reg</pValue><Min>" << least
         << "</Min><Max>" << greatest << "</Max></Float>\n<FloatReg Name=\"" << name << "Reg\">";
    place(address, 4, access);
    out_ << "<Endianess>BigEndian</Endianess></FloatReg>\n";
  }

  void choice(std::string_view name, std::uint32_t address, const Entries& entries,
              std::string_view access = "RW") {
    feature(name);
    out_ << "<Enumeration Name=\"" << name << "\">";
    for (const auto& [entry, value] : entries)
      out_ << "<EnumEntry Name=\"" << entry << "\"><Value>" << value << "</Value></EnumEntry>";
    out_ << "<pValue>" << name << "Reg</pValue></Enumeration>\n";
    int_register(name, address, access, 4);
  }

  void flag(std::string_view name, std::uint32_t address) {
    feature(name);
    out_ << "<Boolean Name=\"" << name << "\"><pValue>" << name
         << "Reg</pValue><OnValue>1</OnValue><OffValue>0</OffValue></Boolean>\n";
    int_register(name, address, "RW", 4);
  }

  void command(std::string_view name, std::uint32_t address, std::uint32_t value) {
    feature(name);
    out_ << "<Command Name=\"" << name << "\"><CommandValue>" << value << "</CommandValue><pValue>"
         << name << "Reg</pValue></Command>\n";
    int_register(name, address, "WO", 4);
  }

  std::string finish() {
    feature("PayloadSize");
    out_ << "<Category Name=\"Root\">";
    for (const std::string& name : features_) out_ << "<pFeature>" << name << "</pFeature>";
    out_ << "</Category>" << kTail;
    return out_.str();
  }

 private:
  void feature(std::string_view name) { features_.emplace_back(name); }
  void place(std::uint32_t address, int length, std::string_view access) {
    out_ << "<Address>" << address << "</Address><Length>" << length << "</Length><AccessMode>"
         << access << "</AccessMode><pPort>Device</pPort><Cachable>NoCache</Cachable>";
  }
  void int_register(std::string_view name, std::uint32_t address, std::string_view access,
                    int length) {
    out_ << "<IntReg Name=\"" << name << "Reg\">";
    place(address, length, access);
    out_ << "<Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>\n";
  }

  std::ostringstream out_;
  std::vector<std::string> features_;
};

void common(Description& d) {
  d.text("DeviceVendorName", kVendorName, 32);
  d.text("DeviceModelName", kModelName, 32);
  d.text("DeviceVersion", kDeviceVersion, 32);
  d.real("DeviceTemperature", kTemperature_degC, -50.0, 150.0, "RO");
  d.integer("SensorWidth", kSensorWidth, "", "RO");
  d.integer("SensorHeight", kSensorHeight, "", "RO");
  d.integer("Width", kWidth, "<Min>1</Min><pMax>SensorWidth</pMax>");
  d.integer("Height", kHeight, "<Min>1</Min><pMax>SensorHeight</pMax>");
  d.integer("OffsetX", kOffsetX, "<Min>0</Min><pMax>SensorWidth</pMax>");
  d.integer("OffsetY", kOffsetY, "<Min>0</Min><pMax>SensorHeight</pMax>");
  d.choice("AcquisitionMode", kAcquisitionMode, {{"Continuous", 1}, {"SingleFrame", 2}});
  d.command("AcquisitionStart", kAcquisition, 1);
  d.command("AcquisitionStop", kAcquisition, 0);
  d.choice("TriggerSelector", kTriggerSelector, {{"FrameStart", 0}});
  d.choice("TriggerMode", kTriggerMode, {{"Off", 0}, {"On", 1}});
  d.choice("TriggerActivation", kTriggerActivation,
           {{"RisingEdge", 0}, {"FallingEdge", 1}, {"AnyEdge", 2}});
  d.command("TriggerSoftware", kTriggerSoftware, 1);
  d.choice("ExposureAuto", kExposureAuto, {{"Off", 0}, {"Once", 1}, {"Continuous", 2}});
  d.choice("GainAuto", kGainAuto, {{"Off", 0}, {"Once", 1}, {"Continuous", 2}});
  d.real("Gain", kGain_dB, 0.0, 24.0);
}

void formats(Description& d, std::string_view rgb, std::string_view bgr) {
  d.choice("PixelFormat", kPixelFormat,
           {{"Mono8", kMono8},
            {"BayerGR8", kBayerGR8},
            {"BayerRG8", kBayerRG8},
            {"BayerGB8", kBayerGB8},
            {"BayerBG8", kBayerBG8},
            {rgb, kRGB8},
            {bgr, kBGR8}});
}

void gt1290c(Description& d) {
  formats(d, "RGB8Packed", "BGR8Packed");
  d.real("ExposureTimeAbs", kExposure_us, 10.0, 1e7);
  d.real("AcquisitionFrameRateAbs", kFrameRate_hz, 0.1, 100.0);
  d.real("TriggerDelayAbs", kTriggerDelay_us, 0.0, 1e6);
  d.choice("TriggerSource", kTriggerSource,
           {{"Freerun", kFreerun},
            {"Line1", 1},
            {"Line2", 2},
            {"Line3", 3},
            {"Line4", 4},
            {"FixedRate", kFixedRate},
            {"Software", kSoftware}});
  d.choice("PtpMode", kPtpMode, {{"Off", 0}, {"Slave", 1}, {"Master", 2}, {"Auto", 3}});
  d.choice("PtpStatus", kPtpStatus,
           {{"Off", kPtpOff}, {"Syncing", kPtpSyncing}, {"Slave", kPtpSlave}}, "RO");
  d.integer("StreamBytesPerSecond", kStreamBytesPerSecond,
            "<Min>1000000</Min><Max>124000000</Max>");
  d.command("GevTimestampControlLatch", kTimestampControl, kLatch);
  d.integer("GevTimestampValue", kTimestampHigh, "", "RO", 8);
}

void sfnc(Description& d) {
  formats(d, "RGB8", "BGR8");
  d.real("ExposureTime", kExposure_us, 10.0, 1e7);
  d.real("AcquisitionFrameRate", kFrameRate_hz, 0.1, 100.0);
  d.flag("AcquisitionFrameRateEnable", kFrameRateEnable);
  d.real("TriggerDelay", kTriggerDelay_us, 0.0, 1e6);
  d.choice("TriggerSource", kTriggerSource,
           {{"Line1", 1}, {"Line2", 2}, {"Line3", 3}, {"Line4", 4}, {"Software", kSoftware}});
  d.flag("PtpEnable", kPtpMode);
  d.choice("PtpStatus", kPtpStatus,
           {{"Disabled", kPtpOff}, {"Uncalibrated", kPtpSyncing}, {"Slave", kPtpSlave}}, "RO");
}

}  // namespace

std::string description(FeatureNames names) {
  Description d;
  common(d);
  names == FeatureNames::kGt1290c ? gt1290c(d) : sfnc(d);
  return d.finish();
}

}  // namespace ols::sim::gige
