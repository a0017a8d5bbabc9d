#include "export/sapient/sapient_dialogue.h"

#include <stdexcept>

#include "tests/unit/export/made_records.h"
#include "tests/unit/export/sapient/said.h"

namespace ols::exports {
namespace {

const SapientSettings kBrno{.site = "brno"};

sapient::SapientMessage from_receiver() {
  sapient::SapientMessage message;
  message.set_node_id("receiver");
  message.set_destination_id(node_id(kBrno));
  return message;
}

std::string bytes_of(const sapient::SapientMessage& message) {
  return framed(message.SerializeAsString());
}

std::string acknowledgement(bool accepts) {
  auto message = from_receiver();
  message.mutable_registration_ack()->set_acceptance(accepts);
  if (!accepts) message.mutable_registration_ack()->add_ack_response_reason("not\nyou");
  return bytes_of(message);
}

TEST(SapientDialogue, HearsAnAcceptanceInPieces) {
  SapientDialogue dialogue(kBrno);
  EXPECT_EQ(dialogue.acceptance(), std::nullopt);
  for (const char byte : acknowledgement(true)) {
    EXPECT_EQ(dialogue.acceptance(), std::nullopt);
    EXPECT_TRUE(dialogue.take({&byte, 1}, kNow_us).empty());
  }
  EXPECT_EQ(dialogue.acceptance(), true);
  dialogue.take(std::string("\x09\0\0\0rest", 8), kNow_us);  // which never comes whole
  dialogue.clear();
  EXPECT_EQ(dialogue.acceptance(), std::nullopt);
  dialogue.take(acknowledgement(true), kNow_us);
  EXPECT_EQ(dialogue.acceptance(), true);
}

TEST(SapientDialogue, SaysWhyItWasRefused) {
  SapientDialogue dialogue(kBrno);
  dialogue.take(acknowledgement(false), kNow_us);
  EXPECT_EQ(dialogue.acceptance(), false);
  EXPECT_EQ(dialogue.refusal(), "not?you");
}

TEST(SapientDialogue, RefusesATaskByItsName) {
  SapientDialogue dialogue(kBrno);
  auto task = from_receiver();
  task.mutable_task()->set_task_id("01ARYZ6S41TSV4RRFFQ69G5FAV");
  const auto answers = dialogue.take(bytes_of(task), kNow_us);
  ASSERT_EQ(answers.size(), 1U);
  const auto answer = said(answers[0]);
  EXPECT_EQ(answer.destination_id(), "receiver");
  EXPECT_EQ(answer.task_ack().task_id(), "01ARYZ6S41TSV4RRFFQ69G5FAV");
  EXPECT_EQ(answer.task_ack().task_status(), sapient::TaskAck::TASK_STATUS_REJECTED);
  EXPECT_FALSE(answer.task_ack().reason(0).empty());
  task.set_destination_id("another");
  EXPECT_TRUE(dialogue.take(bytes_of(task), kNow_us).empty());
}

TEST(SapientDialogue, CountsComplaintsAndPassesOverTheRest) {
  SapientDialogue dialogue(kBrno);
  auto error = from_receiver();
  error.mutable_error()->add_error_message("Validation 1 errors:\nTimestamp");
  auto alert = from_receiver();
  dialogue.take(bytes_of(error) + bytes_of(alert) + bytes_of(error), kNow_us);
  EXPECT_EQ(dialogue.complaints(), 2U);
  EXPECT_EQ(dialogue.last_complaint(), "Validation 1 errors:?Timestamp");
}

TEST(SapientDialogue, WhatIsNoSapientIsNamed) {
  SapientDialogue rubbish(kBrno), endless(kBrno);
  EXPECT_THROW(rubbish.take(framed("\xff\xff\xff"), kNow_us), std::runtime_error);
  EXPECT_THROW(endless.take("HTTP/1.1 400 Bad Request", kNow_us), std::runtime_error);
}

}  // namespace
}  // namespace ols::exports
