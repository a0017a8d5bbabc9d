// The common part of mounts that obey velocities or positions and report their positions late.
// Drive chooses the next order. The session of each kind connects, sends orders and takes
// positions.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/device/device_thread.h"
#include "edge/mount/driven/drive.h"
#include "edge/mount/mount_kind.h"

namespace ols::mount {

// What a session and the callers of a mount share. The mutex guards all of it.
struct SharedDrive {
  std::mutex mutex;
  std::condition_variable_any wake;  // notified in an emergency
  Drive drive;
  bool usable = true;          // false: its angles must not be used, whatever it reports
  std::string words;           // the mount and its capabilities, in words
  std::string last_error;      // empty: none
  std::vector<Alarm> alarms;   // of this kind
  std::optional<Alarm> fault;  // why the session does not connect for now
  std::uint64_t orders = 0, errors = 0;
  std::map<std::string, std::uint64_t> counters;  // of this kind

  explicit SharedDrive(const DriveConfig& config) : drive(config) {}
  // For `seconds`, or until an emergency or the end.
  void pause(double seconds, const std::stop_token& stop);
};

class MountSession {
 public:
  MountSession() = default;
  virtual ~MountSession() = default;
  MountSession(const MountSession&) = delete;
  MountSession& operator=(const MountSession&) = delete;

  // Connects, calls opened(), calls Drive::connected(), and serves until a stop is requested; then
  // it stops the mount. Throws std::exception if the connection fails; it is called again later.
  virtual void run(SharedDrive& shared, device::DeviceThread& thread,
                   const std::stop_token& stop) = 0;
  // Interrupts the order that is being sent, so that a stop can follow at once. Call from any
  // thread.
  virtual void interrupt() {}
};

Traits driven_traits(const DriveConfig& config);

class DrivenMount : public Mount {
 public:
  // Starts to connect and returns at once.
  DrivenMount(const DriveConfig& config, std::unique_ptr<MountSession> session);
  ~DrivenMount() override;  // waits until the session has stopped the mount

  void set_goal(const std::optional<Goal>& goal) override;
  std::vector<AngleSample> take_samples() override;
  std::optional<Limits> limits() const override;

  void emergency_halt() override;
  void clear_emergency() override;

  // Such a mount does not home: it has no reference that could be lost.
  Reference reference() const override;
  void home() override {}
  void stop_homing() override {}
  void allow_rehoming(bool /*allowed*/) override {}
  std::uint64_t homings() const override { return 0; }
  void reference_ok() override {}
  void restore_doubt(const std::optional<ReferenceDoubt>& /*doubt*/) override {}
  std::optional<ReferenceDoubt> doubt_to_persist() const override { return std::nullopt; }

  device::DeviceReport report() const override;

 private:
  bool ready() const;  // the caller holds the mutex

  mutable SharedDrive shared_;
  std::unique_ptr<MountSession> session_;
  device::DeviceThread thread_;  // last: it uses the others
};

}  // namespace ols::mount
