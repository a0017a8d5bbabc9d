#include "tools/offline/boxes_csv.h"

#include <array>

#include "conditions/printed.h"

namespace ols::offline {

void write_boxes_header(std::ostream& out) { out << "frame,x,y,w,h,belief,state\n"; }

void write_box(std::ostream& out, const BoxRow& row) {
  const auto box = row.box ? printed("%.3f,%.3f,%.3f,%.3f", row.box->x, row.box->y, row.box->width,
                                     row.box->height)
                           : ",,,";
  out << row.frame << ',' << box << printed(",%.4f,", row.belief) << row.state << '\n';
}

}  // namespace ols::offline
