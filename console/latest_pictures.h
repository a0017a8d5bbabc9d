// The stations' pictures, and which of them a browser receives next. A browser always gets a
// station's newest picture; older pictures are skipped, not queued. Pure.
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
  // What one browser watches, and for each station the number of the last picture that it was sent.
  struct View {
    std::set<std::string> watched;
    Codec codec = Codec::kJpeg;
    std::map<std::string, std::uint64_t> sent;
    UnderWay under_way = {};
  };

  void receive(Picture picture);
  // The message (docs/console.md) with the next picture for this browser; nullopt: nothing new. Of
  // all stations with a new picture, it is the one whose last picture was sent longest ago, so that
  // every station gets its turn even over a slow link.
  std::optional<std::string> next(View& view) const;
  void keep_only(const std::function<bool(const std::string&)>& is_known);

  // The newest picture of a station that is coded by itself (JPEG, not H.264); null: there is none.
  const Picture* newest(const std::string& station) const;
  // newest() returns this picture of each station. show() replaces all pictures with these.
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
