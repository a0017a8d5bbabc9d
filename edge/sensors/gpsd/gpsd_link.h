// A connection to gpsd through libgps; the destructor closes it.
#pragma once

#include <gps.h>

#include <memory>
#include <string>

namespace ols::sensors {

class GpsdLink {
 public:
  // Connects and requests reports. Throws std::runtime_error if this fails.
  GpsdLink(const std::string& host, const std::string& port);
  ~GpsdLink();
  GpsdLink(const GpsdLink&) = delete;
  GpsdLink& operator=(const GpsdLink&) = delete;

  // Waits at most `timeout_s` for the next message. data() then contains it, and data().set states
  // its type. Returns false on timeout, or for a message that libgps cannot parse. Throws
  // std::runtime_error if gpsd has closed the connection.
  bool read(double timeout_s);
  const gps_data_t& data() const { return *data_; }

  // The probable reason if no reports come, from gpsd's messages about its devices and the
  // existence of the device file.
  enum class Silence { kNoReceiver, kDeviceMissing, kReceiverSilent };
  Silence silence() const;

 private:
  void note_devices();

  std::unique_ptr<gps_data_t> data_;
  bool is_local_;
  bool has_receiver_ = false;
  std::string device_;  // the receiver's device on gpsd's host
};

}  // namespace ols::sensors
