#include "edge/video/h264_encoder.h"

#include <wels/codec_api.h>

#include <cmath>

namespace ols::video {
namespace {

// The quantiser at which H.264 is as true to the picture as JPEG of this quality.
int quantiser(int quality) {
  constexpr double kAtBest = 12.0, kAtWorst = 44.0;
  return static_cast<int>(std::lround(kAtWorst + (kAtBest - kAtWorst) * quality / 100.0));
}

SEncParamExt parameters(ISVCEncoder& encoder, const cv::Size& size, int quality) {
  SEncParamExt p;
  encoder.GetDefaultParams(&p);
  p.iUsageType = CAMERA_VIDEO_REAL_TIME;
  p.iPicWidth = size.width;
  p.iPicHeight = size.height;
  p.fMaxFrameRate = 30.0F;
  // A constant quantiser: over a link that is too thin the viewer asks less often.
  p.iRCMode = RC_OFF_MODE;
  p.bEnableFrameSkip = false;
  p.uiIntraPeriod = 0;  // key frames come when they are asked for
  p.eSpsPpsIdStrategy = CONSTANT_ID;
  p.iMultipleThreadIdc = 1;
  p.bEnableSceneChangeDetect = false;
  // It would leave a target of a few pixels out as noise of the background.
  p.bEnableBackgroundDetection = false;
  p.bEnableDenoise = false;
  p.bEnableAdaptiveQuant = false;
  SSpatialLayerConfig& layer = p.sSpatialLayers[0];
  layer.iVideoWidth = size.width;
  layer.iVideoHeight = size.height;
  layer.fFrameRate = p.fMaxFrameRate;
  // Of the other profiles some decoders hold each picture back until the next one has come.
  layer.uiProfileIdc = PRO_BASELINE;
  layer.iDLayerQp = quantiser(quality);
  layer.sSliceArgument.uiSliceMode = SM_SINGLE_SLICE;
  // A camera's grey has 256 steps, a television's 220.
  layer.bVideoSignalTypePresent = true;
  layer.uiVideoFormat = VF_UNDEF;
  layer.bFullRange = true;
  return p;
}

}  // namespace

void H264Encoder::Destroy::operator()(ISVCEncoder* encoder) const {
  encoder->Uninitialize();
  WelsDestroySVCEncoder(encoder);
}

bool H264Encoder::open(const cv::Size& size, int quality) {
  encoder_.reset();
  ISVCEncoder* made = nullptr;
  if (WelsCreateSVCEncoder(&made) != 0 || made == nullptr) return false;
  encoder_.reset(made);
  int silent = WELS_LOG_QUIET;
  encoder_->SetOption(ENCODER_OPTION_TRACE_LEVEL, &silent);
  const SEncParamExt wanted = parameters(*encoder_, size, quality);
  if (encoder_->InitializeExt(&wanted) != 0) {
    encoder_.reset();
    return false;
  }
  size_ = size;
  quality_ = quality;
  no_colour_.assign(static_cast<std::size_t>(size.area() / 4), 128);
  return true;
}

std::vector<std::uint8_t> H264Encoder::encode(const cv::Mat& gray, int quality, bool key_frame,
                                              std::int64_t utime_us) {
  const bool is_same = encoder_ && size_ == gray.size() && quality_ == quality;
  if (!is_same && !open(gray.size(), quality)) return {};
  if (is_same && key_frame) encoder_->ForceIntraFrame(true);
  SSourcePicture picture{};
  picture.iColorFormat = videoFormatI420;
  picture.iPicWidth = gray.cols;
  picture.iPicHeight = gray.rows;
  picture.uiTimeStamp = utime_us / 1000;
  picture.iStride[0] = static_cast<int>(gray.step);
  picture.iStride[1] = picture.iStride[2] = gray.cols / 2;
  picture.pData[0] = gray.data;
  picture.pData[1] = picture.pData[2] = no_colour_.data();
  SFrameBSInfo coded{};
  if (encoder_->EncodeFrame(&picture, &coded) != cmResultSuccess) return {};
  std::vector<std::uint8_t> unit;
  for (int i = 0; i < coded.iLayerNum; ++i) {
    const SLayerBSInfo& layer = coded.sLayerInfo[i];
    std::size_t length = 0;
    for (int j = 0; j < layer.iNalCount; ++j) {
      length += static_cast<std::size_t>(layer.pNalLengthInByte[j]);
    }
    unit.insert(unit.end(), layer.pBsBuf, layer.pBsBuf + length);
  }
  return unit;
}

}  // namespace ols::video
