// The site's settings of a process: from the file at the centre or from the bus, whichever has the
// higher number. Reads and writes their files, and reports settings that it refused.
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
  std::string kept;   // the newest received ones, for the next start; empty: not kept
};

class SiteKeeper {
 public:
  // Reads both files; trouble() names an unusable one. `check`: whether this program can use the
  // settings; none: it only passes them on.
  SiteKeeper(const PublicKey& root, SiteFiles files, SettingsCheck check);

  SiteSettings settings() const;
  std::int64_t number() const;
  // From the bus.
  void hear(const std::string& text);
  // Reads the given file again, and writes the kept one if there are new settings. Call from one
  // thread.
  void look();

  // The settings, when it is time to publish them again.
  std::optional<std::string> to_tell(double now_s);
  static constexpr double kTell_s = 2.0;

  // Why settings offered recently were not adopted; empty: they were adopted, or none were offered.
  Alarm trouble() const;

 private:
  void offer(const std::string& text, const std::string& name);
  void read_given();

  const PublicKey root_;
  const SiteFiles files_;
  const SettingsCheck check_;
  std::string read_;          // from the given file; only for the thread that looks
  std::int64_t written_ = 0;  // number of the kept settings; likewise
  mutable std::mutex mutex_;  // guards the following
  SiteSettings settings_;
  std::int64_t highest_ = 0;  // highest number signed by the root, usable or not
  std::string text_;          // of `settings_`, as signed
  std::string file_trouble_, heard_trouble_;
  int calm_ = 0;  // consecutive good messages
  double tell_s_ = 0.0;
};

}  // namespace ols::trust
