#include "bridge/nats_key.h"

#include <gtest/gtest.h>

#include "base/trust/crypto.h"

namespace ols::bridge {
namespace {

// A published seed and a published key (of another pair) of the project that defined them.
TEST(NatsKey, IsWrittenAsTheServerReadsIt) {
  const auto seed =
      trust::from_hex<32>("c568a6e311ea13601176556dc88044441335fb65629496f6e976456566aeb05d");
  const auto other =
      trust::from_hex<32>("95d6fdbef382e434b70605a00930c164e1f2b86d3c079133054b90ea553ad462");
  ASSERT_TRUE(seed && other);
  const NatsKey key = nats_key(*seed, *other);
  EXPECT_EQ(key.seed, "SUAMK2FG4MI6UE3ACF3FK3OIQBCEIEZV7NSWFFEW63UXMRLFM2XLAXK4GY");
  EXPECT_EQ(key.public_key, "UCK5N7N66OBOINFXAYC2ACJQYFSOD4VYNU6APEJTAVFZB2SVHLKGEW7L");
}

}  // namespace
}  // namespace ols::bridge
