// The messages of a page's stream, as they come from the real program.
#pragma once

#include "raw_client.h"
#include "served_program.h"

#include "http/message/chunked_decoder.h"
#include "stream/message.h"

#include <chrono>
#include <string>

namespace voxsheet::http_test {

/// Reads the messages of an open stream.
class StreamReader {
public:
    StreamReader(const ServedProgram& program, const std::string& target) : client_(program.port()) {
        client_.send("GET " + target + " HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
                     program.token() + "\r\n\r\n");
        wire_ = client_.readResponse(10.0); // the head alone: it has no Content-Length
    }
    [[nodiscard]] int status() const { return statusOfResponse(wire_); }

    /// The next message of that type; an empty one if it does not come within `seconds`.
    voxsheet::stream::ParsedMessage next(const std::string& type, double seconds = 10.0) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < until) {
            body_.erase(0, used_);
            used_ = 0;
            auto message = voxsheet::stream::parseMessage(body_);
            if (message.bytes == 0) {
                auto bytes = rest_ + client_.readAll(0.1);
                rest_ = bytes.substr(chunks_.feed(bytes, body_));
                continue;
            }
            used_ = message.bytes;
            if (message.header.at("type") == type) return message;
        }
        return {};
    }

private:
    RawClient client_;
    std::string wire_;
    std::string rest_;
    std::string body_;
    std::size_t used_ = 0;
    voxsheet::http::ChunkedDecoder chunks_;
};

} // namespace voxsheet::http_test
