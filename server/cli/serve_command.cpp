#include "base/byte_size.h"
#include "base/log.h"
#include "base/thread_count.h"
#include "cli/commands.h"
#include "cli/demo/demo_files.h"
#include "cli/demo/demo_workbook.h"
#include "cli/engine_arguments.h"
#include "cli/exit_codes.h"
#include "cli/level_arguments.h"
#include "cli/look_arguments.h"
#include "http/guard/token.h"
#include "http/resource/web_server.h"

#include <CLI/CLI.hpp>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <pthread.h>
#include <string>
#include <unistd.h>
#include <vector>

namespace voxsheet::cli {

namespace {

struct ServeArguments {
    EngineArguments engine;
    LookArguments look;
    LevelArguments levels;
    std::string host = "127.0.0.1";
    int port = 8080;
    bool portAskedFor = false;
    std::string token;
    std::string tokenFile;
    bool noToken = false;
    std::vector<std::string> allowedHosts;
    std::string basePath;
};

std::string tokenFrom(const ServeArguments& arguments) {
    if (arguments.noToken) return {};
    if (!arguments.token.empty()) return arguments.token;
    if (arguments.tokenFile.empty()) return http::randomToken();
    std::ifstream in(arguments.tokenFile);
    std::string token;
    if (!std::getline(in, token) || token.empty())
        throw InvalidInput(arguments.tokenFile, "its first line is no token",
                           "write one into it, or leave out --token-file");
    return token;
}

http::WebServerOptions webOptions(const ServeArguments& arguments) {
    http::WebServerOptions options;
    options.server.host = arguments.host;
    options.server.port = arguments.port;
    options.server.nextFreePort = !arguments.portAskedFor;
    options.token = tokenFrom(arguments);
    options.allowedHosts = arguments.allowedHosts;
    options.basePath = arguments.basePath;
    options.version = VOXSHEET_VERSION;
    return options;
}

/// Blocked in every thread from here on, so that only waitForStop() sees them.
sigset_t blockStopSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
    return signals;
}

void announce(const http::WebServer& server) {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    const auto port = std::to_string(server.port());
    std::fprintf(stderr,
                 "from another machine: ssh -L %s:127.0.0.1:%s %s, then open the address below there\n",
                 port.c_str(), port.c_str(), name.data());
    std::printf("ready %s\n", server.pageUrl().c_str());
    std::fflush(stdout);
}

void announceDevice(const RenderDevice& device, const engine::EngineOptions& options) {
    logInfo("drawing on " + device.renderer + " (" + device.eglPlatform + "): " + device.reason);
    logInfo("budgets: textures " + byteText(device.textureBudgetBytes) + " (" + device.textureBudgetReason +
            "), samples in host memory " + byteText(options.memoryBudgetBytes) +
            "; --texture-budget and --memory-budget change them");
}

void announceThreads() {
    const auto count = threadCount();
    logInfo("threads: " + std::to_string(count.threads) + " (" + count.reason + "); --threads lowers that");
}

void saveWhatIsNotSaved(const engine::Engine& engine) {
    try {
        if (const auto file = engine.saveRecovery())
            logInfo("edits that were not saved are in " + file->string());
    } catch (const std::exception& error) {
        logError(std::string("the edits could not be kept: ") + error.what());
    }
}

int runServe(const ServeArguments& arguments) {
    const auto signals = blockStopSignals();
    announceThreads();
    const auto options = engineOptions(arguments.engine);
    const auto levels = levelSettings(arguments.levels);
    engine::Engine engine(options);
    if (const auto* device = engine.device()) announceDevice(*device, engine.options());
    stream::TileService tiles(engine);
    stream::StreamHub hub(engine, tiles, levels);
    auto web = webOptions(arguments);
    // The upload folder is one that sources may always lie in.
    web.openDemo = [&engine, demoFolder = options.uploadDir / "demo"] {
        writeDemo(demoFolder);
        engine.setWorkbookJson(nlohmann::json::parse(demoWorkbookText()), demoFolder,
                               engine::DocumentOrigin::File);
    };
    http::WebServer server(web, engine, tiles, hub);
    openSources(engine, arguments.engine);
    applyLook(engine, engine.snapshot()->sheets.front().name, arguments.look);
    server.start();
    announce(server);
    int signal = 0;
    sigwait(&signals, &signal);
    logInfo("stopping");
    const bool stopped = server.stop();
    saveWhatIsNotSaved(engine);
    // A handler that did not end in time still uses the engine: nothing may be torn down under it.
    if (!stopped) std::_Exit(kExitDone);
    return kExitDone;
}

} // namespace

Action addServe(CLI::App& app) {
    auto arguments = std::make_shared<ServeArguments>();
    addEngineArguments(app, arguments->engine);
    addLookArguments(app, arguments->look);
    addLevelArguments(app, arguments->levels);
    app.add_option("--host", arguments->host, "Address to listen on");
    auto* port = app.add_option("--port", arguments->port,
                                "Port; 0 = any free one (default: 8080, or the next free one)")
                     ->check(CLI::Range(0, 65535));
    auto* token =
        app.add_option("--token", arguments->token, "Secret that clients must give (default: a random one)");
    auto* file = app.add_option("--token-file", arguments->tokenFile, "File whose first line is the secret");
    auto* none =
        app.add_flag("--no-token", arguments->noToken, "Ask for no secret; only on a loopback address");
    token->excludes(file)->excludes(none);
    file->excludes(none);
    app.add_option("--allow-host", arguments->allowedHosts,
                   "Further host name that clients may use; repeatable");
    app.add_option("--base-path", arguments->basePath, "Path prefix behind a proxy, e.g. /user/me/voxsheet");
    app.footer("Example: voxsheet serve scans/*.nii.gz --columns 4");
    return [arguments, port] {
        arguments->portAskedFor = port->count() > 0;
        return runServe(*arguments);
    };
}

} // namespace voxsheet::cli
