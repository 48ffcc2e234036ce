// Streams of the real program: tiles, motion JPEG, and a shutdown with many of them open.
#include "raw_client.h"
#include "shared_program.h"
#include "stream_reader.h"

#include <gtest/gtest.h>

#include <csignal>
#include <list>
#include <string>
#include <vector>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";

struct ApiStream : SharedProgram<ApiStream> {
    static constexpr int datasets = 3;
    static std::vector<std::string> arguments() { return {"--columns", "2"}; }
};

TEST_F(ApiStream, StreamGivesTilesAndTakesViews) {
    StreamReader stream(*program_, kSheet + "/stream?width=200&height=160&dpr=1");
    ASSERT_EQ(stream.status(), 200);
    const auto hello = stream.next("hello").header;
    ASSERT_TRUE(hello.is_object());
    const auto path = "/api/v1/streams/" + hello.at("stream").get<std::string>();
    const auto first = stream.next("tile");
    ASSERT_GT(first.payload.size(), 50U);
    std::uint64_t frame = first.header.at("frame").get<std::uint64_t>();
    const json view{{"id", 1},
                    {"moving", false},
                    {"tiles", {{{"cell", "A1"}, {"width", 60}, {"height", 50}}}},
                    {"style", {{"camera.azimuth", 123}}}};
    ASSERT_EQ(program_->ask("POST", path, json{{"ack", frame}, {"view", view}}.dump()).status, 204);
    bool final = false;
    for (int i = 0; i < 50 && !final; ++i) {
        const auto tile = stream.next("tile");
        ASSERT_TRUE(tile.header.is_object());
        frame = tile.header.at("frame").get<std::uint64_t>();
        final =
            tile.header.at("view") == 1 && tile.header.at("final") == true && tile.header.at("cell") == "A1";
        static_cast<void>(program_->ask("POST", path, json{{"ack", frame}}.dump()));
    }
    EXPECT_TRUE(final);
    EXPECT_EQ(program_->ask("PATCH", kSheet + "/style", R"({"camera.elevation": 33})").status, 200);
    EXPECT_TRUE(stream.next("workbook").header.is_object());
    EXPECT_EQ(program_
                  ->get(kSheet + "/probe?cell=A1&px=30&py=25&width=60&height=50&stream=" +
                        hello.at("stream").get<std::string>())
                  .status,
              200);
    EXPECT_EQ(program_->ask("DELETE", path).status, 204);
    EXPECT_EQ(program_->ask("POST", path, R"({"ack": 1})").status, 404);
}

TEST_F(ApiStream, MotionJpegBeginsWithAPicture) {
    RawClient client(program_->port());
    client.send("GET " + kSheet +
                "/stream.mjpeg?width=160&height=120 HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
                program_->token() + "\r\n\r\n");
    std::string bytes;
    for (int i = 0; i < 50 && bytes.find("\xFF\xD8") == std::string::npos; ++i)
        bytes += client.readAll(0.2);
    EXPECT_EQ(fieldOfResponse(bytes, "Content-Type"), "multipart/x-mixed-replace; boundary=voxsheet-frame");
    EXPECT_NE(bytes.find("Content-Type: image/jpeg"), std::string::npos);
    EXPECT_NE(bytes.find("\xFF\xD8"), std::string::npos);
}

TEST(ApiShutdown, TermEndsWithinTwoSecondsWithOpenStreams) {
    ServedProgram program(1);
    std::list<RawClient> streams;
    for (int i = 0; i < 16; ++i) {
        streams.emplace_back(program.port());
        streams.back().send("GET " + kSheet +
                            "/stream?width=100&height=100 HTTP/1.1\r\nHost: localhost\r\nAuthorization: "
                            "Bearer " +
                            program.token() + "\r\n\r\n");
    }
    for (auto& stream : streams)
        EXPECT_EQ(statusOfResponse(stream.readResponse(10.0)), 200);
    EXPECT_EQ(program.stop(SIGTERM, 2.0), 0);
}

} // namespace
