// What a station writes into its journal: each thing when it comes up and when it ends, but no
// flood of the same thing. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ols::station {

struct News {
  std::string key;  // what it is about: things of the same key are counted together
  std::string text;
  bool bad = false;
};

struct JournalLine {
  std::string text;
  bool bad = false;
};

class Journal {
 public:
  // What is to be written now. The first kBurst lines of a key in a kWindow_s are; of what follows
  // the last one is told when it is over, with how many were left out, so that the end of a thing
  // is never kept back for good. To be called also when there is nothing new. `now_s`: monotonic.
  std::vector<JournalLine> pass(const std::vector<News>& news, double now_s);

  static constexpr int kBurst = 4;
  static constexpr double kWindow_s = 60.0;

 private:
  struct Told {
    double since_s = 0.0;
    int lines = 0;
    std::optional<News> held;
    std::uint64_t left_out = 0;
  };
  std::map<std::string, Told> told_;
};

}  // namespace ols::station
