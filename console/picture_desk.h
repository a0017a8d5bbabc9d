// The pictures that the console has, and which of them a browser is to be sent next: of each
// station the newest, never a queue. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "console/heard.h"
#include "console/under_way.h"
#include "console/unit_chain.h"

namespace ols::console {

class PictureDesk {
 public:
  // What a browser looks at, and the number of what it was sent last of each station.
  struct View {
    std::set<std::string> watched;
    Codec codec = Codec::kJpeg;
    std::map<std::string, std::uint64_t> sent;
    UnderWay under_way = {};
  };

  void hear(Picture picture);
  // Of the stations with a new picture the one that was sent longest ago: over a slow link each
  // gets its turn. The message's bytes, docs/console.md; empty: nothing new.
  std::optional<std::string> next(View& view) const;
  void keep_only(const std::function<bool(const std::string&)>& is_known);

  // The newest single picture of each station; and these in the place of all that there are.
  std::map<std::string, Picture> newest() const;
  void show(const std::map<std::string, Picture>& pictures);

 private:
  struct Kept {
    Picture picture;
    std::uint64_t number = 0;
  };

  const UnitChain* stream_for(const View& view, const std::string& station) const;
  std::uint64_t number_for(const View& view, const std::string& station) const;

  std::map<std::string, Kept> kept_;
  std::map<std::string, UnitChain> streams_;
  std::uint64_t numbers_ = 0;
};

}  // namespace ols::console
