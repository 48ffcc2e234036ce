// One client's connection, and its use by a handler's thread.
#pragma once

#include "http/message/chunked_decoder.h"
#include "http/net/admission.h"
#include "http/net/unique_fd.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace voxsheet::http {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline Clock::duration secondsOf(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

enum class Phase {
    Head,     ///< waiting for a head, or for more of it
    Body,     ///< collecting a small body
    Handling, ///< belongs to a handler's thread
    Writing,  ///< sending `out`
    Draining, ///< response sent; reads what the client still sends, so that closing does not destroy the
              ///< response
};

/// Belongs to the socket thread, except while Handling: then `in`, `out` and `admission` belong to the
/// handler's thread.
struct Connection {
    std::uint64_t id = 0;
    UniqueFd fd; ///< closed when the last user lets go: a number in use by a handler is never given out again
    Peer peer;
    Phase phase = Phase::Head;
    Clock::time_point deadline;
    bool headBegun = false;
    bool ended = false;    ///< the client sends no more
    bool headOnly = false; ///< HEAD
    bool keepAlive = true;
    std::string in;  ///< received, not yet used
    std::string out; ///< to be sent
    std::size_t sent = 0;
    RequestHead head;
    Admission admission;
    ChunkedDecoder chunks;
    std::uint64_t reservedBytes = 0; ///< of ServerOptions::maxBufferedBodyBytes
    std::shared_ptr<std::atomic<bool>> gone = std::make_shared<std::atomic<bool>>(false);
};

/// Collects a response whose body is known; the socket thread sends it.
class BufferWriter : public StreamWriter {
public:
    explicit BufferWriter(std::string& out) : out_(out) {}
    bool write(std::string_view bytes) override {
        out_.append(bytes);
        return true;
    }
    [[nodiscard]] bool open() const override { return true; }

private:
    std::string& out_;
};

/// Writes to the socket from a handler's thread.
class SocketWriter : public StreamWriter {
public:
    SocketWriter(Connection& connection, double stallSeconds, std::atomic<std::uint64_t>& sentBytes)
        : connection_(connection), stallSeconds_(stallSeconds), sentBytes_(sentBytes) {}
    bool write(std::string_view bytes) override;
    [[nodiscard]] bool open() const override;

private:
    Connection& connection_;
    double stallSeconds_;
    std::atomic<std::uint64_t>& sentBytes_;
    bool failed_ = false;
};

/// Reads a body from the socket on a handler's thread.
class SocketBodyReader : public BodyReader {
public:
    SocketBodyReader(Connection& connection, const ServerOptions& options);
    bool read(std::string& out) override;
    [[nodiscard]] bool finished() const { return finished_; }

private:
    void receiveMore();
    bool take(std::string& out);

    Connection& connection_;
    const ServerOptions& options_;
    Clock::time_point start_ = Clock::now();
    std::uint64_t received_ = 0; ///< decoded bytes
    bool finished_ = false;
};

} // namespace voxsheet::http
