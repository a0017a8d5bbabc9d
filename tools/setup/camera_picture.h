// Shows a person the picture of the camera that ols-setup has chosen.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "tools/setup/flat_toml.h"
#include "tools/setup/host.h"

namespace ols::setup {

// The picture as text for a terminal with 256 colours: each character is two pixels high
// (U+2580). `columns`: of the terminal. Pure.
std::string half_blocks(const cv::Mat& gray, int columns);

// Opens the camera of the answers by the station's own driver, and writes its picture to
// NAME-camera.jpg in the working folder. Draws it, too, if the output is a terminal. Prints why
// there is no picture: that is no reason to stop.
void show_picture(const Host& host, const std::string& station, const Values& values);

}  // namespace ols::setup
