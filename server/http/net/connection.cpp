#include "http/net/connection.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>

namespace voxsheet::http {

namespace {

constexpr int kSliceMs = 100; // how soon a blocked thread notices that the client is gone or the server stops

/// False on timeout or error; the caller looks at its own deadline.
bool waitFor(int fd, short events) {
    pollfd entry{fd, events, 0};
    return ::poll(&entry, 1, kSliceMs) > 0;
}

} // namespace

bool SocketWriter::open() const { return !failed_ && !connection_.gone->load(std::memory_order_relaxed); }

bool SocketWriter::write(std::string_view bytes) {
    auto lastProgress = Clock::now();
    while (!bytes.empty()) {
        if (!open()) return false;
        const auto count =
            ::send(connection_.fd.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count > 0) {
            sentBytes_ += static_cast<std::uint64_t>(count);
            bytes.remove_prefix(static_cast<std::size_t>(count));
            lastProgress = Clock::now();
            continue;
        }
        const bool mayComeBack = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
        if (!mayComeBack || Clock::now() - lastProgress > secondsOf(stallSeconds_)) {
            failed_ = true;
            return false;
        }
        waitFor(connection_.fd.get(), POLLOUT);
    }
    return open();
}

SocketBodyReader::SocketBodyReader(Connection& connection, const ServerOptions& options)
    : connection_(connection), options_(options), finished_(!connection.head.hasBody()) {}

bool SocketBodyReader::read(std::string& out) {
    while (!finished_) {
        const auto before = out.size();
        const bool progressed = take(out);
        received_ += out.size() - before;
        if (std::max(received_, connection_.chunks.announcedBytes()) > connection_.admission.bodyBudgetBytes)
            throw LimitExceeded("request body", "it is larger than " +
                                                    std::to_string(connection_.admission.bodyBudgetBytes) +
                                                    " bytes");
        if (out.size() > before) return true;
        if (!progressed && !finished_) receiveMore();
    }
    return false;
}

/// Moves what was received to `out`; true if anything was used.
bool SocketBodyReader::take(std::string& out) {
    auto& in = connection_.in;
    if (connection_.head.chunked) {
        const auto used = connection_.chunks.feed(in, out);
        in.erase(0, used);
        finished_ = connection_.chunks.done();
        return used > 0;
    }
    const auto left = *connection_.head.contentLength - received_;
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, in.size()));
    out.append(in, 0, count);
    in.erase(0, count);
    finished_ = count == left;
    return count > 0;
}

void SocketBodyReader::receiveMore() {
    std::array<char, 65536> buffer; // NOLINT: filled by recv
    for (;;) {
        if (connection_.gone->load(std::memory_order_relaxed))
            throw Cancelled("request body", "the client has gone");
        const auto elapsed = Clock::now() - start_ - secondsOf(options_.stallSeconds);
        const double due = std::chrono::duration<double>(elapsed).count() * options_.lowestBytesPerSecond;
        if (elapsed > Clock::duration::zero() && static_cast<double>(received_) < due)
            throw Cancelled("request body", "it arrives too slowly");
        const auto count = ::recv(connection_.fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (count > 0) {
            connection_.in.append(buffer.data(), static_cast<std::size_t>(count));
            return;
        }
        if (count == 0) throw Cancelled("request body", "the client ended it early");
        if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
            throw Cancelled("request body", "the connection broke");
        waitFor(connection_.fd.get(), POLLIN);
    }
}

} // namespace voxsheet::http
