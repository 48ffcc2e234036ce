// Failures as RFC 9457 problems. The one place where kinds of errors become HTTP statuses.
#pragma once

#include "base/errors.h"
#include "http/message/response.h"

#include <exception>
#include <string>

namespace voxsheet::http {

/// A failure of the protocol rather than of the program: no such route, wrong method, wrong media type.
class HttpError : public std::exception {
public:
    HttpError(int status, std::string detail) : status_(status), detail_(std::move(detail)) {}
    [[nodiscard]] const char* what() const noexcept override { return detail_.c_str(); }
    [[nodiscard]] int status() const { return status_; }

private:
    int status_;
    std::string detail_;
};

[[nodiscard]] int statusOf(ErrorKind kind) noexcept;
/// "Not Found", …; the class's name for a status that is not known.
[[nodiscard]] std::string reasonPhrase(int status);

/// {"title", "status", "detail", "field"?}; field is left out when empty.
[[nodiscard]] Response problem(int status, const std::string& detail, const std::string& field = {});

/// The exception being handled, as a problem; what no user should read (the text of a foreign exception) goes
/// to the log.
[[nodiscard]] Response currentProblem() noexcept;

} // namespace voxsheet::http
