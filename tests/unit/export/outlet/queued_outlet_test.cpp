#include "export/outlet/queued_outlet.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <atomic>
#include <vector>

#include "tests/unit/eventually.h"

namespace ols::exports {
namespace {

// A connection that breaks as often as the test says, and keeps what it was sent.
struct Receiver {
  std::mutex mutex;
  int refusals = 0;
  bool breaks = false;
  std::vector<std::string> got;
  std::atomic<bool> complains = false;
};

class MadeLink : public Link {
 public:
  explicit MadeLink(Receiver& receiver) : receiver_(receiver) {}
  void open() override {
    const std::lock_guard lock(receiver_.mutex);
    if (receiver_.refusals-- > 0) throw LinkError("refused");
  }
  void send(const Packet& packet) override {
    const std::lock_guard lock(receiver_.mutex);
    if (std::exchange(receiver_.breaks, false)) throw LinkError("broke");
    receiver_.got.push_back(packet.bytes);
  }
  void wait(int wake_fd, double seconds) override {
    pollfd wake{wake_fd, POLLIN, 0};
    ::poll(&wake, 1, static_cast<int>(1e3 * seconds));
  }
  void close() override {}
  void say_goodbye() override {
    const std::lock_guard lock(receiver_.mutex);
    receiver_.got.emplace_back("goodbye");
  }
  std::string trouble() const override { return receiver_.complains ? "complains" : ""; }
  std::uint64_t complaints() const override { return receiver_.complains ? 1 : 0; }

 private:
  Receiver& receiver_;
};

TEST(QueuedOutlet, SendsInOrder) {
  Receiver receiver;
  QueuedOutlet outlet(std::make_unique<MadeLink>(receiver));
  ASSERT_TRUE(eventually([&] { return outlet.report().is_open; }));
  outlet.put({{"a", "1"}, {"b", "2"}});
  ASSERT_TRUE(eventually([&] { return outlet.report().sent == 2; }));
  EXPECT_EQ(receiver.got, (std::vector<std::string>{"1", "2"}));
}

TEST(QueuedOutlet, TriesAgainAndForgetsWhatWaited) {
  Receiver receiver;
  receiver.refusals = 2;
  QueuedOutlet outlet(std::make_unique<MadeLink>(receiver));
  outlet.put({{"a", "old"}});
  ASSERT_TRUE(eventually([&] { return outlet.report().is_open; }));
  EXPECT_EQ(outlet.report().failures, 2U);
  EXPECT_EQ(outlet.report().trouble, "");
  outlet.put({{"a", "new"}});
  ASSERT_TRUE(eventually([&] { return outlet.report().sent == 1; }));
  EXPECT_EQ(receiver.got, (std::vector<std::string>{"new"}));
  EXPECT_EQ(outlet.report().displaced, 1U);
}

TEST(QueuedOutlet, SaysWhatAnOpenReceiverComplainsOf) {
  Receiver receiver;
  QueuedOutlet outlet(std::make_unique<MadeLink>(receiver));
  ASSERT_TRUE(eventually([&] { return outlet.report().is_open; }));
  receiver.complains = true;
  outlet.put({{"a", "1"}});
  ASSERT_TRUE(eventually([&] { return outlet.report().complaints == 1; }));
  EXPECT_EQ(outlet.report().trouble, "complains");
  EXPECT_TRUE(outlet.report().is_open);
}

TEST(QueuedOutlet, SaysGoodbyeToAnOpenReceiverOnly) {
  Receiver receiver, broken;
  {
    QueuedOutlet outlet(std::make_unique<MadeLink>(receiver));
    ASSERT_TRUE(eventually([&] { return outlet.report().is_open; }));
    broken.refusals = 1'000'000;
    QueuedOutlet other(std::make_unique<MadeLink>(broken));
    ASSERT_TRUE(eventually([&] { return other.report().failures > 0; }));
  }
  EXPECT_EQ(receiver.got, std::vector<std::string>{"goodbye"});
  EXPECT_EQ(broken.got, std::vector<std::string>{});
}

TEST(QueuedOutlet, SaysThatAConnectionBroke) {
  Receiver receiver;
  QueuedOutlet outlet(std::make_unique<MadeLink>(receiver));
  ASSERT_TRUE(eventually([&] { return outlet.report().openings == 1; }));
  receiver.breaks = true;
  outlet.put({{"a", "1"}});
  ASSERT_TRUE(eventually([&] { return outlet.report().openings == 2; }));
  EXPECT_EQ(outlet.report().failures, 1U);
}

}  // namespace
}  // namespace ols::exports
