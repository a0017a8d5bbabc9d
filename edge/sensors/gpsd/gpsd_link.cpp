#include "edge/sensors/gpsd/gpsd_link.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

namespace ols::sensors {

namespace {

bool is_active(const devconfig_t& device) { return device.activated.tv_sec > 0; }

bool is_this_host(const std::string& host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

GpsdLink::GpsdLink(const std::string& host, const std::string& port)
    : data_(std::make_unique<gps_data_t>()), is_local_(is_this_host(host)) {
  const std::string where = host + ":" + port;
  if (gps_open(host.c_str(), port.c_str(), data_.get()) != 0) {
    throw std::runtime_error("no gpsd at " + where + ": " + gps_errstr(errno));
  }
  if (gps_stream(data_.get(), WATCH_ENABLE | WATCH_JSON, nullptr) < 0) {
    gps_close(data_.get());
    throw std::runtime_error("gpsd at " + where + " refuses the request");
  }
}

GpsdLink::~GpsdLink() { gps_close(data_.get()); }

bool GpsdLink::read(double timeout_s) {
  errno = 0;
  if (!gps_waiting(data_.get(), static_cast<int>(timeout_s * 1e6))) return false;
  data_->set = 0;  // libgps adds to it
  errno = 0;
  if (gps_read(data_.get(), nullptr, 0) < 0) {
    // A message that libgps cannot parse does not end the connection.
    if ((data_->set & PACKET_SET) != 0) return false;
    throw std::runtime_error("gpsd has closed the connection");
  }
  if ((data_->set & PACKET_SET) == 0) return false;
  note_devices();
  return true;
}

void GpsdLink::note_devices() {
  const devconfig_t* active = nullptr;
  if ((data_->set & DEVICELIST_SET) != 0) {
    const auto* list = data_->devices.list;
    const auto* end = list + std::clamp(data_->devices.ndevices, 0, MAXUSERDEVS);
    active = std::find_if(list, end, is_active);
    has_receiver_ = active != end;
  } else if ((data_->set & DEVICE_SET) != 0) {
    active = &data_->dev;
    has_receiver_ = is_active(data_->dev);
  }
  if (active != nullptr && has_receiver_) device_ = active->path;
}

GpsdLink::Silence GpsdLink::silence() const {
  if (!has_receiver_) return Silence::kNoReceiver;
  const bool missing = is_local_ && !device_.empty() && ::access(device_.c_str(), F_OK) != 0;
  return missing ? Silence::kDeviceMissing : Silence::kReceiverSilent;
}

}  // namespace ols::sensors
