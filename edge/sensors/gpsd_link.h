// One connection to gpsd: libgps with its C structure kept in order.
#pragma once

#include <gps.h>

#include <memory>
#include <string>

namespace ols {

class GpsdLink {
 public:
  // Connects and asks for reports. Throws std::runtime_error in words.
  GpsdLink(const std::string& host, const std::string& port);
  ~GpsdLink();
  GpsdLink(const GpsdLink&) = delete;
  GpsdLink& operator=(const GpsdLink&) = delete;

  // The next message, after waiting for it at most `timeout_s`; data().set tells which came. False:
  // none came. Throws std::runtime_error when gpsd has gone.
  bool read(double timeout_s);
  const gps_data_t& data() const { return *data_; }

  // Why nothing comes, as far as gpsd has said and can be seen from here.
  enum class Silence { kNoReceiver, kDeviceMissing, kReceiverSilent };
  Silence silence() const;

 private:
  void note_devices();

  std::unique_ptr<gps_data_t> data_;
  bool is_local_;
  bool has_receiver_ = false;
  std::string device_;  // the receiver's, on gpsd's host
};

}  // namespace ols
