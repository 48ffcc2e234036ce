// What a handler gives back.
#pragma once

#include "http/message/header_list.h"

#include <functional>
#include <string>
#include <string_view>

namespace voxsheet::http {

/// The body of a response that has no end known in advance.
class StreamWriter {
public:
    virtual ~StreamWriter() = default;
    /// Blocks until the bytes are with the kernel. False: the client is gone, is too slow, or the server
    /// stops; then every later call gives false too.
    virtual bool write(std::string_view bytes) = 0;
    [[nodiscard]] virtual bool open() const = 0;
};

struct Response {
    int status = 200;
    HeaderList headers;
    std::string contentType; ///< empty: no body
    std::string body;
    /// When set: called after the head was sent, writes the body, returns when done. Runs on the thread of
    /// the handler.
    std::function<void(StreamWriter&)> stream;

    Response() = default;
    Response(int code, std::string type, std::string bytes)
        : status(code), contentType(std::move(type)), body(std::move(bytes)) {}
};

} // namespace voxsheet::http
