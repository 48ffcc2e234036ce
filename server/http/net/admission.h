// What the server asks the program above it about every request, before the body is read.
#pragma once

#include "http/message/request.h"
#include "http/message/request_head.h"
#include "http/message/response.h"
#include "http/net/server_options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace voxsheet::http {

/// Both ends of a connection as numeric addresses.
struct Peer {
    std::string remoteAddress;
    std::string localAddress;
};

struct Admission {
    std::optional<Response> refusal; ///< answered at once; nothing below matters
    Request request;                 ///< all but the body
    Pool pool = Pool::Control;
    std::uint64_t bodyBudgetBytes = 0;
    bool streamsBody = false;                 ///< the handler reads the body itself (Request::bodyReader)
    std::function<Response(Request&)> handle; ///< must not throw; runs on a thread of `pool`
};

/// Called on the thread that reads all sockets: must be quick and must not throw.
using Admit = std::function<Admission(const RequestHead&, const Peer&)>;

/// The answer to something that never became a request: malformed, too long, too many.
using Refuse = std::function<Response(int status, const std::string& detail)>;

} // namespace voxsheet::http
