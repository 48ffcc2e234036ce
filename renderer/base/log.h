// Logging of the renderer: a line goes to the sink that the program installs (the server: spdlog; default:
// stderr).
#pragma once

#include <functional>
#include <string_view>

namespace voxsheet {

enum class LogLevel { Debug, Info, Warning, Error };

using LogSink = std::function<void(LogLevel, std::string_view message)>;

/// Thread-safe. The sink may be called from any thread, one call at a time.
void setLogSink(LogSink sink);
void logMessage(LogLevel level, std::string_view message);

inline void logInfo(std::string_view message) { logMessage(LogLevel::Info, message); }
inline void logWarning(std::string_view message) { logMessage(LogLevel::Warning, message); }
inline void logError(std::string_view message) { logMessage(LogLevel::Error, message); }

} // namespace voxsheet
