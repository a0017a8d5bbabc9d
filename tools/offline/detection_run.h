// Detects everything that flies or moves in a clip and writes detections.csv.
#pragma once

#include <string>

namespace ols::offline {

struct DetectionArguments {
  std::string input;  // as FrameSource takes it
  // CSV files with these columns:
  std::string mount;   // frame,azimuth_deg,elevation_deg,hfov_deg; empty: the camera's motion is
                       // measured from the images alone
  std::string output;  // frame,id,x,y,w,h [px],confidence [0..1],class
  std::string timing;  // frame,total_ms; empty: none
  double false_an_hour = 1.0;  // allowed number of false objects per hour
};

// Throws what FrameSource and AtomicFile throw, and std::runtime_error for a wrong mount file.
void run_detection(const DetectionArguments& arguments);

}  // namespace ols::offline
