#include "http/net/listen_socket.h"

#include "base/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <vector>

namespace voxsheet::http {

namespace {

constexpr int kBacklog = 1024;
constexpr int kPortsToTry = 100;

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

AddressList resolve(const std::string& host, int port) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    addrinfo* list = nullptr;
    const int code = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
    if (code != 0)
        throw InvalidInput("host '" + host + "'", gai_strerror(code), "name an address of this machine")
            .withField("host");
    return {list, &freeaddrinfo};
}

/// 0 or errno.
int bindAndListen(const addrinfo& address, UniqueFd& out) {
    UniqueFd fd(
        ::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, address.ai_protocol));
    if (!fd.valid()) return errno;
    const int on = 1;
    // Only lets a restart bind while old connections linger; on Linux it never lets two listeners share a
    // port.
    ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (::bind(fd.get(), address.ai_addr, address.ai_addrlen) != 0) return errno;
    if (::listen(fd.get(), kBacklog) != 0) return errno;
    out = std::move(fd);
    return 0;
}

ListenSocket described(UniqueFd fd) {
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    std::vector<char> host(NI_MAXHOST);
    std::vector<char> port(NI_MAXSERV);
    if (::getsockname(fd.get(), reinterpret_cast<sockaddr*>(&address), &length) != 0 ||
        ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), length, host.data(), NI_MAXHOST,
                      port.data(), NI_MAXSERV, NI_NUMERICHOST | NI_NUMERICSERV) != 0)
        throw IoError("listening socket", "its own address cannot be read");
    return {std::move(fd), host.data(), std::stoi(port.data())};
}

[[noreturn]] void cannotListen(const std::string& host, int port, int code) {
    const std::string what = "port " + std::to_string(port) + " of " + host;
    if (code == EADDRINUSE)
        throw Conflict(what, "another program is listening there",
                       "stop it, or choose another port with --port (0 takes any free one)")
            .withField("port");
    if (code == EADDRNOTAVAIL)
        throw InvalidInput("host '" + host + "'", "it is not an address of this machine",
                           "use 127.0.0.1 for this machine only or 0.0.0.0 for all its networks")
            .withField("host");
    throw IoError(what, std::strerror(code), code == EACCES ? "choose a port above 1023" : "");
}

} // namespace

ListenSocket listenOn(const std::string& host, int port, bool nextFreePort) {
    if (port < 0 || port > 65535)
        throw InvalidInput("port " + std::to_string(port), "it is not between 0 and 65535").withField("port");
    const int last = nextFreePort && port != 0 ? std::min(65535, port + kPortsToTry) : port;
    int code = 0;
    for (int candidate = port; candidate <= last; ++candidate) {
        const auto addresses = resolve(host, candidate);
        for (const addrinfo* address = addresses.get(); address != nullptr; address = address->ai_next) {
            UniqueFd fd;
            code = bindAndListen(*address, fd);
            if (code == 0) return described(std::move(fd));
        }
        if (code != EADDRINUSE) break;
    }
    cannotListen(host, port, code);
}

int raiseOpenFileLimit(int wanted) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 1024;
    const auto target = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(wanted));
    if (limit.rlim_cur < target) {
        limit.rlim_cur = target;
        if (::setrlimit(RLIMIT_NOFILE, &limit) != 0) ::getrlimit(RLIMIT_NOFILE, &limit);
    }
    return static_cast<int>(std::min<rlim_t>(limit.rlim_cur, 1U << 30U));
}

} // namespace voxsheet::http
