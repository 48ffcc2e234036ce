#include "raw_client.h"

#include "fields/patience.h"
#include "http/message/header_list.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>

namespace voxsheet::http_test {

namespace {

using Clock = std::chrono::steady_clock;

/// Short times are for looking whether something is there; from a second on they are limits, which a busy
/// machine stretches.
Clock::time_point after(double seconds) {
    if (seconds >= 1.0) seconds *= fields::patience();
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool waitFor(int fd, short events, Clock::time_point until) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd entry{fd, events, 0};
    return ::poll(&entry, 1, static_cast<int>(std::max<long long>(0, left))) > 0;
}

} // namespace

RawClient::RawClient(int port, double seconds)
    : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
    if (errno != EINPROGRESS || !waitFor(fd_.get(), POLLOUT, after(seconds)))
        throw std::runtime_error("no connection");
    int error = 0;
    socklen_t length = sizeof error;
    ::getsockopt(fd_.get(), SOL_SOCKET, SO_ERROR, &error, &length);
    if (error != 0) throw std::runtime_error(std::strerror(error));
}

bool RawClient::send(std::string_view bytes, double seconds) {
    auto until = after(seconds);
    while (!bytes.empty()) {
        const auto count = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(count));
            until = after(seconds);
            continue;
        }
        if (errno != EAGAIN || !waitFor(fd_.get(), POLLOUT, until)) return false;
    }
    return true;
}

RawClient::Read RawClient::readSome(double seconds) {
    const auto until = after(seconds);
    for (;;) {
        std::array<char, 65536> buffer; // NOLINT: filled by recv
        const auto count = ::recv(fd_.get(), buffer.data(), buffer.size(), 0);
        if (count > 0) {
            received_.append(buffer.data(), static_cast<std::size_t>(count));
            return Read::Data;
        }
        if (count == 0 || (errno != EAGAIN && errno != EINTR)) return Read::End;
        if (!waitFor(fd_.get(), POLLIN, until)) return Read::Timeout;
    }
}

std::string RawClient::readAll(double seconds) {
    const auto until = after(seconds);
    while (Clock::now() < until) {
        const double left = std::chrono::duration<double>(until - Clock::now()).count();
        if (readSome(left) != Read::Data) break;
    }
    return std::exchange(received_, {});
}

std::string RawClient::readResponse(double seconds) {
    const auto until = after(seconds);
    for (;;) {
        const auto end = received_.find("\r\n\r\n");
        if (end != std::string::npos) {
            std::size_t length = 0;
            if (const auto text = fieldOfResponse(received_, "Content-Length")) length = std::stoul(*text);
            if (received_.size() >= end + 4 + length) {
                auto response = received_.substr(0, end + 4 + length);
                received_.erase(0, end + 4 + length);
                return response;
            }
        }
        const double left = std::chrono::duration<double>(until - Clock::now()).count();
        if (left <= 0 || readSome(left) != Read::Data) return {};
    }
}

bool RawClient::closedWithin(double seconds) {
    const auto until = after(seconds);
    for (;;) {
        const double left = std::chrono::duration<double>(until - Clock::now()).count();
        if (left <= 0) return false;
        if (readSome(left) == Read::End) return true;
    }
}

void RawClient::closeSendingHalf() { ::shutdown(fd_.get(), SHUT_WR); }

void RawClient::abort() {
    const linger hard{1, 0};
    ::setsockopt(fd_.get(), SOL_SOCKET, SO_LINGER, &hard, sizeof hard);
    fd_.reset();
}

int statusOfResponse(std::string_view response) {
    if (!response.starts_with("HTTP/1.1 ") || response.size() < 12) return 0;
    int status = 0;
    std::from_chars(response.data() + 9, response.data() + 12, status);
    return status;
}

std::string bodyOfResponse(std::string_view response) {
    const auto end = response.find("\r\n\r\n");
    return end == std::string_view::npos ? std::string{} : std::string(response.substr(end + 4));
}

std::optional<std::string> fieldOfResponse(std::string_view response, std::string_view name) {
    auto head = response.substr(0, response.find("\r\n\r\n"));
    while (!head.empty()) {
        const auto end = head.find("\r\n");
        const auto line = head.substr(0, end);
        const auto colon = line.find(':');
        if (colon != std::string_view::npos && http::equalIgnoringCase(line.substr(0, colon), name))
            return std::string(http::trimmed(line.substr(colon + 1)));
        if (end == std::string_view::npos) break;
        head.remove_prefix(end + 2);
    }
    return std::nullopt;
}

std::string exchange(int port, std::string_view bytes, double seconds) {
    RawClient client(port);
    client.send(bytes, seconds);
    return client.readAll(seconds);
}

std::string getRequest(const std::string& path, const std::string& fields) {
    return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + fields + "\r\n";
}

} // namespace voxsheet::http_test
