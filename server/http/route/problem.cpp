#include "http/route/problem.h"

#include "base/log.h"

#include <algorithm>
#include <array>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

namespace voxsheet::http {

namespace {

constexpr std::array<std::pair<int, const char*>, 23> kReasons{{
    {400, "Bad Request"},
    {401, "Unauthorized"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {408, "Request Timeout"},
    {409, "Conflict"},
    {411, "Length Required"},
    {412, "Precondition Failed"},
    {413, "Content Too Large"},
    {414, "URI Too Long"},
    {415, "Unsupported Media Type"},
    {416, "Range Not Satisfiable"},
    {417, "Expectation Failed"},
    {421, "Misdirected Request"},
    {422, "Unprocessable Content"},
    {431, "Request Header Fields Too Large"},
    {500, "Internal Server Error"},
    {501, "Not Implemented"},
    {503, "Service Unavailable"},
    {504, "Gateway Timeout"},
    {505, "HTTP Version Not Supported"},
    {507, "Insufficient Storage"},
}};

} // namespace

int statusOf(ErrorKind kind) noexcept {
    switch (kind) {
    case ErrorKind::InvalidInput:
        return 400;
    case ErrorKind::NotFound:
        return 404;
    case ErrorKind::Conflict:
        return 409;
    case ErrorKind::Unsupported:
        return 501;
    case ErrorKind::LimitExceeded:
        return 413;
    case ErrorKind::Cancelled:
        return 503;
    case ErrorKind::GpuError:
        return 503;
    case ErrorKind::IoError:
        return 500;
    case ErrorKind::Internal:
        return 500;
    }
    return 500;
}

std::string reasonPhrase(int status) {
    const auto* found =
        std::find_if(kReasons.begin(), kReasons.end(), [&](const auto& row) { return row.first == status; });
    if (found != kReasons.end()) return found->second;
    return status >= 500 ? "Server Error" : "Client Error";
}

Response problem(int status, const std::string& detail, const std::string& field) {
    nlohmann::ordered_json body{{"title", reasonPhrase(status)}, {"status", status}, {"detail", detail}};
    if (!field.empty()) body["field"] = field;
    // Replace: a file name in the text need not be UTF-8.
    Response response{status, "application/problem+json",
                      body.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
    response.headers.add("Cache-Control", "no-store");
    if (status == 401) response.headers.add("WWW-Authenticate", "Bearer realm=\"voxsheet\"");
    if (status == 503) response.headers.add("Retry-After", "1");
    return response;
}

Response currentProblem() noexcept {
    try {
        throw;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::Internal || error.kind() == ErrorKind::IoError) logError(error.what());
        return problem(statusOf(error.kind()), error.what(), error.field());
    } catch (const HttpError& error) {
        return problem(error.status(), error.what());
    } catch (const std::bad_alloc&) {
        logError("a request failed: no memory left");
        return problem(503, "there is not enough memory left for this; free some by removing datasets");
    } catch (const std::exception& error) {
        logError(std::string("a request failed: ") + error.what());
    } catch (...) {
        logError("a request failed for an unknown reason");
    }
    return problem(500, "this is a fault of the program; its log says more");
}

} // namespace voxsheet::http
