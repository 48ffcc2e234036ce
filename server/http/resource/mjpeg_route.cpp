#include "base/errors.h"
#include "http/resource/api_context.h"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

namespace voxsheet::http {

namespace {

using namespace std::chrono_literals;

constexpr const char* kBoundary = "voxsheet-frame";
constexpr auto kRepeatAfter = 5s; ///< the last picture again, so that players and proxies see a living stream

/// Says when something in the workbook or its datasets changed.
class ChangeWatch {
public:
    explicit ChangeWatch(engine::Engine& engine) : engine_(engine), state_(std::make_shared<State>()) {
        listener_ = engine_.addListener([state = state_](engine::ChangeKind, std::uint64_t) {
            const std::lock_guard lock(state->mutex);
            state->changed = true;
            state->wake.notify_all();
        });
    }
    ~ChangeWatch() { engine_.removeListener(listener_); }
    ChangeWatch(const ChangeWatch&) = delete;
    ChangeWatch& operator=(const ChangeWatch&) = delete;

    /// Waits a short while; true if there was a change since the last true.
    bool poll() {
        std::unique_lock lock(state_->mutex);
        state_->wake.wait_for(lock, 200ms, [this] { return state_->changed; });
        return std::exchange(state_->changed, false);
    }

private:
    struct State {
        std::mutex mutex;
        std::condition_variable wake;
        bool changed = true;
    };
    engine::Engine& engine_;
    std::shared_ptr<State> state_;
    std::uint64_t listener_ = 0;
};

std::string part(const std::string& jpeg) {
    // The boundary after the picture tells a player that it is whole, without waiting for the next one.
    return "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) + "\r\n\r\n" + jpeg +
           "\r\n--" + kBoundary + "\r\n";
}

void writeFrames(const ApiContext& context, const engine::SheetImageRequest& wanted,
                 std::chrono::steady_clock::duration interval, StreamWriter& writer) {
    using Clock = std::chrono::steady_clock;
    stream::EncodeSettings encoding;
    encoding.format = stream::ImageFormat::Jpeg;
    encoding.quality = 85;
    ChangeWatch watch(context.engine);
    if (!writer.write(std::string("--") + kBoundary + "\r\n")) return;
    std::string lastIdentity;
    auto lastFrame = Clock::time_point{};
    while (writer.open()) {
        const bool changed = watch.poll();
        const auto now = Clock::now();
        if (!changed && now - lastFrame < kRepeatAfter) continue;
        if (now - lastFrame < interval) std::this_thread::sleep_for(interval - (now - lastFrame));
        const auto image = context.tiles.sheetImage(wanted, encoding);
        if (image->identity == lastIdentity && Clock::now() - lastFrame < kRepeatAfter) continue;
        if (!writer.write(part(image->bytes))) return;
        lastIdentity = image->identity;
        lastFrame = Clock::now();
    }
}

Response mjpeg(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    engine::SheetImageRequest wanted;
    wanted.sheet = sheet::sheetNamed(*workbook, request.param("sheet")).name;
    wanted.sizePixels = {static_cast<int>(request.query.integer("width", 16, 4096).value_or(1280)),
                         static_cast<int>(request.query.integer("height", 16, 4096).value_or(800))};
    const auto rate = request.query.number("fps", 0.1, 30.0).value_or(10.0);
    const auto interval = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(1.0 / rate));
    Response response{200, std::string("multipart/x-mixed-replace; boundary=") + kBoundary, {}};
    response.headers.add("X-Accel-Buffering", "no");
    response.stream = [&context, wanted, interval](StreamWriter& writer) {
        writeFrames(context, wanted, interval, writer);
    };
    return response;
}

} // namespace

void addMjpegRoute(Router& router, const ApiContext& context) {
    router.add({.method = "GET",
                .pattern = "/api/v1/sheets/{sheet}/stream.mjpeg",
                .handler = [&context](Request& request) { return mjpeg(context, request); },
                .summary = "The sheet as motion JPEG, for scripts and players",
                .query = {{"width", "integer", "pixels, 16 to 4096"},
                          {"height", "integer", "pixels, 16 to 4096"},
                          {"fps", "number", "at most so many pictures a second"}},
                .pool = Pool::Stream,
                .answerType = "multipart/x-mixed-replace",
                .answerDoc = "a JPEG for every change"});
}

} // namespace voxsheet::http
