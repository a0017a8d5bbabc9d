// The common part of all mounts that obey velocities or positions and report positions with a
// delay. Drive chooses the next order. The session, which differs from kind to kind, connects,
// sends the orders and reads the positions.
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

// The data that a session shares with the callers of the mount. The mutex guards all members.
struct SharedDrive {
  std::mutex mutex;
  std::condition_variable_any wake;  // notified in an emergency
  Drive drive;
  bool usable = true;          // false: the reported angles must not be used
  std::string words;           // description of the mount and its capabilities
  std::string serial;          // serial number of the mount; empty if it states none
  std::string last_error;      // empty if there was none
  std::vector<Alarm> alarms;   // of this kind of mount
  std::optional<Alarm> fault;  // why the session does not connect at present
  std::uint64_t orders = 0, errors = 0;
  std::map<std::string, std::uint64_t> counters;  // of this kind of mount

  explicit SharedDrive(const DriveConfig& config) : drive(config) {}
  // Waits for `seconds`. Ends earlier in an emergency, or when the end of the thread is requested
  // (`stop`).
  void pause(double seconds, const std::stop_token& stop);
};

class MountSession {
 public:
  MountSession() = default;
  virtual ~MountSession() = default;
  MountSession(const MountSession&) = delete;
  MountSession& operator=(const MountSession&) = delete;

  // Connects, calls Drive::connected() and thread.opened(), and serves the mount until the end of
  // the thread is requested (`stop`); then it halts the mount. Throws std::exception if the
  // connection fails; run() is then called again after a pause.
  virtual void run(SharedDrive& shared, device::DeviceThread& thread,
                   const std::stop_token& stop) = 0;
  // Interrupts the current request, so that a stop can follow at once. May be called from any
  // thread.
  virtual void interrupt() {}
};

Traits driven_traits(const DriveConfig& config);

class DrivenMount : public Mount {
 public:
  // Starts the thread, which connects to the mount, and returns at once.
  DrivenMount(const DriveConfig& config, std::unique_ptr<MountSession> session);
  ~DrivenMount() override;  // waits until the session has halted the mount and ended

  void set_goal(const std::optional<Goal>& goal) override;
  std::vector<AngleSample> take_samples() override;
  void see(const SeenTurn& turn) override;
  std::optional<Limits> limits() const override;

  void emergency_halt() override;
  void clear_emergency() override;

  // These mounts do not home, because they have no reference that could be lost.
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
  device::DeviceThread thread_;  // last member, because it uses the others
};

}  // namespace ols::mount
