// The kinds of events in the journal, each with its message id. An id was drawn at random and never
// changes. systemd/ols.catalog gives the meaning of each and what to do.
#pragma once

#include <string_view>

namespace ols::event {

using Id = std::string_view;

// Events of any program.
inline constexpr Id kReady = "6c6c7a696ae74b13bcabd50544dd7ddf";
inline constexpr Id kStops = "e527ef567db04145be6b3398c804e9b3";
inline constexpr Id kBusLost = "ffc6cad71cd748f58d5ecbdfda7c88e8";
inline constexpr Id kBusConnected = "d9b2637c2fd24c42a55e34b5381885af";
inline constexpr Id kAlarmBegins = "5bbd3dcba0c14f48b1da4c4ded452867";
inline constexpr Id kAlarmEnds = "d1ab66c2e7234b6892f0f240b16f2cf0";
inline constexpr Id kTrustList = "c73317645beb4c4aa2bbf4455df9f4c6";

// Events of a station; all have OLS_STATION.
inline constexpr Id kStationAlarmBegins = "01af4a4837984511b9ae0083c4656141";
inline constexpr Id kStationAlarmEnds = "248deff957a94166a03fd2d47755d795";
inline constexpr Id kEmergencyStop = "7aa3973475004d71ae1b352e4d92576c";
inline constexpr Id kStationState = "4c49e76da4bc4db6b9461b4663c90662";
inline constexpr Id kRearmed = "20e0734b062743858a7c6a5687e45d0a";
inline constexpr Id kCommandRefused = "533c82df71464b4fb195f371a4a8632e";
inline constexpr Id kDeviceLost = "38419914624349dd8744542e0f052918";
inline constexpr Id kDeviceWorks = "b21f5b57eff1479aac8af25949167229";
inline constexpr Id kDeviceError = "0fd2fd8286384b8b94dafd570dcbb7f6";
inline constexpr Id kSiteSettings = "e8e63db719d2471dad671f2a2186705f";

// Events of the centre and of its outside connections.
inline constexpr Id kCueOrder = "6c912c27416d4329aa715982a0e3b23e";
inline constexpr Id kLineFails = "95fcade1b74e45478146e958da167547";
inline constexpr Id kLineWorks = "e7857772b0f94ec6af30d3f2613c7840";
inline constexpr Id kNotRecorded = "a3c3195392424f33a34b5a0d85c7de8d";

// Of systemd/ols-station-restart, a script.
inline constexpr Id kUpdateTakenBack = "86715475c2ea4f8fb29079684ab280e0";

}  // namespace ols::event
