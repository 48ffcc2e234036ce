// Frames a response on the wire: status line, header fields, body or chunks.
#pragma once

#include "http/message/response.h"

namespace voxsheet::http {

struct ResponseFraming {
    bool headOnly = false; ///< the request was HEAD
    bool keepAlive = true;
};

/// Writes everything that `response` says, and runs its stream; the response is used up. Never throws: a
/// stream that fails ends the chunks early, so that the client sees a broken body and not a whole one.
/// Returns false if the connection must be closed.
bool writeResponse(StreamWriter& out, const ResponseFraming& framing, Response&& response) noexcept;

} // namespace voxsheet::http
