// Signs the messages that a process sends and verifies those that it receives. Holds the process's
// key, the site's trust list and settings, and the marks against replays (replay_marks.h). Its own
// thread reads and writes the files, so that no control loop waits for a disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/trust/key_file.h"
#include "base/trust/marks_file.h"
#include "base/trust/site_keeper.h"
#include "base/trust/station_boots.h"
#include "base/trust/trust_config.h"
#include "base/trust/verifier.h"
#include "conditions/alarm.h"

namespace ols::trust {

// The process as a member of the site.
struct Self {
  std::string name{};  // also the name of its key file, unless the configuration names another file
  std::int64_t boot_id = 0;  // stated in the messages that it sends
  bool is_station = false;   // commands to this station must name `boot_id`
  bool commands = false;     // shows and commands stations; therefore it accepts the statuses of
                             // stations with a wrong clock, too
  bool tells_list = false;   // publishes the trust list and the site's settings
  bool keeps_marks = false;  // its marks against replays survive a restart
  SettingsCheck settings{};  // checks the site's settings; empty: the process does not use the
                             // settings, it only passes them on
  // Called with each trust list that is adopted, from any thread.
  std::function<void(const TrustList&)> list_taken{};
};

// The verdict on a received message.
struct Judgement {
  Bytes payload;  // without the trailer
  bool passes = true;
  bool addressed = true;               // for a command: whether it names this boot, where that is
                                       // required
  std::optional<Distrust> distrust{};  // why verification failed; also set and counted in mode
                                       // observe, where the message passes
  std::string sender{};                // the member that signed it, if the key is known
  std::int64_t list_number = 0;        // number of the trust list by which it was judged
};

Environment process_environment();

// The site's settings with which this process starts, before any arrive over the bus. Number 0:
// mode off, no settings, or no usable key.
SiteSettings settings_at_start(const TrustConfig& config, const Environment& environment,
                               const std::string& name, const SettingsCheck& check);

class BusTrust {
 public:
  // Null in mode off. Throws ConfigError if the key or the list cannot be used. A new member has no
  // list: unless the configuration names one, it learns its first list from the bus.
  static std::shared_ptr<BusTrust> open(const TrustConfig& config, const Environment& environment,
                                        const Self& self);
  ~BusTrust();

  // Returns payload and trailer. The trailer of a command names the boot of the addressed station,
  // if that is known.
  std::vector<std::uint8_t> sign(const std::string& channel, Bytes payload);
  // Whether BusTrust itself needs the messages of this channel, even if the process has not
  // subscribed to it. Every process needs the trust list and the site's settings. A process that is
  // not a station also needs the stations' statuses and replies, because they state the stations'
  // boot ids.
  bool wants(std::string_view channel) const;
  // Verifies a received message. Called from the receiving thread.
  Judgement judge(std::string_view channel, Bytes message, std::int64_t utime_us, double now_s);

  // The list or the settings, when they are due for publication; otherwise nullopt. Only the centre
  // (tells_list) publishes the settings. The centre also publishes the list; any other process does
  // so only after a member has published an older list. The reason: a centre that was restored from
  // a backup does not know which keys were revoked.
  std::optional<std::string> list_to_tell(double now_s);
  std::optional<std::string> settings_to_tell(double now_s);
  static constexpr double kTell_s = 2.0;
  // The list in force and its number. A logger keeps them beside its logs.
  std::string list_text() const;
  std::int64_t list_number() const;
  // The stations enrolled by the list in force.
  std::vector<std::string> stations() const;
  // The list as a signed message of this member, for kTrustChannel. nullopt if there is no list, or
  // if this process is not a member: nobody would accept the message.
  std::optional<std::vector<std::uint8_t>> list_telling(std::int64_t utime_us);
  std::int64_t site_settings_number() const { return site_.number(); }

  std::int64_t boot_id() const { return self_.boot_id; }
  // What a person should correct; empty alarm: nothing.
  Alarm trouble() const;

 private:
  BusTrust(Mode mode, const TrustConfig& config, const Environment& environment, const Self& self);

  void begin();
  // Takes a list. Returns whether it is newer and now in force. Throws ConfigError.
  bool offer(const std::string& text, const std::string& name);
  bool adopt(const TrustList& list, const std::string& text);
  bool replace(const TrustList& list, const std::string& text);
  bool is_of_site(std::string_view channel, Bytes message) const;
  // Takes a list from the bus. Returns whether it is newer and now in force.
  bool hear_list(Bytes payload, bool from_member, double now_s);
  void watch();
  void look_at_file();
  void keep();
  const Member* own_entry() const;
  Alarm membership_trouble() const;
  struct Learned {
    Verifier::Verdict verdict;
    std::int64_t list_number = 0;
  };
  Learned judge_and_learn(std::string_view channel, Bytes message, const Arrival& arrival);

  struct Key {
    explicit Key(const MemberKey& member) : file(member), signing(member.seed) {}
    MemberKey file;
    SigningKey signing;
  };
  struct Files {
    std::string list;            // the list's path, as configured or by default
    bool must_be_there = false;  // the configuration names it
    std::string kept_list;       // path for the newest list received; empty: it is not kept
    std::string read;            // the text last read from `list`
    std::int64_t number = 0;     // number of the list that was kept last
  };

  const Mode mode_;
  const Self self_;
  const Key key_;
  const std::int64_t tolerance_us_;
  SiteKeeper site_;
  MarksFile marks_file_;
  Files files_;               // used only by the thread, once it runs
  mutable std::mutex mutex_;  // guards the following
  TrustList list_;
  std::string text_;
  struct Trouble {
    std::string file, keeping;
  };
  Trouble trouble_;
  std::optional<Verifier> verifier_;
  StationBoots boots_;
  struct Telling {
    double due_s = 0.0;
    bool answers = false;      // a member has sent an older list
    RateLimit strangers{5.0};  // limits how many messages of non-members are verified, so that
                               // members' messages need not wait
  };
  Telling telling_;  // publication of the list
  struct Watcher {
    bool ends = false;
    std::condition_variable end;
    std::thread thread;
  };
  Watcher watcher_;
};

}  // namespace ols::trust
