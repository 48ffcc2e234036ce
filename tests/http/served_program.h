// The real program, `voxsheet serve`, on a free port with folders of its own.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace voxsheet::http_test {

struct Answer {
    int status = 0;
    std::string text; ///< the whole response
    std::string body;
    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
    [[nodiscard]] std::string field(const char* name) const;
};

class ServedProgram {
public:
    /// Makes a folder with `files` volumes of 12x10x8 voxels (a.nrrd, b.nrrd, …), starts the program on them
    /// and waits for its line "ready URL". Throws std::runtime_error if that does not come within 60 s.
    explicit ServedProgram(int files = 2, const std::vector<std::string>& moreArguments = {});
    ~ServedProgram();
    ServedProgram(const ServedProgram&) = delete;
    ServedProgram& operator=(const ServedProgram&) = delete;

    [[nodiscard]] int port() const { return port_; }
    [[nodiscard]] const std::string& token() const { return token_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; } ///< its root
    [[nodiscard]] pid_t pid() const { return pid_; }

    /// With the token. `fields`: further header lines, each ended by CRLF.
    [[nodiscard]] Answer ask(const std::string& method, const std::string& target,
                             const std::string& body = {}, const std::string& fields = {}) const;
    [[nodiscard]] Answer get(const std::string& target) const { return ask("GET", target); }
    /// Without token, Host or anything else but what is given.
    [[nodiscard]] Answer askBare(const std::string& method, const std::string& target,
                                 const std::string& fields, const std::string& body = {}) const;
    /// Waits until every dataset is ready or failed; false after 60 s.
    [[nodiscard]] bool waitForImports() const;
    /// Sends the signal and waits; the exit status, or -1 if it does not end within `seconds` (of an
    /// idle machine).
    int stop(int signal, double seconds);

private:
    void start(const std::vector<std::string>& arguments);

    std::filesystem::path base_;
    std::filesystem::path folder_;
    std::string token_ = "test-token-0123456789";
    pid_t pid_ = -1;
    int output_ = -1;
    int port_ = 0;
};

/// An NRRD file of dims 12x10x8, 8 bits, value = x + 10 y + 3 z + offset.
[[nodiscard]] std::string sampleNrrd(int offset);

} // namespace voxsheet::http_test
