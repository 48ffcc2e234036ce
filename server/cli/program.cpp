#include "base/log.h"
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/thread_arguments.h"

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <unistd.h>
#include <utility>
#include <vector>

namespace voxsheet::cli {

namespace {

/// stdout belongs to results; everything else goes to stderr.
void startLogging() {
    auto logger = spdlog::stderr_color_mt("voxsheet");
    logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    const char* level = std::getenv("VOXSHEET_LOG");
    logger->set_level(level != nullptr ? spdlog::level::from_str(level) : spdlog::level::info);
    spdlog::set_default_logger(logger);
    setLogSink([](LogLevel severity, std::string_view message) {
        switch (severity) {
        case LogLevel::Debug:
            spdlog::debug("{}", message);
            break;
        case LogLevel::Info:
            spdlog::info("{}", message);
            break;
        case LogLevel::Warning:
            spdlog::warn("{}", message);
            break;
        case LogLevel::Error:
            spdlog::error("{}", message);
            break;
        }
    });
}

struct Choice {
    CLI::App* app;
    Action action;
};

int usageFailure(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
    reportFailure(std::string("command line: ") + error.what() + "; see `voxsheet --help`");
    return kExitUsage;
}

} // namespace

int runProgram(int argc, char** argv) {
    startLogging();
    CLI::App app{"Voxsheet: a spreadsheet whose cells are volumes."};
    app.set_version_flag("--version", VOXSHEET_VERSION);
    app.require_subcommand(1);
    app.footer("Example: voxsheet serve run1/CHGCAR run2/CHGCAR\n"
               "Every command has its own --help. VOXSHEET_LOG=debug|info|warn sets how much is logged.");
    std::vector<Choice> choices;
    const auto add = [&](const char* name, const char* text, Action (*define)(CLI::App&)) {
        auto* command = app.add_subcommand(name, text);
        choices.push_back({command, define(*command)});
    };
    add("serve", "Open files or a workbook and serve the sheet to a browser", &addServe);
    add("render", "Write one image of the sheet, without a server", &addRender);
    add("info", "Say what files hold", &addInfo);
    add("demo", "Write the demo datasets and their workbook", &addDemo);
    add("bench", "Measure; one JSON object on stdout", &addBench);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return usageFailure(app, error);
    }
    try {
        for (const auto& [command, action] : choices)
            if (command->parsed()) {
                const ThreadLimit limit(threadsAskedFor(*command));
                return action();
            }
    } catch (const std::exception& error) {
        return reportFailure(error);
    }
    return kExitUsage;
}

} // namespace voxsheet::cli
