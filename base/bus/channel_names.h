// The channels of the bus. lcmtypes/ defines the messages on each.
#pragma once

#include <string>
#include <string_view>

namespace ols {

// Prefixes. A station's name, appended to a prefix, makes the channel: OLS_PTU_alfa.
inline constexpr std::string_view kBearingChannel = "OLS_BEARING_";
inline constexpr std::string_view kSightingChannel = "OLS_SIGHTING_";
inline constexpr std::string_view kSkylineChannel = "OLS_SKYLINE_";
inline constexpr std::string_view kStatusChannel = "OLS_STATUS_";
inline constexpr std::string_view kReplyChannel = "OLS_REPLY_";
inline constexpr std::string_view kPreviewChannel = "OLS_PREVIEW_";
inline constexpr std::string_view kSlewChannel = "OLS_SLEW_";
inline constexpr std::string_view kOcclusionChannel = "OLS_OCCLUSION_";
inline constexpr std::string_view kPtuChannel = "OLS_PTU_";
inline constexpr std::string_view kLensChannel = "OLS_LENS_";
inline constexpr std::string_view kDesignateChannel = "OLS_DESIGNATE_";
inline constexpr std::string_view kRecordChannel = "OLS_RECORD_";
inline constexpr std::string_view kFrameRequestChannel = "OLS_FRAME_REQUEST_";
inline constexpr std::string_view kFrameChannel = "OLS_FRAME_";
inline constexpr std::string_view kProcedureChannel = "OLS_PROCEDURE_";
inline constexpr std::string_view kProcedureAnswerChannel = "OLS_PROCEDURE_ANSWER_";

// One channel per site.
inline constexpr std::string_view kTargetChannel = "OLS_TARGET";
inline constexpr std::string_view kPaperTargetChannel = "OLS_TARGET_PAPER";
inline constexpr std::string_view kFusionStatusChannel = "OLS_FUSION_STATUS";
inline constexpr std::string_view kIncidentChannel = "OLS_INCIDENT";
inline constexpr std::string_view kCueChannel = "OLS_CUE";
inline constexpr std::string_view kCueOrderChannel = "OLS_CUE_ORDER";
inline constexpr std::string_view kCueReplyChannel = "OLS_CUE_REPLY";

inline std::string station_channel(std::string_view channel, std::string_view station) {
  return std::string(channel).append(station);
}

// The kind of message that a prefix stands for: "PTU" for "OLS_PTU_".
inline std::string message_kind(std::string_view channel) {
  constexpr std::string_view kPrefix = "OLS_";
  return std::string(channel.substr(kPrefix.size(), channel.size() - kPrefix.size() - 1));
}

}  // namespace ols
