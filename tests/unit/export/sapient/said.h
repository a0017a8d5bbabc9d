// Parses a framed SAPIENT message.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "export/sapient/frame.h"
#include "sapient/sapient.pb.h"

namespace ols::exports {

inline sapient::SapientMessage said(const std::string& bytes) {
  sapient::SapientMessage message;
  EXPECT_EQ(framed_length(bytes), bytes.size() - kFrameHead_bytes);
  EXPECT_TRUE(message.ParseFromString(bytes.substr(kFrameHead_bytes)));
  return message;
}

}  // namespace ols::exports
