#include "tools/offline/boxes_csv.h"

#include <array>
#include <cstdio>

namespace ols::offline {

void write_boxes_header(std::ostream& out) { out << "frame,x,y,w,h,belief,state\n"; }

void write_box(std::ostream& out, const BoxRow& row) {
  std::array<char, 160> text{};
  if (row.box) {
    std::snprintf(text.data(), text.size(), "%ld,%.3f,%.3f,%.3f,%.3f,%.4f,", row.frame, row.box->x,
                  row.box->y, row.box->width, row.box->height, row.belief);
  } else {
    std::snprintf(text.data(), text.size(), "%ld,,,,,%.4f,", row.frame, row.belief);
  }
  out << text.data() << row.state << '\n';
}

}  // namespace ols::offline
