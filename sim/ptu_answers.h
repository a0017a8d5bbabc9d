// What the simulated PTU says to queries: the texts of the PTU-D46's manual and of transcripts of
// real units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/ptu_motion.h"
#include "sim/ptu_setup.h"

namespace ols::sim {

class PtuAnswers {
 public:
  // Both must outlive it.
  PtuAnswers(const PtuUnitConfig& config, const PtuSetup& setup, const PtuMotion& motion)
      : config_(config), setup_(setup), motion_(motion) {}

  // Of one axis: the number alone, and in the words that are set. `what`: one of PORNXSDABUL.
  std::string number(int axis, char what, double time_s) const;
  std::string query(int axis, char what, double time_s) const;

  // The answer; nothing: the command does not ask what kind of unit it is.
  std::optional<std::string> information(std::string_view command) const;
  // What it says before it is ready.
  std::string banner() const;
  // Its firmware knows the commands of presets.
  bool has_presets() const;

 private:
  bool e_series() const { return config_.model == PtuModel::kE46; }
  std::string firmware() const;
  std::string version() const;

  PtuUnitConfig config_;
  const PtuSetup& setup_;
  const PtuMotion& motion_;
};

}  // namespace ols::sim
