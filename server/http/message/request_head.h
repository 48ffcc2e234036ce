// The strict reading of a request's first line and header fields. Whatever two programs could read in two
// ways is refused: that is what request smuggling lives on (RFC 9112, section 11.2).
#pragma once

#include "http/message/header_list.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::http {

struct HeadLimits {
    std::size_t bytes = 64U << 10U;     ///< first line and all fields
    std::size_t lineBytes = 16U << 10U; ///< one field
    std::size_t targetBytes = 8U << 10U;
    std::size_t fields = 100;
};

struct RequestHead {
    std::string method; ///< a token, as sent
    std::string path;   ///< percent-encoded, begins with '/'
    std::string query;  ///< percent-encoded, without '?'
    HeaderList headers;
    std::optional<std::uint64_t> contentLength;
    bool chunked = false;
    bool expectContinue = false;
    bool keepAlive = true;

    [[nodiscard]] bool hasBody() const { return chunked || contentLength.value_or(0) > 0; }
};

/// A request that is answered with `status` and then the connection is closed: where it ends is not known.
struct BadHead {
    int status = 400;
    std::string detail;
};

/// Bytes of the head up to and with its empty line; nothing while that line has not come. Throws BadHead 431
/// or 414 when a limit is passed, 400 for a control character that no head holds.
[[nodiscard]] std::optional<std::size_t> headBytes(std::string_view received, const HeadLimits& limits);

/// \param head  as many bytes as headBytes says
/// Throws BadHead: 400 malformed, 414/431 too long, 415 for a Content-Encoding, 417 for an unknown Expect,
/// 501 for a Transfer-Encoding other than chunked, 505 for another HTTP version.
[[nodiscard]] RequestHead parseHead(std::string_view head, const HeadLimits& limits);

} // namespace voxsheet::http
