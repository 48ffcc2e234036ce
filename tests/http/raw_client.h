// A client that sends whatever bytes a test wants.
#pragma once

#include "http/net/unique_fd.h"

#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::http_test {

class RawClient {
public:
    /// Connects to 127.0.0.1; throws std::runtime_error if that fails within `seconds`.
    explicit RawClient(int port, double seconds = 5.0);

    /// False once the server has closed. Gives up after `seconds` of a full socket.
    bool send(std::string_view bytes, double seconds = 5.0);
    /// Reads until the server closes or `seconds` have passed; everything so far.
    std::string readAll(double seconds = 5.0);
    /// Reads one response with Content-Length (or without body) from the connection; "" if it ends or nothing
    /// comes in time.
    std::string readResponse(double seconds = 5.0);
    /// True if the server closes the connection within `seconds` (what it sends until then is kept).
    bool closedWithin(double seconds);
    void closeSendingHalf();
    /// Closes with a reset, as a process that is killed does.
    void abort();
    [[nodiscard]] int fd() const { return fd_.get(); }

private:
    enum class Read { Data, End, Timeout };
    Read readSome(double seconds);

    http::UniqueFd fd_;
    std::string received_;
};

/// Of "HTTP/1.1 404 Not Found…"; 0 if it is none.
[[nodiscard]] int statusOfResponse(std::string_view response);
[[nodiscard]] std::string bodyOfResponse(std::string_view response);
/// The value of a header field; nothing if it is not there.
[[nodiscard]] std::optional<std::string> fieldOfResponse(std::string_view response, std::string_view name);

/// Connects, sends, reads to the end or for `seconds`.
[[nodiscard]] std::string exchange(int port, std::string_view bytes, double seconds = 5.0);

/// "GET PATH HTTP/1.1" with Host and the given further lines, closing the connection.
[[nodiscard]] std::string getRequest(const std::string& path, const std::string& fields = {});

} // namespace voxsheet::http_test
