// The console's pictures, and which one a browser receives next: always the newest of a station;
// nothing queues. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "console/received.h"
#include "console/under_way.h"
#include "console/unit_chain.h"

namespace ols::console {

class LatestPictures {
 public:
  // The stations that a browser watches, and the number of the last picture sent to it for each.
  struct View {
    std::set<std::string> watched;
    Codec codec = Codec::kJpeg;
    std::map<std::string, std::uint64_t> sent;
    UnderWay under_way = {};
  };

  void receive(Picture picture);
  // Of the stations with a new picture, takes the one that was sent longest ago: even over a slow
  // link each gets its turn. Returns the message's bytes (docs/console.md); nullopt: nothing new.
  std::optional<std::string> next(View& view) const;
  void keep_only(const std::function<bool(const std::string&)>& is_known);

  // The newest single picture of a station; null: it has none.
  const Picture* newest(const std::string& station) const;
  // newest(): the newest single picture of each station. show(): replaces all pictures by these.
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
