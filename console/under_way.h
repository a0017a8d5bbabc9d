// What a browser was sent and has not taken yet: the state of the site, pictures of stations. Of
// each at most one is under way, so that a browser that is slower than the site gets less, and
// nothing old: what is sent faster than it is taken waits in its queue. Pure.
#pragma once

#include <set>
#include <string>

namespace ols::console {

class UnderWay {
 public:
  static constexpr const char* kState = "";  // stations' names are not empty

  void sent(const std::string& thing) { things_.insert(thing); }
  // As the browser says. One that never says so is sent everything at the pace of its connection.
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
