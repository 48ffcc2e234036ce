#include "frame/frame_order.h"

#include "base/errors.h"

#include <algorithm>
#include <vector>

namespace voxsheet {

const TileLevels& levelsOf(const TileRenderer& renderer, FrameJob& job, std::size_t tile) {
    auto& levels = job.levels[tile];
    if (!levels) levels = renderer.levelsFor(job.frame.tiles[tile], job.frame.levels);
    return *levels;
}

FrameOrder::FrameOrder(TileRenderer& renderer) : renderer_(renderer) {
    renderer_.residency().setAwaited({}); // by a renderer before it
}

std::size_t FrameOrder::next(const std::shared_ptr<FrameJob>& job) {
    if (areAwaited_ && awaiting_.lock() != job) {
        renderer_.residency().setAwaited({});
        areAwaited_ = false;
    }
    const auto choice = chooseTile(job->issued, [&](std::size_t tile) { return readiness(*job, tile); });
    if (choice.ahead) readAhead(job, *choice.ahead);
    return choice.tile;
}

TileReadiness FrameOrder::readiness(FrameJob& job, std::size_t tile) const {
    if (job.frame.levels == LevelChoice::AtHand) return TileReadiness::Resident; // or left out
    try {
        if (renderer_.isResident(job.frame.tiles[tile], levelsOf(renderer_, job, tile)))
            return TileReadiness::Resident;
        auto& atHand = job.atHand[tile];
        if (tile == job.ahead && !*atHand && isAtHand(job, tile)) {
            atHand = true;
            return TileReadiness::Resident; // it comes next
        }
        if (!atHand) atHand = isAtHand(job, tile);
        return *atHand ? TileReadiness::AtHand : TileReadiness::OnDisk;
    } catch (const Error&) {
        return TileReadiness::Resident; // to be failed
    }
}

bool FrameOrder::isAtHand(FrameJob& job, std::size_t tile) const {
    const auto missing = renderer_.missing(job.frame.tiles[tile], levelsOf(renderer_, job, tile));
    return std::all_of(missing.begin(), missing.end(), [&](const WantedVolume& volume) {
        return renderer_.residency().isAtHand(volume.key);
    });
}

void FrameOrder::readAhead(const std::shared_ptr<FrameJob>& job, std::size_t tile) {
    if (!areAwaited_) {
        awaitAllOf(*job);
        awaiting_ = job;
        areAwaited_ = true;
    }
    job->ahead = tile;
    renderer_.residency().readAhead(
        renderer_.missing(job->frame.tiles[tile], levelsOf(renderer_, *job, tile)));
}

void FrameOrder::awaitAllOf(FrameJob& job) {
    std::vector<WantedVolume> awaited;
    for (std::size_t tile = 0; tile < job.issued.size(); ++tile) {
        if (job.issued[tile] || !job.levels[tile]) continue;
        const auto missing = renderer_.missing(job.frame.tiles[tile], *job.levels[tile]);
        awaited.insert(awaited.end(), missing.begin(), missing.end());
    }
    renderer_.residency().setAwaited(awaited);
}

} // namespace voxsheet
