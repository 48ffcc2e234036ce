#include "http/net/server_loop.h"

#include "base/errors.h"
#include "base/log.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

namespace voxsheet::http {

namespace {

constexpr std::uint64_t kListenId = 0;
constexpr std::uint64_t kWakeId = 1;
constexpr int kTickMs = 200;          // how late a deadline may be noticed
constexpr int kAcceptsPerRound = 256; // so that a burst of connects does not keep others waiting

void watch(int epoll, int fd, std::uint64_t id, std::uint32_t events) {
    epoll_event event{};
    event.events = events;
    event.data.u64 = id;
    if (::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event) != 0)
        throw IoError("socket", std::string("cannot be watched, ") + std::strerror(errno));
}

std::string numericAddress(const sockaddr_storage& address, socklen_t length) {
    std::array<char, NI_MAXHOST> text{};
    if (::getnameinfo(reinterpret_cast<const sockaddr*>(&address), length, text.data(), text.size(), nullptr,
                      0, NI_NUMERICHOST) != 0)
        return {};
    std::string out = text.data();
    // An IPv4 client of an IPv6 socket.
    constexpr std::string_view mapped = "::ffff:";
    if (out.starts_with(mapped) && out.find('.') != std::string::npos) out.erase(0, mapped.size());
    return out;
}

Peer peerOf(int fd) {
    Peer peer;
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    if (::getpeername(fd, reinterpret_cast<sockaddr*>(&address), &length) == 0)
        peer.remoteAddress = numericAddress(address, length);
    length = sizeof address;
    if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length) == 0)
        peer.localAddress = numericAddress(address, length);
    return peer;
}

UniqueFd spareDescriptor() { return UniqueFd(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }

} // namespace

HttpServer::Loop::Loop(const ServerOptions& options, Admit admit, Refuse refuse)
    : options_(options), admit_(std::move(admit)), refuse_(std::move(refuse)),
      listen_(listenOn(options.host, options.port, options.nextFreePort)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      reserve_(spareDescriptor()), control_(options.controlThreads, options.queueLength),
      render_(options.renderThreads, options.queueLength), stream_(options.streamThreads, 0) {
    // 256 descriptors are left to the rest of the program.
    const int files = raiseOpenFileLimit(options.maxConnections + 256);
    options_.maxConnections = std::max(16, std::min(options.maxConnections, files - 256));
    if (!epoll_.valid() || !wake_.valid()) throw IoError("server", std::strerror(errno));
    watch(epoll_.get(), listen_.fd.get(), kListenId, EPOLLIN);
    watch(epoll_.get(), wake_.get(), kWakeId, EPOLLIN);
}

void HttpServer::Loop::start() {
    thread_ = std::thread([self = shared_from_this()] {
        try {
            self->run();
        } catch (const std::exception& error) {
            logError(std::string("the server's socket thread ended: ") + error.what());
        }
    });
}

bool HttpServer::Loop::stop(double seconds) {
    const auto deadline = Clock::now() + secondsOf(seconds);
    stopBy_ = deadline.time_since_epoch().count();
    stopping_ = true;
    wake();
    if (thread_.joinable()) thread_.join();
    bool ended = true;
    for (auto* pool : {&control_, &render_, &stream_})
        ended = pool->stop(deadline) && ended;
    return ended;
}

ServerCounters HttpServer::Loop::counters() const {
    return {accepted_.load(), requests_.load(), refused_.load(), sentBytes_.load(), open_.load()};
}

void HttpServer::Loop::wake() const {
    const std::uint64_t one = 1;
    // The counter cannot overflow and a wake that is already pending is enough.
    [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

void HttpServer::Loop::run() {
    std::array<epoll_event, 256> events{};
    auto nextTick = Clock::now();
    bool closing = false;
    for (;;) {
        const int count = ::epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()), kTickMs);
        for (int i = 0; i < count; ++i) {
            const auto& event = events.at(static_cast<std::size_t>(i));
            if (event.data.u64 == kListenId)
                acceptAll();
            else if (event.data.u64 == kWakeId)
                takeFinished();
            else if (const auto found = connections_.find(event.data.u64); found != connections_.end())
                onEvent(ConnectionPtr(found->second), event.events);
        }
        const auto now = Clock::now();
        if (now >= nextTick || stopping_) {
            expire(now);
            nextTick = now + std::chrono::milliseconds(kTickMs);
        }
        if (!stopping_) continue;
        if (!closing) {
            closing = true;
            ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, listen_.fd.get(), nullptr);
            listen_.fd.reset();
            for (const auto& [id, connection] : connections_)
                connection->gone->store(true);
        }
        std::erase_if(connections_, [](const auto& entry) {
            return entry.second->phase != Phase::Handling && entry.second->phase != Phase::Writing;
        });
        if (connections_.empty() || now.time_since_epoch().count() >= stopBy_) break;
    }
    connections_.clear();
}

void HttpServer::Loop::acceptAll() {
    for (int i = 0; i < kAcceptsPerRound && listen_.fd.valid(); ++i) {
        UniqueFd fd(::accept4(listen_.fd.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (fd.valid()) {
            ++accepted_;
            admitConnection(std::move(fd));
            continue;
        }
        if (errno == EMFILE || errno == ENFILE) {
            // No descriptor left: without this the pending connection would wake us for ever.
            reserve_.reset();
            UniqueFd(::accept4(listen_.fd.get(), nullptr, nullptr, SOCK_CLOEXEC)).reset();
            reserve_ = spareDescriptor();
            ++refused_;
            return;
        }
        // EAGAIN: no more. Anything else belongs to one connection that is already gone.
        if (errno == EAGAIN || errno == EWOULDBLOCK) return;
    }
}

/// Closes the connection that has been idle longest. False if none is idle.
bool HttpServer::Loop::makeRoom() {
    ConnectionPtr oldest;
    for (const auto& [id, connection] : connections_) {
        if (connection->phase != Phase::Head || connection->headBegun) continue;
        if (!oldest || connection->deadline < oldest->deadline) oldest = connection;
    }
    if (oldest) drop(oldest);
    return oldest != nullptr;
}

void HttpServer::Loop::admitConnection(UniqueFd fd) {
    auto connection = std::make_shared<Connection>();
    connection->peer = peerOf(fd.get());
    const bool full = static_cast<int>(connections_.size()) >= options_.maxConnections && !makeRoom();
    const auto same = perAddress_.find(connection->peer.remoteAddress);
    if (full || (same != perAddress_.end() && same->second >= options_.maxConnectionsPerAddress)) {
        ++refused_;
        constexpr std::string_view busy =
            "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 2\r\nContent-Length: 0\r\n"
            "Connection: close\r\n\r\n";
        [[maybe_unused]] const auto sent =
            ::send(fd.get(), busy.data(), busy.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        return;
    }
    const int on = 1;
    ::setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    connection->id = nextId_++;
    connection->fd = std::move(fd);
    connection->deadline = Clock::now() + secondsOf(options_.headSeconds);
    ++perAddress_[connection->peer.remoteAddress];
    ++open_;
    connections_.emplace(connection->id, connection);
    watch(epoll_.get(), connection->fd.get(), connection->id, EPOLLIN | EPOLLONESHOT);
}

void HttpServer::Loop::drop(const ConnectionPtr& connection) {
    connection->gone->store(true);
    bufferedBytes_ -= std::exchange(connection->reservedBytes, 0);
    if (connections_.erase(connection->id) == 0) return;
    --open_;
    const auto count = perAddress_.find(connection->peer.remoteAddress);
    if (count != perAddress_.end() && --count->second <= 0) perAddress_.erase(count);
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, connection->fd.get(), nullptr);
    ::shutdown(connection->fd.get(), SHUT_RDWR);
}

/// One event at a time: whoever handles it arms the next.
void HttpServer::Loop::arm(const Connection& connection, std::uint32_t events) const {
    epoll_event event{};
    event.events = events | EPOLLONESHOT;
    event.data.u64 = connection.id;
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, connection.fd.get(), &event);
}

void HttpServer::Loop::onEvent(const ConnectionPtr& connection, std::uint32_t events) {
    try {
        switch (connection->phase) {
        case Phase::Handling:
            connection->gone->store(true);
            return; // hung up; its thread finds out
        case Phase::Writing:
            if ((events & (EPOLLERR | EPOLLHUP)) != 0)
                drop(connection);
            else
                send(connection);
            return;
        case Phase::Draining:
            drain(connection);
            return;
        case Phase::Head:
        case Phase::Body:
            break;
        }
        if (receive(connection, std::size_t{256} << 10U))
            advance(connection);
        else
            drop(connection);
    } catch (const std::exception& error) { // no memory left: costs this connection only
        logError(std::string("a connection was closed: ") + error.what());
        drop(connection);
    }
}

void HttpServer::Loop::expire(Clock::time_point now) {
    std::vector<ConnectionPtr> late;
    for (const auto& [id, connection] : connections_)
        if (connection->phase != Phase::Handling && now >= connection->deadline) late.push_back(connection);
    for (const auto& connection : late) {
        const bool begun =
            (connection->phase == Phase::Head && connection->headBegun) || connection->phase == Phase::Body;
        if (begun && !stopping_)
            refuse(connection, 408, "the request did not arrive in time");
        else
            drop(connection);
    }
}

void HttpServer::Loop::takeFinished() {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto got = ::read(wake_.get(), &count, sizeof count);
    std::vector<ConnectionPtr> done;
    {
        const std::lock_guard lock(finishedMutex_);
        done.swap(finished_);
    }
    for (const auto& connection : done)
        finished(connection);
}

HttpServer::HttpServer(const ServerOptions& options, Admit admit, Refuse refuse)
    : loop_(std::make_shared<Loop>(options, std::move(admit), std::move(refuse))) {}

HttpServer::~HttpServer() { stop(); }

int HttpServer::port() const { return loop_->socket().port; }
const std::string& HttpServer::host() const { return loop_->socket().host; }
void HttpServer::start() { loop_->start(); }
bool HttpServer::stop(double seconds) { return loop_->stop(seconds); }
ServerCounters HttpServer::counters() const { return loop_->counters(); }

} // namespace voxsheet::http
