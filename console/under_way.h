// What a browser was sent and has not processed yet: the site's state, stations' pictures. At most
// one of each is under way. Otherwise messages would wait in its queue if they are sent faster than
// it processes them. A slow browser gets less, but nothing old. Pure.
#pragma once

#include <set>
#include <string>

namespace ols::console {

class UnderWay {
 public:
  static constexpr const char* kState = "";  // stations' names are not empty

  void sent(const std::string& thing) { things_.insert(thing); }
  // The browser has processed it. A browser that never reports this is sent everything at the pace
  // of its connection.
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
