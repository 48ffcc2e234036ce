// Shader text from embedded .glsl files: includes, defines, and a map back to files and lines. Pure, no GL.
#pragma once

#include "base/embedded.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxsheet::gpu {

using ShaderFiles = std::span<const EmbeddedFile>;
using ShaderDefines = std::vector<std::pair<std::string, std::string>>; ///< name, text; in order

struct ShaderText {
    std::string name; ///< path of the main file
    std::string text; ///< complete GLSL, "#version" first

    struct Origin {
        int file; ///< index into files; -1: injected
        int line; ///< from 1
    };
    std::vector<std::string> files;
    std::vector<Origin> lines; ///< one per line of text
};

/// Expands the file `path` of `files`.
/// A line `#include "NAME"` is replaced by the file NAME, looked up in the including file's folder, then from
/// the root of `files`; a file that was included before is not included again. `defines` become `#define NAME
/// TEXT` after the
/// `#version` line of the main file ("#version 450 core" when it has none).
/// Throws GpuError (naming file and line) for a missing file, a cycle, or a malformed include.
[[nodiscard]] ShaderText expandShader(ShaderFiles files, std::string_view path,
                                      const ShaderDefines& defines = {});

/// Rewrites a driver's log, whose lines count in `shader.text`, to `file:line: text`. Understands the forms
/// of Mesa
/// ("0:12(5): error: …"), NVIDIA ("0(12) : error …") and others ("ERROR: 0:12: …"); other lines stay as they
/// are.
[[nodiscard]] std::string mapShaderLog(const ShaderText& shader, std::string_view log);

} // namespace voxsheet::gpu
