// Holds a GLib error and converts it to an exception.
#pragma once

#include <arv.h>

#include <string>

#include "edge/camera/camera_errors.h"

namespace ols::camera {

class AravisError {
 public:
  AravisError() = default;
  ~AravisError() { clear(); }
  AravisError(const AravisError&) = delete;
  AravisError& operator=(const AravisError&) = delete;

  // The GError** argument for the next call; clears the previous error.
  GError** out() {
    clear();
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const { return error_ != nullptr ? error_->message : "unknown error"; }
  template <typename Exception>
  void check(const Alarm& alarm) const {
    if (error_ != nullptr) throw Exception(alarm.with_detail(error_->message));
  }

 private:
  void clear() { g_clear_error(&error_); }
  GError* error_ = nullptr;
};

}  // namespace ols::camera
