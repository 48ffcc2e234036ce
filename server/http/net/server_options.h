// Where the server listens and what it grants a client.
#pragma once

#include "http/message/request_head.h"

#include <cstdint>
#include <string>

namespace voxsheet::http {

/// Which threads run a handler. Quick answers never wait behind slow ones, nor behind streams that live for
/// hours.
enum class Pool {
    Control, ///< milliseconds: state, edits, files of the page
    Render,  ///< up to seconds: pictures, previews, uploads
    Stream,  ///< as long as a page is open; a thread each
};

struct ServerOptions {
    std::string host = "127.0.0.1";
    int port = 8080;           ///< [0, 65535]; 0 = any free one
    bool nextFreePort = false; ///< when `port` is busy, try the hundred after it

    HeadLimits head;
    double headSeconds = 10.0; ///< from a request's first byte to the end of its head
    double idleSeconds = 75.0; ///< between two requests of a connection
    double stallSeconds =
        20.0; ///< grace before the lowest rate counts; a stream's longest pause in taking bytes
    double lowestBytesPerSecond = 16384.0; ///< of bodies in both directions, once the grace has passed

    int maxConnections = 4096;
    int maxConnectionsPerAddress = 3072; ///< generous: behind a proxy all clients share one address
    std::uint64_t maxBufferedBodyBytes = std::uint64_t{256}
                                         << 20U; ///< request bodies being collected, all together

    int controlThreads = 4;
    int renderThreads = 8;
    int streamThreads = 256;
    std::size_t queueLength = 512; ///< requests waiting for a control or render thread; one more gets 503
};

} // namespace voxsheet::http
