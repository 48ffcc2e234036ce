#include "base/errors.h"

#include <array>
#include <utility>

namespace voxsheet {

namespace {

std::string sentence(const std::string& what, const std::string& why, const std::string& toDo) {
    std::string text = what;
    if (!why.empty()) text += ": " + why;
    if (!toDo.empty()) text += "; " + toDo;
    return text;
}

constexpr std::array<std::pair<ErrorKind, const char*>, 9> kNames{{
    {ErrorKind::InvalidInput, "invalid-input"},
    {ErrorKind::NotFound, "not-found"},
    {ErrorKind::Conflict, "conflict"},
    {ErrorKind::Unsupported, "unsupported"},
    {ErrorKind::LimitExceeded, "limit-exceeded"},
    {ErrorKind::Cancelled, "cancelled"},
    {ErrorKind::GpuError, "gpu-error"},
    {ErrorKind::IoError, "io-error"},
    {ErrorKind::Internal, "internal"},
}};

} // namespace

Error::Error(ErrorKind kind, std::string what, std::string why, std::string toDo)
    : std::runtime_error(sentence(what, why, toDo)), kind_(kind), subject_(std::move(what)),
      why_(std::move(why)), toDo_(std::move(toDo)) {}

const char* errorKindName(ErrorKind kind) noexcept {
    for (const auto& [value, name] : kNames)
        if (value == kind) return name;
    return "internal";
}

ErrorKind errorKindFromName(const std::string& name) noexcept {
    for (const auto& [value, text] : kNames)
        if (name == text) return value;
    return ErrorKind::Internal;
}

} // namespace voxsheet
