#include "cli/bench/stream_probe.h"

#include "base/errors.h"
#include "stream/message.h"

#include <httplib.h>
#include <turbojpeg.h>

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxsheet::cli {

namespace {

/// Pixels of a tile, so that the latency ends where a page could show it.
void decode(const std::string& format, std::string_view bytes) {
    if (format == "jpeg") {
        const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
        const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
        const auto size = static_cast<unsigned long>(bytes.size());
        int width = 0;
        int height = 0;
        int subsampling = 0;
        if (tjDecompressHeader2(decoder.get(), const_cast<unsigned char*>(data), size, &width, &height,
                                &subsampling) != 0)
            throw InternalError("JPEG tile", "could not be decoded");
        std::vector<unsigned char> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                          4);
        if (tjDecompress2(decoder.get(), data, size, pixels.data(), width, 0, height, TJPF_RGBA, 0) != 0)
            throw InternalError("JPEG tile", "could not be decoded");
        return;
    }
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
        throw InternalError("PNG tile", image.message);
    image.format = PNG_FORMAT_RGBA;
    std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0)
        throw InternalError("PNG tile", image.message);
}

} // namespace

class StreamProbe::Connection {
public:
    explicit Connection(int port) : client("127.0.0.1", port) {
        client.set_keep_alive(true);
        client.set_tcp_nodelay(true);
    }
    httplib::Client client;
};

StreamProbe::StreamProbe(int port, std::string sheet)
    : port_(port), control_(std::make_unique<Connection>(port)), acks_(std::make_unique<Connection>(port)) {
    receiver_ = std::thread([this, name = std::move(sheet)] { receive(port_, name); });
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(10), [this] { return !id_.empty() || !failure_.empty(); });
    if (!id_.empty()) return;
    const auto why = failure_.empty() ? std::string("no greeting came") : failure_;
    closing_ = true;
    lock.unlock();
    receiver_.join();
    throw IoError("stream", why);
}

StreamProbe::~StreamProbe() {
    std::string id;
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
        id = id_;
    }
    control_->client.Delete("/api/v1/streams/" + id);
    receiver_.join();
}

void StreamProbe::receive(int port, const std::string& sheet) {
    Connection connection(port);
    connection.client.set_read_timeout(std::chrono::seconds(60));
    std::string buffer;
    const auto result = connection.client.Get(
        "/api/v1/sheets/" + sheet + "/stream?atlas=1", [&](const char* data, std::size_t bytes) {
            buffer.append(data, bytes);
            std::size_t used = 0;
            for (;;) {
                const auto message = stream::parseMessage(std::string_view(buffer).substr(used));
                if (message.bytes == 0) break;
                take(message.header, message.payload);
                used += message.bytes;
            }
            buffer.erase(0, used);
            const std::lock_guard lock(mutex_);
            return !closing_;
        });
    const std::lock_guard lock(mutex_);
    if (!closing_)
        failure_ =
            result ? "it ended with status " + std::to_string(result->status) : "the connection was lost";
    changed_.notify_all();
}

void StreamProbe::take(const nlohmann::json& tile) {
    const bool final = tile.at("final").get<bool>();
    current_.scale = std::min(current_.scale, tile.at("scale").get<double>());
    current_.final = current_.final && final;
    const auto cell = tile.at("cell").get<std::string>();
    finalCells_[cell] = final;
    resting_ = false;
    if (final) finalAt_ = Clock::now();
    if (unseen_.erase(cell) == 0) return;
    unseenScale_ = std::min(unseenScale_, tile.at("scale").get<double>());
    seenAt_ = Clock::now();
}

void StreamProbe::take(const nlohmann::json& header, std::string_view payload) {
    const auto type = header.value("type", std::string());
    if (type == "hello") {
        const std::lock_guard lock(mutex_);
        id_ = header.at("stream").get<std::string>();
        changed_.notify_all();
        return;
    }
    if (type == "rest") {
        const std::lock_guard lock(mutex_);
        resting_ = true;
        changed_.notify_all();
        return;
    }
    if (type != "tile" && type != "tiles" && type != "cell") return;
    if (type != "cell") decode(header.at("format").get<std::string>(), payload);
    const bool end = header.at("frameEnd").get<bool>();
    {
        const std::lock_guard lock(mutex_);
        current_.bytes += payload.size();
        if (type == "tile") take(header);
        if (type == "tiles")
            for (const auto& tile : header.at("tiles"))
                take(tile);
        if (end) {
            current_.view = header.at("view").get<std::uint64_t>();
            current_.when = Clock::now();
            if (const auto start = posted_.find(current_.view); start != posted_.end())
                current_.latencyMs =
                    std::chrono::duration<double, std::milli>(current_.when - start->second).count();
            frames_.push_back(current_);
            current_ = {};
            changed_.notify_all();
        }
    }
    if (end)
        acks_->client.Post("/api/v1/streams/" + id_, nlohmann::json{{"ack", header.at("frame")}}.dump(),
                           "application/json");
}

std::uint64_t StreamProbe::post(nlohmann::json view) {
    std::uint64_t id = 0;
    {
        const std::lock_guard lock(mutex_);
        if (!failure_.empty()) throw IoError("stream", failure_);
        id = nextView_++;
        posted_[id] = Clock::now();
        resting_ = false;
        for (auto& [cell, final] : finalCells_)
            final = false;
    }
    view["id"] = id;
    send({{"view", view}});
    return id;
}

void StreamProbe::send(const nlohmann::json& body) {
    const auto result = control_->client.Post("/api/v1/streams/" + id_, body.dump(), "application/json");
    if (!result) throw IoError("stream", "a view could not be posted");
    if (result->status >= 400) throw IoError("stream", "a view was refused: " + result->body);
}

bool StreamProbe::waitFinal(std::size_t cells, double seconds) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
        std::size_t final = 0;
        for (const auto& [cell, done] : finalCells_)
            final += done ? 1 : 0;
        return final >= cells || !failure_.empty();
    }) && failure_.empty();
}

bool StreamProbe::waitRest(double seconds) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] {
        return resting_ || !failure_.empty();
    }) && failure_.empty();
}

ProbedEdit StreamProbe::edit(const std::string& path, const nlohmann::json& body,
                             const std::set<std::string>& cells, double seconds) {
    {
        const std::lock_guard lock(mutex_);
        resting_ = false;
        unseen_ = cells;
        unseenScale_ = 1.0;
        for (const auto& cell : cells)
            finalCells_[cell] = false;
    }
    const auto begun = Clock::now();
    const auto result = control_->client.Patch(path, body.dump(), "application/json");
    if (!result) throw IoError("stream", "an edit could not be sent");
    if (result->status >= 400) throw IoError("stream", "an edit was refused: " + result->body);
    std::unique_lock lock(mutex_);
    const auto isFinal = [this](const std::string& cell) { return finalCells_[cell]; };
    // A cell that is being computed is no reason not to rest.
    const auto shown = [&] {
        return resting_ && unseen_.empty() && std::all_of(cells.begin(), cells.end(), isFinal);
    };
    changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                      [&] { return shown() || !failure_.empty(); });
    if (!shown())
        throw IoError("stream", failure_.empty() ? "an edit of " + path + " did not show within " +
                                                       std::to_string(std::lround(seconds)) + " s"
                                                 : failure_);
    const auto since = [begun](Clock::time_point when) {
        return std::chrono::duration<double, std::milli>(when - begun).count();
    };
    return {since(seenAt_), unseenScale_, since(finalAt_)};
}

std::vector<ProbedFrame> StreamProbe::takeFrames() {
    const std::lock_guard lock(mutex_);
    return std::exchange(frames_, {});
}

} // namespace voxsheet::cli
