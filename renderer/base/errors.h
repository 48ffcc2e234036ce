// The one error family. Each kind maps to an exit code (server/cli) and an HTTP status (server/http) in one
// place.
#pragma once

#include <stdexcept>
#include <string>

namespace voxsheet {

enum class ErrorKind {
    InvalidInput,  ///< the caller's value, file or document is wrong; nothing was changed
    NotFound,      ///< a named thing does not exist
    Conflict,      ///< the thing exists already, or changed in between
    Unsupported,   ///< well formed, but this build or device cannot do it
    LimitExceeded, ///< a budget of memory, time, size or number would be broken
    Cancelled,     ///< stopped on request
    GpuError,      ///< EGL, OpenGL or a shader failed
    IoError,       ///< reading or writing a file failed
    Internal,      ///< a fault of this program
};

/// A failure in the words that a user reads: `what: why; what to do`.
class Error : public std::runtime_error {
public:
    /// \param what  the thing at fault, e.g. a file, a key, a device
    /// \param why   one clause
    /// \param toDo  what the user can do about it; may be empty
    Error(ErrorKind kind, std::string what, std::string why, std::string toDo = {});

    [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
    [[nodiscard]] const std::string& subject() const noexcept { return subject_; }
    [[nodiscard]] const std::string& why() const noexcept { return why_; }
    [[nodiscard]] const std::string& toDo() const noexcept { return toDo_; }

    /// The style key, JSON member or option at fault; empty when none is.
    [[nodiscard]] const std::string& field() const noexcept { return field_; }
    Error& withField(std::string field) & {
        field_ = std::move(field);
        return *this;
    }

private:
    ErrorKind kind_;
    std::string subject_;
    std::string why_;
    std::string toDo_;
    std::string field_;
};

/// Same text, kind by type, so that `throw InvalidInput(...)` reads well and can be caught apart.
template <ErrorKind Kind>
class ErrorOf : public Error {
public:
    explicit ErrorOf(std::string what, std::string why, std::string toDo = {})
        : Error(Kind, std::move(what), std::move(why), std::move(toDo)) {}
    using Error::withField;
    /// `throw InvalidInput(...).withField("camera.fov")`
    ErrorOf withField(std::string field) && {
        Error::withField(std::move(field));
        return std::move(*this);
    }
};

using InvalidInput = ErrorOf<ErrorKind::InvalidInput>;
using NotFound = ErrorOf<ErrorKind::NotFound>;
using Conflict = ErrorOf<ErrorKind::Conflict>;
using Unsupported = ErrorOf<ErrorKind::Unsupported>;
using LimitExceeded = ErrorOf<ErrorKind::LimitExceeded>;
using Cancelled = ErrorOf<ErrorKind::Cancelled>;
using GpuError = ErrorOf<ErrorKind::GpuError>;
using IoError = ErrorOf<ErrorKind::IoError>;
using InternalError = ErrorOf<ErrorKind::Internal>;

/// Stable lower-case word for logs and JSON: "invalid-input", "not-found", …
[[nodiscard]] const char* errorKindName(ErrorKind kind) noexcept;
/// Inverse of errorKindName; unknown words give ErrorKind::Internal.
[[nodiscard]] ErrorKind errorKindFromName(const std::string& name) noexcept;

} // namespace voxsheet
