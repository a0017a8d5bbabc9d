// Runs the detector of flying and moving objects on a clip and writes detections.csv.
#pragma once

#include <string>

namespace ols::offline {

struct DetectionArguments {
  std::string input;  // a path or pattern as for FrameSource
  // CSV files with these columns:
  std::string mount;   // frame,azimuth_deg,elevation_deg,hfov_deg; empty: the images alone give the
                       // camera's motion
  std::string output;  // frame,id,x,y,w,h [px],confidence [0..1],class
  std::string timing;  // frame,total_ms; empty: none
  double false_an_hour = 1.0;  // allowed number of false objects per hour
};

// Throws the exceptions of FrameSource and AtomicFile, and std::runtime_error if the mount file is
// wrong.
void run_detection(const DetectionArguments& arguments);

}  // namespace ols::offline
