#include "base/errors.h"
#include "http/message/query.h"

#include <gtest/gtest.h>

using namespace voxsheet;
using namespace voxsheet::http;

namespace {

TEST(PercentEncoding, RoundTrip) {
    const std::string text = "a b/c+\xC3\xA9%&=";
    EXPECT_EQ(percentDecoded(percentEncoded(text), false), text);
    EXPECT_EQ(percentDecoded("a+b", true), "a b");
    EXPECT_EQ(percentDecoded("a+b", false), "a+b");
    for (const auto* bad : {"%", "%1", "%zz", "%-1", "a%00b"})
        EXPECT_FALSE(percentDecoded(bad, false)) << bad;
}

TEST(Query, TypedValues) {
    const Query query("width=320&height=2.5&title=a%20b&flag=true&camera.azimuth=-30");
    EXPECT_EQ(query.integer("width", 1, 8192), 320);
    EXPECT_DOUBLE_EQ(query.requireNumber("height", 0, 10), 2.5);
    EXPECT_EQ(query.text("title"), "a b");
    EXPECT_EQ(query.boolean("flag"), true);
    EXPECT_FALSE(query.integer("absent", 0, 1));
}

TEST(Query, RefusesAndNamesTheKey) {
    const auto fieldOf = [](const auto& act) -> std::string {
        try {
            act();
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return "(accepted)";
    };
    for (const auto* text :
         {"w=0", "w=9000", "w=", "w=abc", "w=1.5", "w=1e3", "w=99999999999999999999", "w=-1", "w= 1"})
        EXPECT_EQ(fieldOf([&] { static_cast<void>(Query(text).integer("w", 1, 8192)); }), "w") << text;
    for (const auto* text : {"w=nan", "w=inf", "w=1e400", "w=0x1p3", "w=1,5"})
        EXPECT_EQ(fieldOf([&] { static_cast<void>(Query(text).number("w", -1e9, 1e9)); }), "w") << text;
    EXPECT_EQ(fieldOf([] { static_cast<void>(Query("a=1&b=2").requireText("c")); }), "c");
    EXPECT_EQ(fieldOf([] { static_cast<void>(Query("b=maybe").boolean("b")); }), "b");
    EXPECT_EQ(fieldOf([] { Query("a=1&a=2"); }), "a");
    EXPECT_THROW(Query("a=%zz"), InvalidInput);
}

} // namespace
