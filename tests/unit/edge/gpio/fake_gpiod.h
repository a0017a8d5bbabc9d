// A fake GPIO chip: the functions of libgpiod 1.6 that the product calls, linked in place of the
// library. The tests need no machine with a real chip.
#pragma once

#include <gpiod.h>

#include <map>
#include <string>

namespace ols::fake {

struct Line {
  int offset = 0;
  bool output = false;
  int flags = 0;
  int value = 0;
  int read_end = -1, write_end = -1;  // of the pipe for events, while the line is watched
};

struct Chip {
  std::string path = "/dev/gpiochip9";
  int lines = 32;
  bool gone = false;     // the chip has disappeared after it was opened
  bool refuses = false;  // refuses requests as busy
  int open = 0;          // how many times it is open
  std::map<int, Line> requested;

  // Changes an input's level, with an edge event at CLOCK_MONOTONIC `time_s`. change_unnoticed():
  // without the event, as if it were lost.
  void change(int offset, int value, double time_s);
  void change_unnoticed(int offset, int value) { requested.at(offset).value = value; }
};

Chip& chip();  // the only one

}  // namespace ols::fake
