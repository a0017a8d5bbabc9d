// The site's settings as a process has them: from the file at the centre or from the bus, whichever
// has the higher number. Reads and writes their files, and says which it refused.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "base/trust/site_settings.h"

namespace ols::trust {

struct SiteFiles {
  std::string given;  // at the centre: the settings to publish; the file need not exist
  std::string kept;   // the newest received, for the next start; empty: not kept
};

class SiteKeeper {
 public:
  // Reads both files; trouble() names one that cannot be used. `check`: whether this program can
  // use the settings; none: it only passes them on.
  SiteKeeper(const PublicKey& root, SiteFiles files, SettingsCheck check);

  SiteSettings settings() const;
  std::int64_t number() const;
  // From the bus.
  void hear(const std::string& text);
  // The given file again, and the kept one if something new was heard. From one thread.
  void look();

  // When it is time to tell them again.
  std::optional<std::string> to_tell(double now_s);
  static constexpr double kTell_s = 2.0;

  // Why settings that were offered lately are not taken; empty: they are, or there were none.
  std::string trouble() const;

 private:
  void offer(const std::string& text, const std::string& name);
  void read_given();

  const PublicKey root_;
  const SiteFiles files_;
  const SettingsCheck check_;
  std::string read_;          // from the given file; of the thread that looks
  std::int64_t written_ = 0;  // number of the kept ones; likewise
  mutable std::mutex mutex_;  // of what follows
  SiteSettings settings_;
  std::int64_t highest_ = 0;  // number that the root has signed, whether it could be used or not
  std::string text_;          // of `settings_`, as signed
  std::string file_trouble_, heard_trouble_;
  int calm_ = 0;  // tellings in a row that were good
  double tell_s_ = 0.0;
};

}  // namespace ols::trust
