// A GPIO chip in libgpiod's place: the functions of libgpiod 1.6 that the product calls, linked in
// instead of the library, because no machine of ours need have a chip.
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
  int read_end = -1, write_end = -1;  // of events, when watched
};

struct Chip {
  std::string path = "/dev/gpiochip9";
  int lines = 32;
  bool gone = false;     // after it was opened
  bool refuses = false;  // requests: busy
  int open = 0;          // how often it is open
  std::map<int, Line> requested;

  // The input's level with its edge, at CLOCK_MONOTONIC `time_s`; or without, as if it were lost.
  void change(int offset, int value, double time_s);
  void change_unnoticed(int offset, int value) { requested.at(offset).value = value; }
};

Chip& chip();  // the only one

}  // namespace ols::fake
