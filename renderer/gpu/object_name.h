// A GL object's name that is moved, never copied; 0 when moved from.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace voxsheet::gpu {

class Context;

class ObjectName {
public:
    ObjectName() = default;
    ObjectName(Context& context, GLuint id) : context_(&context), id_(id) {}
    ObjectName(ObjectName&& other) noexcept : context_(other.context_), id_(std::exchange(other.id_, 0U)) {}
    ObjectName& operator=(ObjectName&& other) noexcept {
        std::swap(context_, other.context_);
        std::swap(id_, other.id_);
        return *this;
    }
    ObjectName(const ObjectName&) = delete;
    ObjectName& operator=(const ObjectName&) = delete;
    ~ObjectName() = default;

    [[nodiscard]] Context& context() const { return *context_; }
    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] explicit operator bool() const { return id_ != 0; }

private:
    Context* context_ = nullptr;
    GLuint id_ = 0;
};

} // namespace voxsheet::gpu
