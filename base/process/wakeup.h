// Wakes another thread from poll(): the descriptor stays readable from set() until clear().
#pragma once

namespace ols {

class Wakeup {
 public:
  Wakeup();  // throws std::system_error
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;
  void set();
  void clear();
  int descriptor() const { return fd_; }  // readable while set

 private:
  int fd_;
};

}  // namespace ols
