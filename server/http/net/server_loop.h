// The thread that owns every socket. Private to net/.
#pragma once

#include "http/net/connection.h"
#include "http/net/http_server.h"
#include "http/net/listen_socket.h"
#include "http/net/worker_pool.h"

#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace voxsheet::http {

class HttpServer::Loop : public std::enable_shared_from_this<HttpServer::Loop> {
public:
    Loop(const ServerOptions& options, Admit admit, Refuse refuse);
    ~Loop() = default;

    void start();
    bool stop(double seconds);
    [[nodiscard]] const ListenSocket& socket() const { return listen_; }
    [[nodiscard]] ServerCounters counters() const;

private:
    using ConnectionPtr = std::shared_ptr<Connection>;

    // accepting (server_loop.cpp)
    void run();
    void acceptAll();
    void admitConnection(UniqueFd fd);
    bool makeRoom();
    void drop(const ConnectionPtr& connection);
    void arm(const Connection& connection, std::uint32_t events) const;
    void onEvent(const ConnectionPtr& connection, std::uint32_t events);
    void expire(Clock::time_point now);
    void takeFinished();
    void wake() const;

    // requests (request_phases.cpp)
    static bool receive(const ConnectionPtr& connection, std::size_t limit);
    void awaitMore(const ConnectionPtr& connection);
    void advance(const ConnectionPtr& connection);
    bool readHead(const ConnectionPtr& connection);
    bool beginBody(const ConnectionPtr& connection);
    bool readBody(const ConnectionPtr& connection);
    void dispatch(const ConnectionPtr& connection);
    void execute(const ConnectionPtr& connection);
    void finished(const ConnectionPtr& connection);
    void send(const ConnectionPtr& connection);
    void refuse(const ConnectionPtr& connection, int status, const std::string& detail);
    void respond(const ConnectionPtr& connection, Response response, bool keepAlive);
    void nextRequest(const ConnectionPtr& connection);
    void drain(const ConnectionPtr& connection);

    ServerOptions options_;
    Admit admit_;
    Refuse refuse_;
    ListenSocket listen_;
    UniqueFd epoll_;
    UniqueFd wake_;
    UniqueFd reserve_; ///< given up to accept and close a connection when no descriptor is left
    std::thread thread_;
    std::atomic<bool> stopping_{false};
    std::atomic<Clock::rep> stopBy_{0};

    std::uint64_t nextId_ = 2; ///< 0 and 1 are the listening and the waking descriptor
    std::unordered_map<std::uint64_t, ConnectionPtr> connections_;
    std::unordered_map<std::string, int> perAddress_;
    std::uint64_t bufferedBytes_ = 0;

    std::mutex finishedMutex_;
    std::vector<ConnectionPtr> finished_;

    std::atomic<std::uint64_t> accepted_{0};
    std::atomic<std::uint64_t> requests_{0};
    std::atomic<std::uint64_t> refused_{0};
    std::atomic<std::uint64_t> sentBytes_{0};
    std::atomic<int> open_{0};

    WorkerPool control_;
    WorkerPool render_;
    WorkerPool stream_;
};

} // namespace voxsheet::http
