// What happens to one request on the socket thread, and its hand-over to a handler's thread and back.
#include "http/net/response_writer.h"
#include "http/net/server_loop.h"

#include "base/errors.h"
#include "base/log.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <sys/epoll.h>
#include <sys/socket.h>

namespace voxsheet::http {

namespace {

constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
constexpr double kDrainSeconds = 2.0;
constexpr std::size_t kDrainBytes = std::size_t{4} << 20U;

Clock::duration transferTime(std::uint64_t bytes, const ServerOptions& options) {
    return secondsOf(options.stallSeconds + static_cast<double>(bytes) / options.lowestBytesPerSecond);
}

} // namespace

/// False when there is nothing more to hope for: the connection broke, or ended with no request waiting.
bool HttpServer::Loop::receive(const ConnectionPtr& connection, std::size_t limit) {
    std::array<char, 32768> buffer; // NOLINT: filled by recv
    std::size_t total = 0;
    while (total < limit) {
        const auto count = ::recv(connection->fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (count > 0) {
            connection->in.append(buffer.data(), static_cast<std::size_t>(count));
            total += static_cast<std::size_t>(count);
            continue;
        }
        if (count < 0 && errno == EINTR) continue;
        // A client that closed its sending half after its requests still gets its answers.
        if (count == 0) {
            connection->ended = true;
            return !connection->in.empty();
        }
        return errno == EAGAIN || errno == EWOULDBLOCK;
    }
    return true;
}

void HttpServer::Loop::advance(const ConnectionPtr& connection) {
    if (connection->phase == Phase::Head && !readHead(connection)) return;
    if (connection->phase == Phase::Body && readBody(connection)) dispatch(connection);
}

/// True when a body is to be read here.
bool HttpServer::Loop::readHead(const ConnectionPtr& connection) {
    auto& in = connection->in;
    if (in.starts_with("\r\n")) in.erase(0, 2); // RFC 9112, 2.2: a stray line end after the last body
    if (!in.empty() && !connection->headBegun) {
        connection->headBegun = true;
        connection->deadline = Clock::now() + secondsOf(options_.headSeconds);
    }
    try {
        const auto bytes = headBytes(in, options_.head);
        if (!bytes) {
            awaitMore(connection);
            return false;
        }
        connection->head = parseHead(std::string_view(in).substr(0, *bytes), options_.head);
        in.erase(0, *bytes);
    } catch (const BadHead& bad) {
        refuse(connection, bad.status, bad.detail);
        return false;
    }
    ++requests_;
    connection->headOnly = connection->head.method == "HEAD";
    connection->keepAlive = connection->head.keepAlive && !stopping_;
    connection->admission = admit_(connection->head, connection->peer);
    return beginBody(connection);
}

bool HttpServer::Loop::beginBody(const ConnectionPtr& connection) {
    const auto& head = connection->head;
    auto& admission = connection->admission;
    if (admission.refusal) {
        // A body that nobody reads would be taken for the next request.
        respond(connection, std::move(*admission.refusal), connection->keepAlive && !head.hasBody());
        return false;
    }
    admission.request.remoteAddress = connection->peer.remoteAddress;
    if (head.contentLength.value_or(0) > admission.bodyBudgetBytes) {
        refuse(connection, 413,
               "the body is larger than the " + std::to_string(admission.bodyBudgetBytes) +
                   " bytes that are accepted here");
        return false;
    }
    if (head.expectContinue && head.hasBody()) // small enough for any socket buffer
        ::send(connection->fd.get(), kContinue.data(), kContinue.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (!head.hasBody() || admission.streamsBody) {
        dispatch(connection);
        return false;
    }
    const auto expected = head.contentLength.value_or(admission.bodyBudgetBytes);
    if (bufferedBytes_ + expected > options_.maxBufferedBodyBytes) {
        refuse(connection, 503, "too many request bodies are under way; try again in a moment");
        return false;
    }
    bufferedBytes_ += expected;
    connection->reservedBytes = expected;
    connection->phase = Phase::Body;
    connection->deadline = Clock::now() + transferTime(expected, options_);
    connection->chunks = ChunkedDecoder{};
    return true;
}

/// True when the body is whole.
bool HttpServer::Loop::readBody(const ConnectionPtr& connection) {
    auto& in = connection->in;
    auto& body = connection->admission.request.body;
    if (connection->head.chunked) {
        try {
            in.erase(0, connection->chunks.feed(in, body));
        } catch (const InvalidInput& error) {
            refuse(connection, 400, error.what());
            return false;
        }
        const auto budget = connection->admission.bodyBudgetBytes;
        if (std::max<std::uint64_t>(body.size(), connection->chunks.announcedBytes()) > budget) {
            refuse(connection, 413,
                   "the body is larger than the " + std::to_string(budget) + " bytes that are accepted here");
            return false;
        }
        if (connection->chunks.done()) return true;
    } else {
        const auto length = static_cast<std::size_t>(*connection->head.contentLength);
        if (in.size() >= length) {
            body = in.substr(0, length);
            in.erase(0, length);
            return true;
        }
    }
    awaitMore(connection);
    return false;
}

void HttpServer::Loop::awaitMore(const ConnectionPtr& connection) {
    if (connection->ended)
        drop(connection);
    else
        arm(*connection, EPOLLIN);
}

void HttpServer::Loop::dispatch(const ConnectionPtr& connection) {
    connection->gone = std::make_shared<std::atomic<bool>>(stopping_.load());
    connection->admission.request.gone = connection->gone;
    connection->phase = Phase::Handling;
    const auto poolOf = [this](Pool pool) -> WorkerPool& {
        switch (pool) {
        case Pool::Render:
            return render_;
        case Pool::Stream:
            return stream_;
        case Pool::Control:
            break;
        }
        return control_;
    };
    if (poolOf(connection->admission.pool).trySubmit([self = shared_from_this(), connection] {
            self->execute(connection);
        })) {
        // An upload's own bytes are its handler's to read, and so is the end of them.
        if (!connection->admission.streamsBody) arm(*connection, EPOLLRDHUP);
        return;
    }
    refuse(connection, 503, "the server is busy; try again in a moment");
}

/// On a handler's thread.
void HttpServer::Loop::execute(const ConnectionPtr& connection) {
    auto& admission = connection->admission;
    bool keepAlive = connection->keepAlive;
    Response response;
    if (admission.streamsBody) {
        SocketBodyReader reader(*connection, options_);
        admission.request.bodyReader = &reader;
        response = admission.handle(admission.request);
        admission.request.bodyReader = nullptr;
        keepAlive = keepAlive && reader.finished();
    } else {
        response = admission.handle(admission.request);
    }
    const ResponseFraming framing{connection->headOnly, keepAlive && !stopping_};
    if (response.stream && !framing.headOnly) {
        SocketWriter writer(*connection, options_.stallSeconds, sentBytes_);
        connection->keepAlive = writeResponse(writer, framing, std::move(response));
    } else {
        BufferWriter writer(connection->out);
        connection->keepAlive = writeResponse(writer, framing, std::move(response));
    }
    {
        const std::lock_guard lock(finishedMutex_);
        finished_.push_back(connection);
    }
    wake();
}

/// Back on the socket thread.
void HttpServer::Loop::finished(const ConnectionPtr& connection) {
    bufferedBytes_ -= std::exchange(connection->reservedBytes, 0);
    connection->admission = Admission{};
    if (!connections_.contains(connection->id)) return;
    connection->phase = Phase::Writing;
    connection->deadline = Clock::now() + transferTime(connection->out.size(), options_);
    send(connection);
}

void HttpServer::Loop::send(const ConnectionPtr& connection) {
    auto& out = connection->out;
    while (connection->sent < out.size()) {
        const auto count = ::send(connection->fd.get(), out.data() + connection->sent,
                                  out.size() - connection->sent, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count >= 0) {
            connection->sent += static_cast<std::size_t>(count);
            sentBytes_ += static_cast<std::uint64_t>(count);
            continue;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN && errno != EWOULDBLOCK) {
            drop(connection);
            return;
        }
        arm(*connection, EPOLLOUT);
        return;
    }
    std::string().swap(out);
    connection->sent = 0;
    if (connection->keepAlive && !stopping_) {
        nextRequest(connection);
        return;
    }
    ::shutdown(connection->fd.get(), SHUT_WR);
    connection->phase = Phase::Draining;
    connection->deadline = Clock::now() + secondsOf(kDrainSeconds);
    connection->in.clear();
    drain(connection);
}

void HttpServer::Loop::nextRequest(const ConnectionPtr& connection) {
    connection->phase = Phase::Head;
    connection->headBegun = false;
    connection->deadline = Clock::now() + secondsOf(options_.idleSeconds);
    if (connection->in.capacity() > (std::size_t{64} << 10U)) connection->in.shrink_to_fit();
    // A pipelined request may be here already: being writable brings us back to it, with no recursion and
    // after others.
    arm(*connection, connection->in.empty() ? EPOLLIN : EPOLLIN | EPOLLOUT);
}

void HttpServer::Loop::drain(const ConnectionPtr& connection) {
    std::array<char, 32768> buffer; // NOLINT: thrown away
    for (;;) {
        const auto count = ::recv(connection->fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (count > 0) {
            connection->sent += static_cast<std::size_t>(count); // counts what was thrown away
            if (connection->sent > kDrainBytes) break;
            continue;
        }
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
            arm(*connection, EPOLLIN);
            return;
        }
        break;
    }
    drop(connection);
}

void HttpServer::Loop::refuse(const ConnectionPtr& connection, int status, const std::string& detail) {
    ++refused_;
    auto response = refuse_(status, detail);
    if (status == 503) response.headers.set("Retry-After", "1");
    respond(connection, std::move(response), false);
}

void HttpServer::Loop::respond(const ConnectionPtr& connection, Response response, bool keepAlive) {
    bufferedBytes_ -= std::exchange(connection->reservedBytes, 0);
    connection->admission = Admission{};
    BufferWriter writer(connection->out);
    const ResponseFraming framing{connection->headOnly, keepAlive && !stopping_};
    connection->keepAlive = writeResponse(writer, framing, std::move(response));
    connection->phase = Phase::Writing;
    connection->deadline = Clock::now() + transferTime(connection->out.size(), options_);
    send(connection);
}

} // namespace voxsheet::http
