// The stations' guided procedures (calibrations), for a browser. Their fields are part of the
// site's state. Pictures are fetched separately. An answer is checked against the current question.
// Pure.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conditions/refusal.h"
#include "console/entity_table.h"

namespace ols::console {

struct ReceivedProcedure {
  std::string station;
  Json fields;                       // listed in docs/console.md
  std::int64_t question = 0;         // number of the question; 0: none
  std::vector<std::string> choices;  // of the question
  std::string jpeg;                  // empty: no picture
  bool is_at_work = true;            // false: it has ended
};

struct ProcedureAnswer {
  std::string station;
  std::int64_t question = 0;
  std::string choice;
  std::optional<std::array<double, 2>> pixel_px;  // in the full frame
  std::array<double, 2> turn_deg{};               // of "turn": pan, tilt
};

class Procedures {
 public:
  // Returns the procedure's part of the site's state: its fields, and `picture`, a number that
  // changes with each picture; 0: there is no picture.
  Json receive(ReceivedProcedure heard);
  // The newest picture (JPEG) of a station's procedure; null: there is none.
  const std::string* picture(const std::string& station) const;

  bool has(const std::string& station) const { return kept_.contains(station); }
  // Why this answer is refused; empty: it will be sent. An answer that ends the procedure ("abort")
  // is accepted whatever the question.
  Outcome answer(const ProcedureAnswer& answer);
  // The answers to be sent now.
  std::vector<ProcedureAnswer> take() { return std::exchange(answers_, {}); }

  void keep_only(const std::function<bool(const std::string&)>& is_known);

 private:
  struct Kept {
    ReceivedProcedure heard;
    std::uint64_t picture = 0;
  };
  std::map<std::string, Kept> kept_;
  std::uint64_t pictures_ = 0;
  std::vector<ProcedureAnswer> answers_;
};

}  // namespace ols::console
