#include "gpu/shader_source.h"

#include "base/errors.h"

#include <algorithm>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace voxsheet::gpu {

namespace {

constexpr std::string_view kDefaultVersion = "#version 450 core";

std::string folderOf(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? std::string{} : std::string(path.substr(0, slash + 1));
}

std::string_view trimLeft(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : line.substr(first);
}

bool isDirective(std::string_view line, std::string_view name) {
    std::string_view rest = trimLeft(line);
    if (rest.empty() || rest.front() != '#') return false;
    rest = trimLeft(rest.substr(1));
    return rest.substr(0, name.size()) == name;
}

std::vector<std::string> splitLines(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        lines.emplace_back(line);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
    return lines;
}

class Expander {
public:
    Expander(ShaderFiles files, const ShaderDefines& defines) : files_(files), defines_(defines) {}

    ShaderText expand(std::string_view path) {
        const EmbeddedFile* file = find(path);
        if (file == nullptr) {
            throw GpuError("shader " + std::string(path), "it is not among the embedded files");
        }
        shader_.name = path;
        const bool hasVersion = startsWithVersion(*file);
        if (!hasVersion) {
            emit(std::string(kDefaultVersion), {-1, 1});
            emitDefines();
        }
        addFile(*file, hasVersion);
        return std::move(shader_);
    }

private:
    [[nodiscard]] const EmbeddedFile* find(std::string_view path) const {
        for (const EmbeddedFile& file : files_) {
            if (file.path != nullptr && path == file.path) return &file;
        }
        return nullptr;
    }

    [[nodiscard]] static bool startsWithVersion(const EmbeddedFile& file) {
        const auto lines = splitLines(file.bytes());
        return std::any_of(lines.begin(), lines.end(),
                           [](const std::string& line) { return isDirective(line, "version"); });
    }

    void emit(const std::string& line, ShaderText::Origin origin) {
        shader_.text += line;
        shader_.text += '\n';
        shader_.lines.push_back(origin);
    }

    void emitDefines() {
        for (const auto& [name, text] : defines_)
            emit("#define " + name + " " + text, {-1, 1});
    }

    /// `mainWithVersion`: the file's #version line goes first, whatever comments stand before it.
    void addFile(const EmbeddedFile& file, bool mainWithVersion) {
        const std::string path = file.path;
        included_.insert(path);
        open_.push_back(path);
        const int fileIndex = static_cast<int>(shader_.files.size());
        shader_.files.push_back(path);

        const auto lines = splitLines(file.bytes());
        auto versionLine = lines.end();
        if (mainWithVersion) {
            versionLine = std::find_if(lines.begin(), lines.end(),
                                       [](const std::string& line) { return isDirective(line, "version"); });
            emit(*versionLine, {fileIndex, static_cast<int>(versionLine - lines.begin()) + 1});
            emitDefines();
        }
        for (auto line = lines.begin(); line != lines.end(); ++line) {
            if (line == versionLine) continue;
            const int number = static_cast<int>(line - lines.begin()) + 1;
            if (isDirective(*line, "include")) {
                include(path, number, *line);
            } else {
                emit(*line, {fileIndex, number});
            }
        }
        open_.pop_back();
    }

    void include(const std::string& from, int lineNumber, const std::string& line) {
        const std::string where = from + ":" + std::to_string(lineNumber);
        static const std::regex pattern(R"re(^\s*#\s*include\s+"([^"]+)"\s*(//.*)?$)re");
        std::smatch match;
        if (!std::regex_match(line, match, pattern)) {
            throw GpuError("shader " + where, "an include must read #include \"NAME\"");
        }
        const std::string name = match[1];
        const EmbeddedFile* file = find(folderOf(from) + name);
        if (file == nullptr) file = find(name);
        if (file == nullptr)
            throw GpuError("shader " + where, "the included file '" + name + "' does not exist");
        if (std::find(open_.begin(), open_.end(), file->path) != open_.end()) {
            throw GpuError("shader " + where, "including '" + name + "' closes a cycle");
        }
        if (included_.count(file->path) == 0) addFile(*file, false);
    }

    ShaderFiles files_;
    const ShaderDefines& defines_;
    ShaderText shader_;
    std::set<std::string> included_;
    std::vector<std::string> open_;
};

/// The line number, and what follows it, in one line of a driver's log.
struct LogLine {
    std::size_t line;
    std::string text;
};

std::optional<LogLine> parseLogLine(const std::string& line) {
    static const std::regex forms[] = {
        std::regex(R"(^\d+:(\d+)\(\d+\): (.*)$)"),               // Mesa
        std::regex(R"(^\d+\((\d+)\) : (.*)$)"),                  // NVIDIA
        std::regex(R"(^((?:ERROR|WARNING): )\d+:(\d+): (.*)$)"), // AMD, Intel on Windows, glslang
    };
    std::smatch match;
    for (const std::regex& form : forms) {
        if (!std::regex_match(line, match, form)) continue;
        const bool prefixed = match.size() == 4;
        const std::string number = match[prefixed ? 2 : 1];
        if (number.size() > 8) return std::nullopt;
        return LogLine{std::stoul(number), prefixed ? match.str(1) + match.str(3) : match.str(2)};
    }
    return std::nullopt;
}

} // namespace

ShaderText expandShader(ShaderFiles files, std::string_view path, const ShaderDefines& defines) {
    return Expander(files, defines).expand(path);
}

std::string mapShaderLog(const ShaderText& shader, std::string_view log) {
    std::string mapped;
    for (const std::string& line : splitLines(log)) {
        if (line.empty()) continue;
        if (!mapped.empty()) mapped += '\n';
        const auto parsed = parseLogLine(line);
        if (!parsed || parsed->line == 0 || parsed->line > shader.lines.size()) {
            mapped += line;
            continue;
        }
        const ShaderText::Origin origin = shader.lines[parsed->line - 1];
        if (origin.file < 0) {
            mapped += shader.name + " (injected define): " + parsed->text;
        } else {
            mapped += shader.files[static_cast<std::size_t>(origin.file)] + ":" +
                      std::to_string(origin.line) + ": " + parsed->text;
        }
    }
    return mapped;
}

} // namespace voxsheet::gpu
