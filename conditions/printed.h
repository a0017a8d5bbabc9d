// Makes a text with printf's format. Pure.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace ols {

// The text is cut after 999 bytes.
[[gnu::format(printf, 1, 2)]] inline std::string printed(const char* format, ...) {
  char text[1000];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

}  // namespace ols
