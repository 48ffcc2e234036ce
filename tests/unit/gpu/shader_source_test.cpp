#include "gpu/shader_source.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cstring>

namespace voxsheet::gpu {
namespace {

EmbeddedFile file(const char* path, const char* text) { return {path, text, text + std::strlen(text)}; }

TEST(ShaderSource, PutsVersionAndDefinesFirst) {
    const EmbeddedFile files[] = {file("a/main.glsl", "// a comment\n#version 460 core\nvoid main() {}\n")};
    const ShaderText shader = expandShader(files, "a/main.glsl", {{"WIDTH", "16"}, {"FAST", "1"}});
    EXPECT_EQ(shader.text,
              "#version 460 core\n#define WIDTH 16\n#define FAST 1\n// a comment\nvoid main() {}\n");
    ASSERT_EQ(shader.lines.size(), 5U);
    EXPECT_EQ(shader.lines[0].line, 2);
    EXPECT_EQ(shader.lines[1].file, -1);
    EXPECT_EQ(shader.lines[4].line, 3);
}

TEST(ShaderSource, AddsAVersionWhenThereIsNone) {
    const EmbeddedFile files[] = {file("main.glsl", "void main() {}")};
    EXPECT_EQ(expandShader(files, "main.glsl").text, "#version 450 core\nvoid main() {}\n");
}

TEST(ShaderSource, IncludesEachFileOnceFromItsFolderOrTheRoot) {
    const EmbeddedFile files[] = {
        file("ray/main.glsl",
             "#include \"near.glsl\"\n#include \"stages/far.glsl\"\n#include \"near.glsl\"\nM\n"),
        file("ray/near.glsl", "N\n"),
        file("stages/far.glsl", "#include \"beside.glsl\" // needed below\nF\n"),
        file("stages/beside.glsl", "B\n"),
        file("near.glsl", "WRONG\n"),
    };
    const ShaderText shader = expandShader(files, "ray/main.glsl");
    EXPECT_EQ(shader.text, "#version 450 core\nN\nB\nF\nM\n");
    EXPECT_EQ(shader.files[static_cast<std::size_t>(shader.lines[4].file)], "ray/main.glsl");
    EXPECT_EQ(shader.lines[4].line, 4);
    EXPECT_EQ(shader.files[static_cast<std::size_t>(shader.lines[3].file)], "stages/far.glsl");
    EXPECT_EQ(shader.lines[3].line, 2);
}

void expectFailure(ShaderFiles files, const char* path, const char* part) {
    try {
        (void)expandShader(files, path);
        ADD_FAILURE() << "expected an error about " << part;
    } catch (const GpuError& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(ShaderSource, RefusesCyclesMissingFilesAndMalformedIncludes) {
    const EmbeddedFile files[] = {
        file("a.glsl", "\n#include \"b.glsl\"\n"),      file("b.glsl", "#include \"a.glsl\"\n"),
        file("missing.glsl", "#include \"no.glsl\"\n"), file("bad.glsl", "x\ny\n#include <a.glsl>\n"),
        file("self.glsl", "#include \"self.glsl\"\n"),
    };
    expectFailure(files, "a.glsl", "b.glsl:1");
    expectFailure(files, "self.glsl", "cycle");
    expectFailure(files, "missing.glsl", "no.glsl");
    expectFailure(files, "bad.glsl", "bad.glsl:3");
    expectFailure(files, "absent.glsl", "absent.glsl");
}

TEST(ShaderSource, MapsDriverLogsToFilesAndLines) {
    const EmbeddedFile files[] = {
        file("main.glsl", "#version 450 core\n#include \"part.glsl\"\nbad\n"),
        file("part.glsl", "one\ntwo\n"),
    };
    const ShaderText shader = expandShader(files, "main.glsl", {{"A", "1"}});
    // 1 version, 2 define, 3 one, 4 two, 5 bad
    EXPECT_EQ(mapShaderLog(shader, "0:4(7): error: `two' undeclared\n"),
              "part.glsl:2: error: `two' undeclared");
    EXPECT_EQ(mapShaderLog(shader, "0(5) : error C0000: syntax"), "main.glsl:3: error C0000: syntax");
    EXPECT_EQ(mapShaderLog(shader, "ERROR: 0:3: 'one' : undeclared"),
              "part.glsl:1: ERROR: 'one' : undeclared");
    EXPECT_EQ(mapShaderLog(shader, "0:2(1): error: odd"), "main.glsl (injected define): error: odd");
    EXPECT_EQ(mapShaderLog(shader, "0:99(1): error: beyond\nno position"),
              "0:99(1): error: beyond\nno position");
}

} // namespace
} // namespace voxsheet::gpu
