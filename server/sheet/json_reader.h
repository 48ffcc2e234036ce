// Reads a JSON document strictly: every complaint names the member by its path, e.g.
// `sheets[0].cells.B2.title`.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

/// A view of a value; the document must outlive it. Everything that does not fit throws InvalidInput (field =
/// path).
class JsonReader {
public:
    explicit JsonReader(const nlohmann::json& document) : value_(&document) {}

    [[nodiscard]] const nlohmann::json& value() const { return *value_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Of a member: its name in the object.
    [[nodiscard]] const std::string& name() const { return name_; }

    void requireObject() const;
    /// Only these members, and an object.
    void allow(std::initializer_list<const char*> names) const;
    [[nodiscard]] std::optional<JsonReader> find(const char* member) const;
    [[nodiscard]] JsonReader at(const char* member) const;
    [[nodiscard]] std::vector<JsonReader> members() const;
    [[nodiscard]] std::vector<JsonReader> items() const;

    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::int64_t integer(std::int64_t min, std::int64_t max) const;
    [[nodiscard]] double number() const;
    [[nodiscard]] bool boolean() const;

    [[noreturn]] void refuse(const std::string& why, const std::string& toDo) const;

private:
    JsonReader(const nlohmann::json& value, std::string path, std::string name)
        : value_(&value), path_(std::move(path)), name_(std::move(name)) {}
    [[nodiscard]] JsonReader member(const std::string& name, const nlohmann::json& value) const;

    const nlohmann::json* value_;
    std::string path_;
    std::string name_;
};

} // namespace voxsheet::sheet
