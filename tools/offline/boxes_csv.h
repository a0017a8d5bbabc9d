// Writes boxes.csv, with the columns frame,x,y,w,h,belief,state.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <ostream>
#include <string_view>

namespace ols::offline {

struct BoxRow {
  long frame = 0;                 // from 0
  std::optional<cv::Rect2d> box;  // [px] top-left corner and size; nullopt when lost
  double belief = 0.0;
  std::string_view state;  // tracking, coasting, lost
};

void write_boxes_header(std::ostream& out);
void write_box(std::ostream& out, const BoxRow& row);

}  // namespace ols::offline
