// The page's files, embedded in the program. console/page/build makes them from its sources.
#pragma once

#include <string_view>

namespace ols::console {

struct PageFile {
  std::string_view path;  // "/page.js"
  std::string_view content_type;
  std::string_view gzipped;
};

// Null if there is no such file. "/" is "/index.html".
const PageFile* page_file_at(std::string_view path);

}  // namespace ols::console
