#include "import/client/import_protocol.h"

#include "store/meta_json.h"
#include "store/store_key.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

using nlohmann::json;

json toJson(const FilePreview& preview) {
    return {{"header",
             {{"dataset", store::metaToJson(preview.meta)},
              {"voxel_bytes", preview.voxelBytes},
              {"files", preview.files}}}};
}

json toJson(const ProgressMessage& message) { return {{"progress", message.fraction}}; }

json toJson(const KeyMessage& message) { return {{"key", message.key}}; }

json toJson(const ReadingTime& time) {
    return {{"measured",
             {{"header_seconds", time.headerSeconds},
              {"data_seconds", time.dataSeconds},
              {"voxel_bytes", time.voxelBytes}}}};
}

json toJson(const ErrorMessage& error) {
    return {{"error",
             {{"kind", errorKindName(error.kind)},
              {"what", error.what},
              {"why", error.why},
              {"todo", error.toDo},
              {"field", error.field}}}};
}

FilePreview headerFromJson(const json& j) {
    return {store::metaFromJson(j.at("dataset")), store::countFromJson(j.at("voxel_bytes"), "voxel_bytes"),
            j.at("files").get<std::vector<std::string>>()};
}

ErrorMessage errorFromJson(const json& j) {
    return {errorKindFromName(j.at("kind").get<std::string>()), j.at("what").get<std::string>(),
            j.at("why").get<std::string>(), j.at("todo").get<std::string>(),
            j.at("field").get<std::string>()};
}

ImporterMessage messageFromJson(const json& j) {
    if (j.contains("header")) return headerFromJson(j.at("header"));
    if (j.contains("progress")) return ProgressMessage{std::clamp(j.at("progress").get<double>(), 0.0, 1.0)};
    if (j.contains("error")) return errorFromJson(j.at("error"));
    if (j.contains("measured")) {
        const auto& time = j.at("measured");
        return ReadingTime{time.at("header_seconds").get<double>(), time.at("data_seconds").get<double>(),
                           store::countFromJson(time.at("voxel_bytes"), "voxel_bytes")};
    }
    KeyMessage message{j.at("key").get<std::string>()};
    if (!store::isStoreKey(message.key))
        throw InvalidInput("answer of the importer", "it names no store key");
    return message;
}

} // namespace

std::string encodeMessage(const ImporterMessage& message) {
    const auto j = std::visit([](const auto& m) { return toJson(m); }, message);
    return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

ImporterMessage decodeMessage(std::string_view line) {
    const auto j = store::parseJson(line, "answer of the importer");
    try {
        return messageFromJson(j);
    } catch (const json::exception& error) {
        throw InvalidInput("answer of the importer", error.what());
    }
}

ErrorMessage errorMessage(const Error& error) {
    return {error.kind(), error.subject(), error.why(), error.toDo(), error.field()};
}

void throwError(const ErrorMessage& e) {
    switch (e.kind) {
    case ErrorKind::InvalidInput:
        throw InvalidInput(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::NotFound:
        throw NotFound(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::Conflict:
        throw Conflict(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::Unsupported:
        throw Unsupported(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::LimitExceeded:
        throw LimitExceeded(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::Cancelled:
        throw Cancelled(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::GpuError:
        throw GpuError(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::IoError:
        throw IoError(e.what, e.why, e.toDo).withField(e.field);
    case ErrorKind::Internal:
        break;
    }
    throw InternalError(e.what, e.why, e.toDo).withField(e.field);
}

} // namespace voxsheet::import
