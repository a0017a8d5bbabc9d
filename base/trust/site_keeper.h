// Holds a process's copy of the site's settings. Takes them from a file of the centre or from the
// bus, whichever has the higher number. Reads and writes the files, and reports refused settings.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "base/trust/site_settings.h"
#include "conditions/alarm.h"

namespace ols::trust {

struct SiteFiles {
  std::string given;  // at the centre: the settings to publish; the file need not exist
  std::string kept;   // the newest settings received, for the next start; empty: not kept
};

class SiteKeeper {
 public:
  // Reads both files; trouble() names a file that cannot be used. `check`: throws if this program
  // cannot use the settings; empty: it does not use them, and only passes them on.
  SiteKeeper(const PublicKey& root, SiteFiles files, SettingsCheck check);

  SiteSettings settings() const;
  std::int64_t number() const;
  // Takes a settings text from the bus.
  void hear(const std::string& text);
  // Reads the file `given` again, and writes the file `kept` if there are new settings. Call always
  // from the same thread.
  void look();

  // The settings text, when it is due for publication; otherwise nullopt.
  std::optional<std::string> to_tell(double now_s);
  static constexpr double kTell_s = 2.0;

  // Why settings that were offered recently were refused; empty alarm: none were refused.
  Alarm trouble() const;

 private:
  void offer(const std::string& text, const std::string& name);
  void read_given();

  const PublicKey root_;
  const SiteFiles files_;
  const SettingsCheck check_;
  std::string read_;          // text last read from the file `given`; only for the thread that
                              // calls look()
  std::int64_t written_ = 0;  // number of the settings written last; only for the same thread
  mutable std::mutex mutex_;  // guards the following
  SiteSettings settings_;
  std::int64_t highest_ = 0;  // highest number signed by the root, usable or not
  std::string text_;          // the signed text of `settings_`
  std::string file_trouble_, heard_trouble_;
  int calm_ = 0;  // number of consecutive messages that were not refused
  double tell_s_ = 0.0;
};

}  // namespace ols::trust
