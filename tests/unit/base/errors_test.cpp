#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

TEST(Errors, ReadAsOneSentence) {
    const InvalidInput error("sizes", "three numbers are needed, there are two",
                             "write for example 64 64 64");
    EXPECT_STREQ(error.what(), "sizes: three numbers are needed, there are two; write for example 64 64 64");
    EXPECT_EQ(error.kind(), ErrorKind::InvalidInput);
}

TEST(Errors, PartsThatAreEmptyLeaveNoMarks) {
    EXPECT_STREQ(NotFound("sheet Demo", "", "").what(), "sheet Demo");
    EXPECT_STREQ(NotFound("sheet Demo", "there is none").what(), "sheet Demo: there is none");
}

TEST(Errors, FieldTravels) {
    try {
        throw InvalidInput("camera.fov", "200 is outside 1 to 150").withField("camera.fov");
    } catch (const Error& error) {
        EXPECT_EQ(error.field(), "camera.fov");
    }
}

TEST(Errors, NamesComeBack) {
    for (int kind = 0; kind <= static_cast<int>(ErrorKind::Internal); ++kind)
        EXPECT_EQ(errorKindFromName(errorKindName(static_cast<ErrorKind>(kind))),
                  static_cast<ErrorKind>(kind));
    EXPECT_EQ(errorKindFromName("no such word"), ErrorKind::Internal);
}

} // namespace
} // namespace voxsheet
