// The files of the web page, embedded in the program. console/page/build makes them from the page's
// sources.
#pragma once

#include <string_view>

namespace ols::console {

struct PageFile {
  std::string_view path;  // "/page.js"
  std::string_view content_type;
  std::string_view gzipped;
};

// The file at this path; null if there is none. "/" means "/index.html".
const PageFile* page_file_at(std::string_view path);

}  // namespace ols::console
