// Away from one's own desk: few processors, a proxy's prefix, a tunnel's other port.
#include "raw_client.h"
#include "served_program.h"

#include "base/thread_count.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace voxsheet;
using namespace voxsheet::http_test;

namespace {

const std::string kSheet = "/api/v1/sheets/Sheet1";

/// Names of the threads of a process, as the kernel has them.
std::vector<std::string> threadNames(pid_t pid) {
    std::vector<std::string> names;
    for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
        std::ifstream in(task.path() / "comm");
        std::string name;
        if (std::getline(in, name)) names.push_back(name);
    }
    return names;
}

TEST(ApiThreads, OneThreadMeansThatDrawingHasNoneOfItsOwn) {
    ::unsetenv("LP_NUM_THREADS");
    ServedProgram program(1, {"--threads", "1"});
    ASSERT_TRUE(program.waitForImports());
    EXPECT_EQ(program.get(kSheet + "/cells/A1/image.png?width=64&height=64").status, 200);
    const auto info = program.get("/api/v1").json();
    EXPECT_EQ(info.at("threads").at("count"), 1);
    EXPECT_NE(info.at("threads").at("why"), "");
    if (!info.at("device").at("software").get<bool>()) GTEST_SKIP() << "a GPU draws";
    for (const auto& name : threadNames(program.pid()))
        EXPECT_FALSE(name.starts_with("llvmpipe")) << name;
}

TEST(ApiThreads, NeverMoreThanThisProcessMayUse) {
    ServedProgram program(0, {"--threads", "1000"});
    const auto threads = program.get("/api/v1").json().at("threads");
    EXPECT_EQ(threads.at("count"), permittedThreads().threads);
    EXPECT_NE(threads.at("why").get<std::string>().find("--threads 1000 is more"), std::string::npos);
}

class ApiBasePath : public testing::Test {
protected:
    static void SetUpTestSuite() { program_ = new ServedProgram(1, {"--base-path", "/user/me"}); }
    static void TearDownTestSuite() {
        delete program_;
        program_ = nullptr;
    }
    static ServedProgram* program_;
};

ServedProgram* ApiBasePath::program_ = nullptr;

TEST_F(ApiBasePath, PageAndItsFilesLieBelowIt) {
    const auto page = program_->askBare("GET", "/user/me/?token=" + program_->token(), "Host: localhost\r\n");
    EXPECT_EQ(page.status, 200);
    EXPECT_NE(page.field("Set-Cookie").find("Path=/user/me/"), std::string::npos);
    // Every address in the page is relative: no src or href begins with '/' or a scheme.
    int addresses = 0;
    for (const char* attribute : {"src=\"", "href=\""}) {
        for (auto at = page.body.find(attribute); at != std::string::npos;
             at = page.body.find(attribute, at + 1)) {
            const auto begin = at + std::string(attribute).size();
            const auto address = page.body.substr(begin, page.body.find('"', begin) - begin);
            if (address.starts_with("data:")) continue;
            EXPECT_FALSE(address.starts_with("/")) << address;
            EXPECT_EQ(address.find("://"), std::string::npos) << address;
            EXPECT_EQ(program_->get("/user/me/" + address).status, 200) << address;
            ++addresses;
        }
    }
    const bool built = page.body.find("<script") != std::string::npos;
    EXPECT_EQ(built, addresses > 0);
}

TEST_F(ApiBasePath, EveryRouteLiesBelowItAndAtTheTop) {
    ASSERT_TRUE(program_->waitForImports());
    for (const std::string& route :
         {std::string("/livez"), std::string("/api/v1"), std::string("/api/v1/files?path="),
          kSheet + "/style", kSheet + "/cells/A1/image.png?width=32&height=32",
          kSheet + "/probe?cell=A1&px=3&py=3&width=9&height=9"}) {
        EXPECT_EQ(program_->get("/user/me" + route).status, 200) << route;
        EXPECT_EQ(program_->get(route).status, 200) << route << ": a proxy may take the prefix off";
    }
    EXPECT_EQ(program_->get("/user/meadow/api/v1").status, 404);
    EXPECT_EQ(program_->get("/user/api/v1").status, 404);
    EXPECT_EQ(program_->get("/api/v1/openapi.json").json().at("servers").at(0).at("url"), "/user/me");
}

TEST_F(ApiBasePath, AMissingSlashIsAddedAndTheTokenKept) {
    const auto answer = program_->askBare("GET", "/user/me?token=abc", "Host: localhost\r\n");
    EXPECT_EQ(answer.status, 308);
    EXPECT_EQ(answer.field("Location"), "/user/me/?token=abc");
}

TEST_F(ApiBasePath, StreamAndItsAcknowledgementsRunBelowIt) {
    RawClient stream(program_->port());
    // As through `ssh -L 5555:…`: the browser's port is not the server's.
    stream.send("GET /user/me" + kSheet +
                "/stream?width=100&height=100 HTTP/1.1\r\nHost: localhost:5555\r\nAuthorization: Bearer " +
                program_->token() + "\r\n\r\n");
    EXPECT_EQ(statusOfResponse(stream.readResponse(10.0)), 200);
    EXPECT_EQ(
        program_->ask("POST", "/user/me/api/v1/streams/nostream", "{}", "Content-Type: application/json\r\n")
            .status,
        404);
}

TEST(ApiTunnel, AnyLocalPortIsAHostOfOurs) {
    ServedProgram program(0);
    const auto asked = [&](const std::string& host, const std::string& origin) {
        return program
            .askBare("POST", "/api/v1/undo",
                     "Host: " + host + "\r\nOrigin: " + origin + "\r\nAuthorization: Bearer " +
                         program.token() + "\r\n")
            .status;
    };
    EXPECT_EQ(asked("localhost:5555", "http://localhost:5555"), 200);
    EXPECT_EQ(asked("127.0.0.1:40000", "http://127.0.0.1:40000"), 200);
    EXPECT_EQ(asked("[::1]:5555", "http://[::1]:5555"), 200);
    EXPECT_EQ(asked("localhost:5555", "http://localhost:5556"), 403) << "another page on the same machine";
    EXPECT_EQ(asked("node17.cluster:5555", "http://node17.cluster:5555"), 421);
}

} // namespace
