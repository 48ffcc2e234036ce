#include "base/errors.h"
#include "stream/message.h"

#include <gtest/gtest.h>

namespace voxsheet::stream {
namespace {

TEST(Message, ComesBackAsItWas) {
    const std::string payload("\0\x01\xff bytes", 9);
    const auto bytes = frameMessage({{"type", "tile"}, {"seq", 7}}, payload);
    const auto received = bytes + "next"; // the payload is a part of it
    const auto message = parseMessage(received);
    EXPECT_EQ(message.bytes, bytes.size());
    EXPECT_EQ(message.header["seq"], 7);
    EXPECT_EQ(message.payload, payload);
}

TEST(Message, LengthsAreLittleEndian) {
    const auto bytes = frameMessage(nlohmann::json::object(), "abc");
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x02\0\0\0\x03\0\0\0", 8));
}

TEST(Message, PartsAreNotYetAMessage) {
    const auto bytes = frameMessage({{"type", "ping"}}, "xyz");
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_EQ(parseMessage(std::string_view(bytes).substr(0, n)).bytes, 0U) << n;
}

TEST(Message, HeaderThatIsNoJsonIsRefused) {
    auto bytes = frameMessage({{"type", "ping"}});
    bytes[8] = 'x';
    EXPECT_THROW(static_cast<void>(parseMessage(bytes)), InvalidInput);
}

} // namespace
} // namespace voxsheet::stream
