// Signs the messages that a process sends and verifies those that it receives. Holds the process's
// key, the site's trust list and settings, and the marks against replays; a thread of its own reads
// and writes the files, so that no control loop waits for a disk.
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

#include "base/trust/audience_book.h"
#include "base/trust/key_file.h"
#include "base/trust/marks_file.h"
#include "base/trust/site_keeper.h"
#include "base/trust/trust_config.h"
#include "base/trust/verifier.h"

namespace ols::trust {

// The process as a member of the site.
struct Self {
  std::string name{};        // its key's, unless the configuration names a file
  std::int64_t boot_id = 0;  // of what it sends
  bool is_station = false;   // commands to `name` must name this boot
  bool commands = false;     // shows and commands stations, even those whose clock is wrong
  bool tells_list = false;   // passes the trust list on
  bool keeps_marks = false;  // what it has heard outlasts a restart
  SettingsCheck settings{};  // of the site, as this program reads them; none: it passes them on
  // Told each list that is taken, from any thread.
  std::function<void(const TrustList&)> list_taken{};
};

// What becomes of a received message.
struct Judgement {
  Bytes payload;  // without its trailer
  bool passes = true;
  bool addressed = true;               // a command that names this boot, where that is required
  std::optional<Distrust> distrust{};  // counted, in mode observe too
  std::string sender{};                // its member, where its key is known
  std::int64_t list_number = 0;        // of the trust list that it was judged by
};

Environment process_environment();

// The site's settings of this process as it starts, before it has heard any; number 0: none, or no
// key to know the site by.
SiteSettings settings_at_start(const TrustConfig& config, const Environment& environment,
                               const std::string& name, const SettingsCheck& check);

class BusTrust {
 public:
  // Null in mode off. Throws ConfigError if the key or the list cannot be used. Without a list, and
  // none that the configuration names, the first is learned from the bus (a new member).
  static std::shared_ptr<BusTrust> open(const TrustConfig& config, const Environment& environment,
                                        const Self& self);
  ~BusTrust();

  // Payload and trailer. A command names the boot of its station, if that is known.
  std::vector<std::uint8_t> sign(const std::string& channel, Bytes payload);
  // Whether it learns from such messages, even if nobody has subscribed to them: the trust list,
  // and the statuses by which the sender of commands knows the boots.
  bool wants(std::string_view channel) const;
  // From the receiving thread.
  Judgement judge(std::string_view channel, Bytes message, std::int64_t utime_us, double now_s);

  // The list, and the settings, when it is time to tell them again. Who does not pass the list on
  // answers an older one of a member: a centre that was restored does not know what was revoked.
  std::optional<std::string> list_to_tell(double now_s);
  std::optional<std::string> settings_to_tell(double now_s);
  static constexpr double kTell_s = 2.0;
  // The list in force, and its number: for who keeps it beside the logs.
  std::string list_text() const;
  std::int64_t list_number() const;
  // Enrolled, by the list in force.
  std::vector<std::string> stations() const;
  // The list as this member tells it: a signed message for kTrustChannel. Nothing without a list,
  // or if this is no member of it: nobody would believe it.
  std::optional<std::vector<std::uint8_t>> list_telling(std::int64_t utime_us);
  std::int64_t site_settings_number() const { return site_.number(); }

  std::int64_t boot_id() const { return self_.boot_id; }
  // What a person should put right; empty: nothing.
  std::string trouble() const;

 private:
  BusTrust(Mode mode, const TrustConfig& config, const Environment& environment, const Self& self);

  void begin();
  // Whether it is newer and is now in force. Throws ConfigError.
  bool offer(const std::string& text, const std::string& name);
  bool adopt(const TrustList& list, const std::string& text);
  bool replace(const TrustList& list, const std::string& text);
  bool is_of_site(std::string_view channel, Bytes message) const;
  // Whether it is newer and is now in force.
  bool hear_list(Bytes payload, bool from_member, double now_s);
  void watch();
  void look_at_file();
  void keep();
  const Member* own_entry() const;
  std::string membership_trouble() const;
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
    std::string list;            // as configured
    bool must_be_there = false;  // the configuration names it
    std::string kept_list;       // the newest heard; empty: not kept
    std::string read;            // the text that was last read from `list`
    std::int64_t number = 0;     // of the list that was last kept
  };

  const Mode mode_;
  const Self self_;
  const Key key_;
  const std::int64_t tolerance_us_;
  SiteKeeper site_;
  MarksFile marks_file_;
  Files files_;               // of the thread, once it runs
  mutable std::mutex mutex_;  // of what follows
  TrustList list_;
  std::string text_;
  struct Trouble {
    std::string file, keeping;
  };
  Trouble trouble_;
  std::optional<Verifier> verifier_;
  AudienceBook book_;
  struct Telling {
    double due_s = 0.0;
    bool answers = false;      // a member has told an older one
    RateLimit strangers{5.0};  // by who is no member: to verify it must not keep from the members
  };
  Telling telling_;  // of the list
  struct Watcher {
    bool ends = false;
    std::condition_variable end;
    std::thread thread;
  };
  Watcher watcher_;
};

}  // namespace ols::trust
