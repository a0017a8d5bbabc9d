// What a browser was sent but has not processed yet: the site's state, and pictures of stations. At
// most one state and one picture of each station are under way. Otherwise messages would pile up in
// a browser that processes them more slowly than they arrive. A slow browser gets fewer messages,
// but no old ones. Pure.
#pragma once

#include <set>
#include <string>

namespace ols::console {

class UnderWay {
 public:
  static constexpr const char* kState = "";  // stands for the state, because no station's name is
                                             // empty

  void sent(const std::string& thing) { things_.insert(thing); }
  // Call when the browser reports that it has processed this. A browser that never reports it is
  // sent everything as fast as its connection allows.
  void taken(const std::string& thing) {
    is_paced_ = true;
    things_.erase(thing);
  }
  bool may(const std::string& thing) const { return !is_paced_ || !things_.contains(thing); }

 private:
  std::set<std::string> things_;
  bool is_paced_ = false;
};

}  // namespace ols::console
