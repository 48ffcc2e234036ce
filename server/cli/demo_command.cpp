#include "cli/commands.h"
#include "cli/demo/demo_files.h"
#include "cli/exit_codes.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace voxsheet::cli {

Action addDemo(CLI::App& app) {
    auto folder = std::make_shared<std::string>();
    app.add_option("DIR", *folder, "Folder to write to; made when it is not there")->required();
    app.footer("Example: voxsheet demo /tmp/demo && voxsheet serve /tmp/demo/demo.json");
    return [folder] {
        const auto report = writeDemo(*folder);
        for (const auto& file : report.written)
            std::fprintf(stderr, "wrote %s\n", file.c_str());
        if (!report.keptWorkbook.empty())
            std::fprintf(stderr, "kept your edited workbook as %s\n", report.keptWorkbook.c_str());
        std::printf("%s\n", report.workbook.c_str());
        return kExitDone;
    };
}

} // namespace voxsheet::cli
