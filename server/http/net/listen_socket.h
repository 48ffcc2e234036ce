// The listening socket: a port of its own, a backlog that takes a burst.
#pragma once

#include "http/net/unique_fd.h"

#include <string>

namespace voxsheet::http {

struct ListenSocket {
    UniqueFd fd;
    std::string host; ///< numeric address bound to
    int port = 0;
};

/// Binds and listens (backlog 1024, close-on-exec, non-blocking) with no SO_REUSEPORT: no second server can
/// share the port. \param port  [0, 65535], 0 = any free one \param nextFreePort  when the port is busy, try
/// up to a hundred after it Throws Conflict if the port is in use, InvalidInput if the host is not an address
/// of this machine or the port is out of range, IoError for anything else.
[[nodiscard]] ListenSocket listenOn(const std::string& host, int port, bool nextFreePort);

/// Raises this process's soft limit of open files towards `wanted`, as far as the hard limit lets it; returns
/// the limit.
int raiseOpenFileLimit(int wanted);

} // namespace voxsheet::http
