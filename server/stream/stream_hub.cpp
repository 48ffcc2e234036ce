#include "stream/stream_hub.h"

#include "stream/stream_client.h"

#include <algorithm>
#include <random>
#include <utility>

namespace voxsheet::stream {

namespace {

constexpr std::size_t kMaxStreams = 256;

std::string randomId() {
    std::random_device source;
    std::string id;
    for (int word = 0; word < 4; ++word) {
        const auto bits = source();
        for (unsigned shift = 0; shift < 32; shift += 4)
            id.push_back("0123456789abcdef"[(bits >> shift) & 15U]);
    }
    return id;
}

void add(StreamStatistics& sum, const StreamStatistics& part) {
    sum.frames += part.frames;
    sum.tiles += part.tiles;
    sum.bytes += part.bytes;
}

} // namespace

StreamHub::StreamHub(engine::Engine& engine, TileService& tiles, const LevelSettings& levels)
    : engine_(engine), tiles_(tiles), levelSettings_(levels) {
    validateLevelSettings(levels);
    listener_ = engine_.addListener([this](engine::ChangeKind kind, std::uint64_t version) {
        if (kind == engine::ChangeKind::Workbook) applyLevelSettings();
        const std::lock_guard lock(mutex_);
        for (const auto& [id, client] : clients_)
            client->changed(kind, version);
    });
}

StreamHub::~StreamHub() {
    engine_.removeListener(listener_);
    stop();
}

std::string StreamHub::open(const std::string& sheetName, const StreamOptions& options) {
    static_cast<void>(sheet::sheetNamed(*engine_.snapshot(), sheetName)); // throws NotFound
    const std::lock_guard lock(mutex_);
    if (stopping_) throw Cancelled("stream", "the server is stopping");
    if (clients_.size() >= kMaxStreams)
        throw LimitExceeded("stream", "256 pages are connected already", "close some of them");
    const auto id = randomId();
    clients_[id] =
        std::make_shared<StreamClient>(id, sheetName, engine_, tiles_, levelsOf(sheetName), options);
    return id;
}

void StreamHub::close(const std::string& id) {
    {
        const std::lock_guard lock(mutex_);
        const auto found = clients_.find(id);
        if (found == clients_.end()) return;
        found->second->close();
        add(closed_, found->second->statistics());
        clients_.erase(found);
    }
}

std::shared_ptr<StreamClient> StreamHub::find(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    return found == clients_.end() ? nullptr : found->second;
}

void StreamHub::update(const std::string& id, const StreamUpdate& update) {
    const auto client = find(id);
    if (!client) throw NotFound("stream " + id, "it is closed", "open a new one");
    client->update(update);
}

std::optional<std::string> StreamHub::next(const std::string& id) {
    const auto client = find(id);
    return client ? client->next() : std::nullopt;
}

ClientView StreamHub::view(const std::string& id) const {
    const auto client = find(id);
    if (!client) throw NotFound("stream " + id, "it is closed", "open a new one");
    return client->view();
}

SheetLevels& StreamHub::levelsOf(const std::string& sheet) {
    auto& levels = levels_[sheet];
    if (!levels)
        levels = std::make_unique<SheetLevels>(settingsOf(sheet).value_or(levelSettings_),
                                               [this, sheet] { levelsChanged(sheet); });
    return *levels;
}

std::optional<LevelSettings> StreamHub::settingsOf(const std::string& sheet) const {
    const auto workbook = engine_.snapshot();
    const auto& sheets = workbook->sheets;
    const auto found =
        std::find_if(sheets.begin(), sheets.end(), [&](const auto& each) { return each.name == sheet; });
    if (found == sheets.end()) return std::nullopt;
    return found->levels.value_or(levelSettings_);
}

void StreamHub::applyLevelSettings() {
    const std::lock_guard order(applying_);
    std::vector<std::pair<std::string, SheetLevels*>> known; // they live as long as the hub
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [sheet, levels] : levels_)
            known.emplace_back(sheet, levels.get());
    }
    for (const auto& [sheet, levels] : known)
        if (const auto settings = settingsOf(sheet)) levels->setSettings(*settings);
}

SheetLevels& StreamHub::levels(const std::string& sheet) {
    static_cast<void>(sheet::sheetNamed(*engine_.snapshot(), sheet)); // throws NotFound
    const std::lock_guard lock(mutex_);
    return levelsOf(sheet);
}

void StreamHub::levelsChanged(const std::string& sheet) {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, client] : clients_)
        if (client->sheet() == sheet) client->levelsChanged();
}

std::optional<ClientView> StreamHub::newestView(const std::string& sheet) const {
    const std::lock_guard lock(mutex_);
    std::optional<ClientView> newest;
    std::chrono::steady_clock::time_point when;
    for (const auto& [id, client] : clients_) {
        if (client->sheet() != sheet || !client->hasView()) continue;
        const auto changed = client->lastChange();
        if (newest && changed <= when) continue;
        newest = client->view();
        when = changed;
    }
    return newest;
}

void StreamHub::stop() {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& [id, client] : clients_)
        client->close();
}

StreamStatistics StreamHub::statistics() const {
    const std::lock_guard lock(mutex_);
    StreamStatistics sum = closed_;
    sum.streams = static_cast<int>(clients_.size());
    for (const auto& [id, client] : clients_)
        add(sum, client->statistics());
    return sum;
}

std::optional<FrameTiming> StreamHub::lastFrame(const std::string& sheet) const {
    const std::lock_guard lock(mutex_);
    std::optional<FrameTiming> newest;
    for (const auto& [id, client] : clients_) {
        const auto timing = client->sheet() == sheet ? client->lastFrame() : std::nullopt;
        if (timing && (!newest || timing->when > newest->when)) newest = timing;
    }
    return newest;
}

} // namespace voxsheet::stream
